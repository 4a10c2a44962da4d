/** A part that has one of several shapes: which one, and the fields of that one. */
import { h } from '../dom.js';
import { initialVariant } from '../document.js';
import { variantNode, variantOf } from '../schema.js';
import { sentence } from '../text.js';
import { createField } from './field.js';
import { createFields } from './group.js';
import { createRow } from './row.js';

/** @typedef {import('../schema.js').Node} Node */

/** @param {import('./row.js').Context} context @param {string} pointer @param {Node} node @returns {import('./row.js').Field} */
export function variantField(context, pointer, node) {
  const variants = node.variants ?? [];
  const row = createRow(context, pointer, node, (id, edit, complain) => {
    const names = variants.map(({ name, node: n }, i) => h('option', { value: i, title: n.description }, sentence(name)));
    const select = h('select', { id }, ...names);
    const show = (/** @type {any} */ value) => {
      select.value = String(variantOf(node, value));
      select.title = variants[variantOf(node, value)].node.description;
    };
    select.addEventListener('change', async () => {
      const fresh = initialVariant(node, Number(select.value));
      try {
        edit(await context.carryOver(context.store.get(pointer), fresh));
      } catch (error) {
        show(context.store.get(pointer));
        complain(/** @type {Error} */ (error).message);
      }
    });
    return { controls: [select], show };
  });
  const body = h('div', { class: 'variant-body' });
  let shown = -1;
  /** @type {(value: any) => void} */
  let updateBody = () => {};
  return {
    element: h('div', { class: 'variant-group' }, row.element, body),
    update(value) {
      row.update(value);
      const index = variantOf(node, value);
      if (index !== shown) {
        shown = index;
        const inner = { ...variantNode(node, index), title: node.title };
        if (inner.type === 'object') {
          const fields = createFields(context, pointer, inner);
          updateBody = fields.update;
          body.replaceChildren(...fields.elements);
        } else {
          const field = createField(context, pointer, inner);
          updateBody = field.update;
          body.replaceChildren(field.element);
        }
      }
      updateBody(value);
    },
  };
}
