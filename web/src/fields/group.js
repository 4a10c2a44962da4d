/** A part of the scene: its fields under a heading that folds, with a switch where the part may be off. */
import { h, uniqueId } from '../dom.js';
import { child } from '../pointer.js';
import { createField } from './field.js';
import { resetButton } from './row.js';

/** @typedef {import('../schema.js').Node} Node */
/** @typedef {import('./row.js').Field} Field */

/** Fields that a photographer looks for first. */
const FIRST = [
  'name', 'mountains', 'base_m', 'top_m', 'height_m', 'genus', 'type', 'coverage', 'density', 'precipitation', 'seed', 'layers', 'weather_map', 'wind',
  'centre_m', 'extent_m', 'shape', 'phase', 'speed_m_s', 'position', 'position_m', 'direction', 'projection', 'exposure', 'tone_curve', 'visibility_m', 'extinction_per_m',
  'phase_angle_deg', 'method', 'orders', 'view_steps', 'sun_steps',
];

/** Fields of an object: the foremost, then the simple, then whole parts. @param {import('./row.js').Context} context @param {string} pointer @param {Node} node */
export function createFields(context, pointer, node) {
  const isPart = (/** @type {import('../schema.js').Property} */ { node: n }) => n.type === 'object' || n.type === 'list';
  const rank = (/** @type {import('../schema.js').Property} */ p) => (FIRST.includes(p.key) ? FIRST.indexOf(p.key) : FIRST.length + Number(isPart(p)));
  const properties = [...(node.properties ?? [])].sort((a, b) => rank(a) - rank(b));
  const fields = properties.map(({ key, node: inner }) => ({ key, field: createField(context, child(pointer, key), inner) }));
  return {
    elements: fields.map(({ field }) => field.element),
    /** @param {any} value */
    update: (value) => fields.forEach(({ key, field }) => field.update(value[key])),
  };
}

/**
 * A heading with `body` under it.
 * @param {import('./row.js').Context} context @param {string} pointer @param {Node} node @param {boolean} open
 */
export function createFold(context, pointer, node, open) {
  const id = uniqueId('group');
  const body = h('div', { class: 'group-body', id });
  const toggle = h('button', { type: 'button', class: 'fold', 'aria-controls': id, title: node.description }, node.title);
  const fold = (/** @type {boolean} */ shown) => {
    toggle.setAttribute('aria-expanded', String(shown));
    body.hidden = !shown;
  };
  toggle.addEventListener('click', () => fold(Boolean(body.hidden)));
  fold(open);
  const reset = resetButton(context, pointer, node);
  const head = h('div', { class: 'group-head' }, toggle, reset.button);
  return { element: h('section', { class: 'group', 'data-pointer': pointer }, head, body), head, body, fold, reset };
}

/** What stands under the heading: all fields of an object, or the one field of anything else. @param {import('./row.js').Context} context @param {string} pointer @param {Node} node */
function createBody(context, pointer, node) {
  if (node.type === 'object') return createFields(context, pointer, node);
  const { element, update } = createField(context, pointer, { ...node, nullable: false });
  return { elements: [element], update };
}

/** @param {import('./row.js').Context} context @param {string} pointer @param {Node} node @param {boolean} [open] @returns {Field} */
export function groupField(context, pointer, node, open = false) {
  const { element, head, body, fold, reset } = createFold(context, pointer, node, open);
  const on = h('input', { type: 'checkbox', class: 'switch', 'aria-label': `${node.title} on` });
  on.addEventListener('change', () => {
    if (on.checked) context.turnOn(pointer, node);
    else context.store.set(pointer, null);
    fold(on.checked);
  });
  if (node.nullable) head.append(on);
  /** @type {ReturnType<typeof createFields> | null} */
  let fields = null;
  return {
    element,
    update(value) {
      reset.update(value);
      const isOn = value !== null;
      on.checked = isOn;
      element.classList.toggle('off', !isOn);
      if (!isOn) {
        body.replaceChildren(h('p', { class: 'note' }, 'Off'));
        fields = null;
        return;
      }
      if (!fields) {
        fields = createBody(context, pointer, node);
        body.replaceChildren(...fields.elements);
      }
      fields.update(value);
    },
  };
}
