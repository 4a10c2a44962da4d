/** A list of parts, each with its fields; parts are added and removed. */
import { h } from '../dom.js';
import { initial } from '../document.js';
import { child } from '../pointer.js';
import { createField } from './field.js';
import { createFold } from './group.js';

/** @typedef {import('../schema.js').Node} Node */

/** @param {import('./row.js').Context} context @param {string} pointer @param {Node} node @returns {import('./row.js').Field} */
export function listField(context, pointer, node) {
  const { element, body, reset } = createFold(context, pointer, node, false);
  const item = /** @type {Node} */ (node.items);
  const list = () => context.store.get(pointer);
  const add = h('button', { type: 'button', onclick: () => context.store.set(pointer, [...list(), initial(item)]) }, 'Add');
  /** @type {import('./row.js').Field[]} */
  let fields = [];
  const rebuild = (/** @type {number} */ length) => {
    fields = Array.from({ length }, (_, i) => createField(context, child(pointer, i), { ...item, title: `${node.title} ${i + 1}` }));
    const rows = fields.map((field, i) => {
      const remove = () => context.store.set(pointer, list().toSpliced(i, 1));
      return h('div', { class: 'item' }, field.element, h('button', { type: 'button', onclick: remove }, 'Remove'));
    });
    body.replaceChildren(...rows, add);
  };
  rebuild(0);
  return {
    element,
    update(values) {
      reset.update(values);
      if (values.length !== fields.length) rebuild(values.length);
      values.forEach((/** @type {any} */ value, /** @type {number} */ i) => fields[i].update(value));
    },
  };
}
