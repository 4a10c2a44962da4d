/** Ready-made scenes; the first of them stand in a row, as many as have a key. */
import { byId, h } from './dom.js';
import { complete } from './document.js';
import { equal } from './json.js';
import { announce } from './toast.js';

const KEYS = 9;

/** @typedef {{name: string, title: string, description: string, scene: any}} Preset */

/** @param {import('./store.js').Store} store @param {Preset[]} list */
export function createPresets(store, list) {
  const presets = list.map((preset) => ({ ...preset, scene: complete(store.root, preset.scene) }));
  const choose = (/** @type {Preset | undefined} */ preset) => {
    if (!preset) return;
    store.replace(preset.scene);
    announce(`${preset.title}. ${preset.description}`);
  };
  const isShown = (/** @type {Preset} */ { scene }) => equal(scene, store.scene);
  const buttons = presets.slice(0, KEYS).map((preset) =>
    h('button', { type: 'button', class: 'glass', 'data-preset': preset.name, title: preset.description, onclick: () => choose(preset) }, preset.title),
  );
  byId('presets', HTMLElement).append(...buttons);
  return {
    /** @param {number} index */
    choose: (index) => choose(presets[index]),
    all: presets,
    /** @param {Preset} preset */
    take: choose,
    isShown,
    update: () => buttons.forEach((button, i) => button.setAttribute('aria-pressed', String(isShown(presets[i])))),
  };
}

/** @typedef {ReturnType<typeof createPresets>} Presets */
