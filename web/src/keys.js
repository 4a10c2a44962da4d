/** The keyboard: one table says what each key does, and the help shows the same table. */
import { byId, h } from './dom.js';

const SUN_STEP_DEG = 1;
const FINE_STEP_DEG = 0.1;
const LOOK_STEP_DEG = 3;
const ZOOM_STEP = 1.1;

/** @typedef {{keys: string[], shown: string, does: string, act: (event: KeyboardEvent) => void}} Binding */

/**
 * @param {object} parts
 * @param {import('./sun.js').Sun} parts.sun
 * @param {import('./camera.js').Camera} parts.camera
 * @param {(index: number) => void} parts.preset
 * @param {() => void} parts.panel
 * @param {() => void} parts.bare
 * @param {() => void} parts.save
 * @param {() => void} parts.play
 * @param {{act: () => void, undo: () => void}} parts.surprise
 * @param {() => void} parts.help
 * @returns {Binding[]}
 */
export function bindings({ sun, camera, preset, panel, bare, save, play, surprise, help }) {
  const sunStep = (/** @type {number} */ az, /** @type {number} */ el) => (/** @type {KeyboardEvent} */ event) => {
    const step = event.shiftKey ? FINE_STEP_DEG : SUN_STEP_DEG;
    sun.nudge(az * step, el * step);
  };
  const look = (/** @type {number} */ az, /** @type {number} */ el) => () => camera.turn(az * LOOK_STEP_DEG, el * LOOK_STEP_DEG);
  const arrows = { shown: '← → ↑ ↓', does: 'Move the sun, with Shift in fine steps' };
  const wasd = { shown: 'W A S D', does: 'Look around' };
  return [
    { keys: ['ArrowLeft'], ...arrows, act: sunStep(-1, 0) },
    { keys: ['ArrowRight'], ...arrows, act: sunStep(1, 0) },
    { keys: ['ArrowUp'], ...arrows, act: sunStep(0, 1) },
    { keys: ['ArrowDown'], ...arrows, act: sunStep(0, -1) },
    { keys: ['a'], ...wasd, act: look(-1, 0) },
    { keys: ['d'], ...wasd, act: look(1, 0) },
    { keys: ['w'], ...wasd, act: look(0, 1) },
    { keys: ['s'], ...wasd, act: look(0, -1) },
    { keys: ['+', '='], shown: '+ −', does: 'Zoom', act: () => camera.zoom(1 / ZOOM_STEP) },
    { keys: ['-', '_'], shown: '+ −', does: 'Zoom', act: () => camera.zoom(ZOOM_STEP) },
    { keys: [...'123456789'], shown: '1 … 9', does: 'Preset', act: (event) => preset(Number(event.key) - 1) },
    { keys: ['r'], shown: 'R', does: 'Surprise me', act: surprise.act },
    { keys: ['u'], shown: 'U', does: 'Undo the surprise', act: surprise.undo },
    { keys: [' '], shown: 'Space', does: 'Play or pause the timeline', act: play },
    { keys: ['p'], shown: 'P', does: 'Show or hide the panel', act: panel },
    { keys: ['h'], shown: 'H', does: 'Hide everything but the sky', act: bare },
    { keys: ['e'], shown: 'E', does: 'Save a picture', act: save },
    { keys: ['?'], shown: '?', does: 'This help', act: help },
  ];
}

/** Fields and dialogs keep their own keys. @param {Binding[]} table */
export function listenToKeys(table) {
  window.addEventListener('keydown', (event) => {
    const target = /** @type {Element} */ (event.target);
    if (event.ctrlKey || event.metaKey || event.altKey || target.closest('input, select, textarea, dialog[open]')) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    // The key that presses a button.
    if (key === ' ' && target.closest('button, summary, a')) return;
    const binding = table.find(({ keys }) => keys.includes(key));
    if (!binding) return;
    event.preventDefault();
    binding.act(event);
  });
}

/** @param {Binding[]} table */
export function fillHelp(table) {
  const lines = new Map(table.map(({ shown, does }) => [shown, does]));
  const list = byId('help', HTMLDialogElement).querySelector('.keys');
  list?.replaceChildren(...[...lines].flatMap(([shown, does]) => [h('dt', {}, h('kbd', {}, shown)), h('dd', {}, does)]));
}
