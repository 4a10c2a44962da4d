/** One of several, yes or no, and text. */
import { h } from '../dom.js';
import { sentence } from '../text.js';
import { createRow } from './row.js';

/** @typedef {import('./row.js').Context} Context */
/** @typedef {import('../schema.js').Node} Node */

/** @param {Context} context @param {string} pointer @param {Node} node */
export function choiceField(context, pointer, node) {
  return createRow(context, pointer, node, (id, edit) => {
    const options = node.options ?? [];
    const select = h('select', { id }, ...options.map((o) => h('option', { value: o.value, title: o.description }, sentence(o.value))));
    select.addEventListener('change', () => edit(select.value));
    return {
      controls: [select],
      show(value) {
        select.value = value;
        select.title = options.find((o) => o.value === value)?.description ?? '';
      },
    };
  });
}

/** @param {Context} context @param {string} pointer @param {Node} node */
export function booleanField(context, pointer, node) {
  return createRow(context, pointer, node, (id, edit) => {
    const box = h('input', { type: 'checkbox', id, class: 'switch' });
    box.addEventListener('change', () => edit(box.checked));
    return { controls: [box], show: (value) => (box.checked = value) };
  });
}

/** @param {Context} context @param {string} pointer @param {Node} node */
export function textField(context, pointer, node) {
  return createRow(context, pointer, node, (id, edit) => {
    const list = h('datalist', { id: `${id}-known` });
    const input = h('input', { type: 'text', id, spellcheck: 'false', autocomplete: 'off', list: list.id });
    input.addEventListener('focus', () => list.replaceChildren(...context.suggestions(pointer).map((value) => h('option', { value }))));
    input.addEventListener('change', () => edit(input.value));
    return { controls: [input, list], show: (value) => (input.value = value) };
  });
}
