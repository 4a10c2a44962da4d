/** A field that may be off, where what it holds is no group of its own. */
import { initial } from '../document.js';
import { h } from '../dom.js';

/** @typedef {import('../schema.js').Node} Node */

/**
 * @param {import('./row.js').Context} context @param {string} pointer @param {Node} node
 * @param {(context: import('./row.js').Context, pointer: string, node: Node) => import('./row.js').Field} create
 * @returns {import('./row.js').Field}
 */
export function optionalField(context, pointer, node, create) {
  const on = h('input', { type: 'checkbox', class: 'switch', 'aria-label': `${node.title} on` });
  const body = h('div');
  const whole = { ...node, nullable: false };
  on.addEventListener('change', () => {
    context.store.set(pointer, on.checked ? (initial(whole) ?? initial({ ...whole, initial: undefined })) : null);
  });
  /** @type {import('./row.js').Field | null} */
  let field = null;
  return {
    element: h('div', { class: 'optional' }, h('label', { class: 'field-head', title: node.description }, h('span', {}, node.title), on), body),
    update(value) {
      on.checked = value !== null;
      if (value === null) {
        body.replaceChildren();
        field = null;
        return;
      }
      if (!field) {
        field = create(context, pointer, whole);
        body.replaceChildren(field.element);
      }
      field.update(value);
    },
  };
}
