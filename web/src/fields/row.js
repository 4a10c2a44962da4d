/** What every field has: a label, a way back to the default, and a place for what is wrong with it. */
import { h, uniqueId } from '../dom.js';
import { initial } from '../document.js';
import { equal } from '../json.js';

/** @typedef {import('../schema.js').Node} Node */
/** @typedef {{element: HTMLElement, update: (value: any) => void}} Field */
/**
 * @typedef {object} Context
 * @property {import('../store.js').Store} store
 * @property {Map<string, (message: string) => void>} complaints How to show an error at a pointer.
 * @property {(value: any, fresh: any) => any} carryOver Keeps what an old variant's value says in a new one; may take its time.
 * @property {(pointer: string) => string[]} suggestions What a text may well be.
 * @property {(pointer: string, node: Node) => void} turnOn Gives a part that is off the values it begins with.
 */

/** @param {Context} context @param {string} pointer @param {Node} node */
export function resetButton({ store }, pointer, node) {
  const reset = () => store.set(pointer, initial(node));
  const button = h('button', { type: 'button', class: 'reset', 'aria-label': `Reset ${node.title}`, title: 'Reset', onclick: reset }, '↺');
  return {
    button,
    /** @param {any} value */
    update: (value) => button.classList.toggle('idle', equal(value, initial(node))),
  };
}

/**
 * A row round controls that `build` makes: the label names the control of the given id, and `beside` stands at its end.
 * @param {Context} context @param {string} pointer @param {Node} node
 * @param {(id: string, edit: (value: any) => void, complain: (message: string) => void) => {controls: HTMLElement[], show: (value: any) => void, beside?: HTMLElement}} build
 * @returns {Field}
 */
export function createRow(context, pointer, node, build) {
  const id = uniqueId('field');
  const error = h('p', { class: 'error', id: `${id}-error`, role: 'alert', hidden: true });
  /** What the scene held when the complaint came. @type {{value: any} | null} */
  let complaint = null;
  const settle = () => {
    if (!complaint) return;
    complaint = null;
    error.hidden = true;
    mark();
  };
  const complain = (/** @type {string} */ message) => {
    complaint = { value: context.store.get(pointer) };
    error.textContent = message;
    error.hidden = false;
    mark();
  };
  const { controls, show, beside = null } = build(
    id,
    (value) => {
      settle();
      context.store.set(pointer, value);
    },
    complain,
  );
  const mark = () => {
    element.classList.toggle('refused', complaint !== null);
    for (const input of element.querySelectorAll('input, select')) {
      if (complaint) input.setAttribute('aria-invalid', 'true');
      else input.removeAttribute('aria-invalid');
    }
  };
  const reset = resetButton(context, pointer, node);
  reset.button.addEventListener('click', settle);
  const unit = node.unit ? h('span', { class: 'unit' }, node.unit) : null;
  const label = h('label', { for: id, title: node.description }, node.title, unit);
  const element = h(
    'div',
    { class: `field ${node.type}`, 'data-pointer': pointer, role: 'group', 'aria-label': node.title, 'aria-describedby': error.id },
    h('div', { class: 'field-head' }, label, beside, reset.button),
    h('div', { class: 'controls' }, ...controls),
    error,
  );
  context.complaints.set(pointer, complain);
  return {
    element,
    update(value) {
      reset.update(value);
      if (complaint && equal(complaint.value, value)) return;
      settle();
      show(value);
    },
  };
}
