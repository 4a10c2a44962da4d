/** The row of ready-made scenes. */
import { byId, h } from './dom.js';
import { complete } from './document.js';
import { equal } from './json.js';
import { announce } from './toast.js';

/** @typedef {{name: string, title: string, description: string, scene: any}} Preset */

/** @param {import('./store.js').Store} store @param {Preset[]} list */
export function createPresets(store, list) {
  const presets = list.map((preset) => ({ ...preset, scene: complete(store.root, preset.scene) }));
  const choose = (/** @type {Preset | undefined} */ preset) => {
    if (!preset) return;
    store.replace(preset.scene);
    announce(`${preset.title}. ${preset.description}`);
  };
  const buttons = presets.map((preset) =>
    h('button', { type: 'button', class: 'glass', 'data-preset': preset.name, title: preset.description, onclick: () => choose(preset) }, preset.title),
  );
  byId('presets', HTMLElement).append(...buttons);
  return {
    /** @param {number} index */
    choose: (index) => choose(presets[index]),
    update: () => presets.forEach(({ scene }, i) => buttons[i].setAttribute('aria-pressed', String(equal(scene, store.scene)))),
  };
}
