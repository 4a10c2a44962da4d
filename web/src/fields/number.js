/** A number: an input, and a slider where the range allows one; a fixed row of numbers as inputs side by side. */
import { h } from '../dom.js';
import { createScale } from '../scale.js';
import { numberText } from '../text.js';
import { createRow } from './row.js';

const SLIDER_STEPS = 1000;

/** @typedef {import('../schema.js').Node} Node */

/**
 * @param {Node} node @param {Record<string, any>} attributes @param {(value: number) => void} edit
 * @param {(message: string) => void} complain
 */
function numberInput(node, attributes, edit, complain) {
  const { minimum, maximum, unit } = node;
  const input = h('input', {
    type: 'number', min: minimum, max: maximum, step: createScale(node)?.step ?? 'any', inputmode: 'decimal',
    title: minimum === undefined ? '' : `${numberText(minimum)} to ${numberText(maximum ?? Infinity)} ${unit}`,
    ...attributes,
  });
  input.addEventListener('input', () => {
    const value = input.valueAsNumber;
    if (Number.isNaN(value)) complain('A number is needed here.');
    else edit(value);
  });
  return {
    input,
    /** Leaves alone what the user is typing if it means the same. @param {number} value */
    show(value) {
      if (input.value === '' || numberText(input.valueAsNumber) !== numberText(value)) input.value = numberText(value);
    },
  };
}

/** @param {import('./row.js').Context} context @param {string} pointer @param {Node} node */
export function numberField(context, pointer, node) {
  return createRow(context, pointer, node, (id, edit, complain) => {
    const scale = createScale(node);
    const { input, show } = numberInput(node, { id }, edit, complain);
    if (!scale) return { controls: [input], show };
    const slider = h('input', { type: 'range', min: 0, max: SLIDER_STEPS, step: 1, 'aria-label': `${node.title}, slider` });
    slider.addEventListener('input', () => edit(scale.value(slider.valueAsNumber / SLIDER_STEPS)));
    return {
      controls: [slider, input],
      show(value) {
        show(value);
        slider.value = String(Math.round(scale.position(value) * SLIDER_STEPS));
        slider.style.setProperty('--filled', `${scale.position(value) * 100}%`);
        slider.setAttribute('aria-valuetext', `${numberText(value)} ${node.unit}`);
      },
    };
  });
}

/** The description says what the numbers are. @param {Node} node */
const axisNames = ({ description }) => (/\bR, G and B\b/.test(description) ? ['R', 'G', 'B'] : ['East', 'North', 'Up']);

/** @param {import('./row.js').Context} context @param {string} pointer @param {Node} node */
export function numbersField(context, pointer, node) {
  return createRow(context, pointer, node, (id, edit, complain) => {
    const item = { .../** @type {Node} */ (node.items), unit: node.unit };
    const names = axisNames(node);
    const parts = Array.from({ length: node.length ?? 0 }, (_, i) => {
      const name = names[i] ?? String(i + 1);
      const change = (/** @type {number} */ value) => edit(context.store.get(pointer).with(i, value));
      const label = `${node.title}, ${name}`;
      return { name, ...numberInput(item, { id: i === 0 ? id : `${id}-${i}`, 'aria-label': label }, change, complain) };
    });
    return {
      controls: parts.map(({ name, input }) => h('span', { class: `part ${name}` }, h('i', { 'aria-hidden': 'true' }, name[0]), input)),
      show: (values) => parts.forEach(({ show }, i) => show(values[i])),
    };
  });
}
