/** A number: an input, and a slider where the range allows one; a fixed row of numbers as inputs side by side; or either. */
import { h, uniqueId } from '../dom.js';
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

/**
 * The controls of one number.
 * @param {Node} node @param {string} id @param {(value: number) => void} edit @param {(message: string) => void} complain
 */
function oneNumber(node, id, edit, complain) {
  const scale = createScale(node);
  const { input, show } = numberInput(node, { id }, edit, complain);
  if (!scale) return { controls: [input], show };
  const slider = h('input', { type: 'range', min: 0, max: SLIDER_STEPS, step: 1, 'aria-label': `${node.title}, slider` });
  slider.addEventListener('input', () => edit(scale.value(slider.valueAsNumber / SLIDER_STEPS)));
  return {
    controls: [slider, input],
    show(/** @type {number} */ value) {
      show(value);
      slider.value = String(Math.round(scale.position(value) * SLIDER_STEPS));
      slider.style.setProperty('--filled', `${scale.position(value) * 100}%`);
      slider.setAttribute('aria-valuetext', `${numberText(value)} ${node.unit}`);
    },
  };
}

/** The description says what the numbers are. @param {Node} node */
const axisNames = ({ description, length }) => {
  if (length === 4) return ['Begins', 'Full', 'Thins', 'Ends'];
  return /\bR, G and B\b/.test(description) ? ['R', 'G', 'B'] : ['East', 'North', 'Up'];
};

/**
 * The controls of a fixed row of numbers.
 * @param {Node} node @param {string} id @param {(index: number, value: number) => void} edit @param {(message: string) => void} complain
 */
function rowOfNumbers(node, id, edit, complain) {
  const item = { .../** @type {Node} */ (node.items), unit: node.unit };
  const names = axisNames(node);
  const parts = Array.from({ length: node.length ?? 0 }, (_, i) => {
    const name = names[i] ?? String(i + 1);
    const attributes = { id: i === 0 ? id : `${id}-${i}`, 'aria-label': `${node.title}, ${name}` };
    return { name, ...numberInput(item, attributes, (value) => edit(i, value), complain) };
  });
  return {
    controls: parts.map(({ name, input }) => h('span', { class: `part ${name}` }, h('i', { 'aria-hidden': 'true' }, name[0]), input)),
    show: (/** @type {number[]} */ values) => parts.forEach(({ show }, i) => show(values[i])),
  };
}

/** @param {import('./row.js').Context} context @param {string} pointer @param {Node} node */
export const numberField = (context, pointer, node) =>
  createRow(context, pointer, node, (id, edit, complain) => oneNumber(node, id, edit, complain));

/** @param {import('./row.js').Context} context @param {string} pointer @param {Node} node */
export const numbersField = (context, pointer, node) =>
  createRow(context, pointer, node, (id, edit, complain) =>
    rowOfNumbers(node, id, (i, value) => edit(context.store.get(pointer).with(i, value)), complain),
  );

/** One number for all bands, or one for each. @param {import('./row.js').Context} context @param {string} pointer @param {Node} node */
export function bandsField(context, pointer, node) {
  return createRow(context, pointer, node, (id, edit, complain) => {
    const one = oneNumber(node, id, edit, complain);
    const each = rowOfNumbers(node, uniqueId('band'), (i, value) => edit(context.store.get(pointer).with(i, value)), complain);
    const [grey, bands] = [h('div', { class: 'controls' }, ...one.controls), h('div', { class: 'controls numbers' }, ...each.controls)];
    const toggle = h('button', { type: 'button', class: 'bands-toggle', title: 'One number for each of R, G and B', 'aria-label': `${node.title} for each of R, G and B` }, 'RGB');
    toggle.addEventListener('click', () => {
      const value = context.store.get(pointer);
      const mean = (/** @type {number[]} */ values) => Number((values.reduce((sum, v) => sum + v, 0) / values.length).toPrecision(4));
      edit(Array.isArray(value) ? mean(value) : Array.from({ length: node.length ?? 0 }, () => value));
    });
    return {
      beside: toggle,
      controls: [grey, bands],
      show(value) {
        const isEach = Array.isArray(value);
        toggle.setAttribute('aria-pressed', String(isEach));
        [grey.hidden, bands.hidden] = [isEach, !isEach];
        if (isEach) each.show(value);
        else one.show(value);
      },
    };
  });
}
