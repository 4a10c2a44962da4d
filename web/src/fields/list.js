/** A list of parts, each with its fields; parts are added, removed and put in another order. */
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
  const name = node.title.replace(/s$/, '');
  const list = () => context.store.get(pointer);
  /** What gets the focus when the rows are as they will be. @type {(() => HTMLElement | null) | null} */
  let focusNext = null;
  const change = (/** @type {any[]} */ values, /** @type {() => HTMLElement | null} */ focus) => {
    focusNext = focus;
    context.store.set(pointer, values);
  };
  const rowAt = (/** @type {number} */ i) => /** @type {HTMLElement | undefined} */ (body.querySelectorAll(':scope > .item')[i]);
  const add = h('button', { type: 'button', class: 'add' }, `Add a ${name.toLowerCase()}`);
  add.addEventListener('click', () => {
    const values = [...list(), initial(item)];
    change(values, () => rowAt(values.length - 1)?.querySelector('select, input') ?? null);
  });

  /** @param {number} i @param {number} step @param {string} sign @param {string} way */
  const mover = (i, step, sign, way) => {
    const move = () => {
      const values = list();
      const moved = values.toSpliced(i, 1).toSpliced(i + step, 0, values[i]);
      change(moved, () => {
        const same = rowAt(i + step)?.querySelector(`[data-move="${way}"]:enabled`);
        return /** @type {HTMLElement | null} */ (same ?? rowAt(i + step)?.querySelector('[data-move]:enabled') ?? null);
      });
    };
    return h('button', { type: 'button', 'data-move': way, 'aria-label': `Move ${name.toLowerCase()} ${i + 1} ${way}`, title: `Move ${way}`, onclick: move }, sign);
  };
  /** @type {import('./row.js').Field[]} */
  let fields = [];
  const rebuild = (/** @type {number} */ length) => {
    fields = Array.from({ length }, (_, i) => createField(context, child(pointer, i), { ...item, title: `${name} ${i + 1}` }));
    const rows = fields.map((field, i) => {
      const [up, down] = [mover(i, -1, '↑', 'up'), mover(i, 1, '↓', 'down')];
      [up.disabled, down.disabled] = [i === 0, i === length - 1];
      const remove = () => change(list().toSpliced(i, 1), () => add);
      const away = h('button', { type: 'button', 'aria-label': `Remove ${name.toLowerCase()} ${i + 1}`, onclick: remove }, 'Remove');
      return h('div', { class: 'item' }, field.element, h('div', { class: 'item-actions' }, up, down, away));
    });
    body.replaceChildren(...rows, add);
    add.disabled = length >= (node.most ?? Infinity);
  };
  rebuild(0);
  return {
    element,
    update(values) {
      reset.update(values);
      if (values.length !== fields.length) rebuild(values.length);
      values.forEach((/** @type {any} */ value, /** @type {number} */ i) => fields[i].update(value));
      focusNext?.()?.focus();
      focusNext = null;
    },
  };
}
