/** The panel with every parameter of the scene, made from the schema. */
import { byId } from './dom.js';
import { createField } from './fields/field.js';
import { groupField } from './fields/group.js';
import { child, tokens } from './pointer.js';
import { turnedOn } from './starts.js';

/** Order of the parts that a photographer meets first; others follow as the schema has them. */
const ORDER = ['camera', 'sun', 'moon', 'stars', 'clouds', 'terrain', 'shafts', 'atmosphere', 'haze', 'planet', 'display'];
const OPEN = ['sun'];

/** @typedef {import('./fields/row.js').Context} Context */

/**
 * @param {import('./store.js').Store} store @param {Context['carryOver']} carryOver
 * @param {import('./starts.js').Known} known @param {Context['suggestions']} suggestions
 */
export function createPanel(store, carryOver, known, suggestions) {
  /** @type {Context} */
  const context = {
    store,
    carryOver,
    suggestions,
    complaints: new Map(),
    turnOn: (pointer, node) => store.replace(turnedOn(store.scene, pointer, node, known)),
  };
  const rank = (/** @type {string} */ key) => (ORDER.includes(key) ? ORDER.indexOf(key) : ORDER.length);
  const properties = [...(store.root.properties ?? [])].sort((a, b) => rank(a.key) - rank(b.key));
  const fields = properties.map(({ key, node }) => {
    const pointer = child('', key);
    const field = node.type === 'object' || node.type === 'variant' ? groupField(context, pointer, node, OPEN.includes(key)) : createField(context, pointer, node);
    return { key, field };
  });
  byId('fields', HTMLDivElement).append(...fields.map(({ field }) => field.element));
  const panel = byId('panel', HTMLElement);
  const toggle = byId('toggle-panel', HTMLButtonElement);
  /** @type {() => void} */
  let shows = () => {};
  const show = (/** @type {boolean} */ shown) => {
    panel.hidden = !shown;
    if (shown) shows();
    toggle.setAttribute('aria-expanded', String(shown));
  };
  toggle.addEventListener('click', () => show(Boolean(panel.hidden)));
  byId('reset-scene', HTMLButtonElement).addEventListener('click', () => store.load({}));
  return {
    show,
    /** @param {() => void} act */
    onShow: (act) => (shows = act),
    toggle: () => show(Boolean(panel.hidden)),
    update: () => fields.forEach(({ key, field }) => field.update(store.scene[key])),
    /**
     * Says what is wrong at the field that a pointer names, or at the nearest field round it.
     * @param {string} pointer @param {string} message @returns {boolean} False where no field in sight stands for it
     */
    complain(pointer, message) {
      for (let path = tokens(pointer); path.length > 0; path = path.slice(0, -1)) {
        const at = path.reduce((p, key) => child(p, key), '');
        const element = panel.querySelector(`[data-pointer="${CSS.escape(at)}"].field`);
        const complain = context.complaints.get(at);
        if (!complain || !element) continue;
        complain(message);
        return element.checkVisibility();
      }
      return false;
    },
  };
}

/** @typedef {ReturnType<typeof createPanel>} Panel */
