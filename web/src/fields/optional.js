/** A field that may be off, where what it holds is no group of its own: one heading with a switch. */
import { h } from '../dom.js';

/** @typedef {import('../schema.js').Node} Node */

/**
 * @param {import('./row.js').Context} context @param {string} pointer @param {Node} node
 * @param {(context: import('./row.js').Context, pointer: string, node: Node) => import('./row.js').Field} create
 * @returns {import('./row.js').Field}
 */
export function optionalField(context, pointer, node, create) {
  const on = h('input', { type: 'checkbox', class: 'switch', 'aria-label': `${node.title} on` });
  const body = h('div', { class: 'optional-body' });
  on.addEventListener('change', () => {
    if (on.checked) context.turnOn(pointer, node);
    else context.store.set(pointer, null);
  });
  const unit = node.unit ? h('span', { class: 'unit' }, node.unit) : null;
  const head = h('label', { class: 'field-head', title: node.description }, h('span', {}, node.title, unit), on);
  /** @type {import('./row.js').Field | null} */
  let field = null;
  return {
    element: h('div', { class: 'optional', 'data-optional': pointer }, head, body),
    update(value) {
      on.checked = value !== null;
      if (value === null) {
        body.replaceChildren();
        field = null;
        return;
      }
      if (!field) {
        // What it begins with is what its slider is scaled by.
        field = create(context, pointer, { ...node, nullable: false, initial: value });
        body.replaceChildren(field.element);
      }
      field.update(value);
    },
  };
}
