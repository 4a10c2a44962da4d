/** The keyboard: one table says what each key does, and the help shows the same table. */
import { byId, h } from './dom.js';

const SUN_STEP_DEG = 1;
const FINE_STEP_DEG = 0.1;
const ZOOM_STEP = 1.1;

/**
 * A key acts once when it goes down, or asks something of the pilot as long as it is held.
 * @typedef {object} Binding
 * @property {string[]} keys
 * @property {string} shown
 * @property {string} does
 * @property {string} group
 * @property {(event: KeyboardEvent) => void} [act]
 * @property {Partial<import('./fly/pilot.js').Intent>} [asks]
 */

/**
 * @param {object} parts
 * @param {import('./sun.js').Sun} parts.sun
 * @param {import('./camera.js').Camera} parts.camera
 * @param {import('./fly/flight.js').Flight} parts.flight
 * @param {(index: number) => void} parts.preset
 * @param {() => void} parts.panel
 * @param {() => void} parts.device
 * @param {() => void} parts.bare
 * @param {() => void} parts.save
 * @param {() => void} parts.play
 * @param {{act: () => void, undo: () => void}} parts.surprise
 * @param {() => void} parts.help
 * @returns {Binding[]}
 */
export function bindings({ sun, camera, flight: { acts }, preset, panel, device, bare, save, play, surprise, help }) {
  const sunStep = (/** @type {number} */ az, /** @type {number} */ el) => (/** @type {KeyboardEvent} */ event) => {
    const step = event.shiftKey ? FINE_STEP_DEG : SUN_STEP_DEG;
    sun.nudge(az * step, el * step);
  };
  const arrows = { group: 'Sky', shown: '← → ↑ ↓', does: 'Move the sun, with Shift in fine steps' };
  const wasd = { group: 'Camera', shown: 'W A S D', does: 'Walk ahead, left, back and right; in the air, fly where you look' };
  const rise = { group: 'Camera', shown: 'Space, Ctrl or C', does: 'Up and down' };
  const turn = { group: 'Camera', shown: 'Q E R F', does: 'Turn left and right, look up and down' };
  const turbo = { group: 'Camera', shown: 'Shift, Z', does: 'Ten times as fast, while held or until pressed again' };
  const speed = { group: 'Camera', shown: '+ − * /', does: 'Faster, slower, by a quarter or a hundredfold' };
  const zoom = { group: 'Camera', shown: 'Page ↑ ↓', does: 'Zoom' };
  return [
    { keys: ['w'], ...wasd, asks: { ahead: 1 } },
    { keys: ['s'], ...wasd, asks: { ahead: -1 } },
    { keys: ['a'], ...wasd, asks: { right: -1 } },
    { keys: ['d'], ...wasd, asks: { right: 1 } },
    { keys: [' '], ...rise, asks: { up: 1 } },
    { keys: ['Control', 'c'], ...rise, asks: { up: -1 } },
    { keys: ['q'], ...turn, asks: { turn: -1 } },
    { keys: ['e'], ...turn, asks: { turn: 1 } },
    { keys: ['r'], ...turn, asks: { pitch: 1 } },
    { keys: ['f'], ...turn, asks: { pitch: -1 } },
    { keys: ['Shift'], ...turbo, asks: { turbo: 1 } },
    { keys: ['z'], ...turbo, act: acts.turbo },
    { keys: ['+', '='], ...speed, act: acts.faster },
    { keys: ['-', '_'], ...speed, act: acts.slower },
    { keys: ['*'], ...speed, act: acts.muchFaster },
    { keys: ['/'], ...speed, act: acts.muchSlower },
    { keys: ['o'], group: 'Camera', shown: 'O', does: 'Look with the mouse, as a double click does; Esc ends it', act: acts.look },
    { keys: ['PageUp'], ...zoom, act: () => camera.zoom(1 / ZOOM_STEP) },
    { keys: ['PageDown'], ...zoom, act: () => camera.zoom(ZOOM_STEP) },
    { keys: ['p'], group: 'Camera', shown: 'P', does: 'Position, height and speed', act: acts.position },
    { keys: ['t'], group: 'Camera', shown: 'T', does: 'Hold the camera still, or let it move again', act: acts.controls },
    { keys: ['ArrowLeft'], ...arrows, act: sunStep(-1, 0) },
    { keys: ['ArrowRight'], ...arrows, act: sunStep(1, 0) },
    { keys: ['ArrowUp'], ...arrows, act: sunStep(0, 1) },
    { keys: ['ArrowDown'], ...arrows, act: sunStep(0, -1) },
    { keys: ['m'], group: 'Sky', shown: 'M', does: 'The sun moves by itself', act: acts.sun },
    { keys: [...'123456789'], group: 'Sky', shown: '1 … 9', does: 'Preset', act: (event) => preset(Number(event.key) - 1) },
    { keys: ['n'], group: 'Sky', shown: 'N', does: 'Surprise me', act: surprise.act },
    { keys: ['u'], group: 'Sky', shown: 'U', does: 'Undo the surprise', act: surprise.undo },
    { keys: ['k'], group: 'Sky', shown: 'K', does: 'Play or pause the timeline', act: play },
    { keys: ['i'], group: 'Page', shown: 'I', does: 'Show or hide the panel', act: panel },
    { keys: ['b'], group: 'Page', shown: 'B', does: 'Hide everything but the sky', act: bare },
    { keys: ['g'], group: 'Page', shown: 'G', does: 'Save a picture', act: save },
    { keys: ['v'], group: 'Page', shown: 'V', does: 'What renders, and how long it takes', act: device },
    { keys: ['h', '?'], group: 'Page', shown: 'H or ?', does: 'This help', act: help },
  ];
}

/** The letter on the key in Latin script, whatever the script of the keyboard. @param {KeyboardEvent} event */
function keyName({ key, code }) {
  if (key.length > 1) return key;
  return key.charCodeAt(0) < 128 ? key.toLowerCase() : code.replace(/^Key/, '').toLowerCase();
}

const FIELDS = 'input, select, textarea, dialog[open]';
const PRESSED_BY_SPACE = 'button, summary, a';

/**
 * Fields and dialogs keep their own keys, and the browser those with Ctrl, but for who flies already.
 * @param {Binding[]} table @param {import('./fly/flight.js').Flight} flight
 */
export function listenToKeys(table, { held, isLocked }) {
  window.addEventListener('keydown', (event) => {
    const target = /** @type {Element} */ (event.target);
    const isOther = event.metaKey || event.altKey || target.closest(FIELDS);
    const key = keyName(event);
    const isBrowsers = event.ctrlKey && key !== 'Control' && !held.has(event.code) && !isLocked();
    if (isOther || isBrowsers) return held.releaseAll();
    if (event.defaultPrevented || (key === ' ' && target.closest(PRESSED_BY_SPACE))) return;
    const binding = table.find(({ keys }) => keys.includes(key));
    if (!binding) return;
    // Shift and Ctrl alone do nothing that could be prevented, and assistive tools listen to them.
    if (key.length === 1 || binding.act) event.preventDefault();
    if (binding.asks) held.press(event.code, binding.asks);
    else binding.act?.(event);
  });
  window.addEventListener('keyup', ({ code }) => held.release(code));
  window.addEventListener('focusin', ({ target }) => {
    if (/** @type {Element} */ (target).closest(FIELDS)) held.releaseAll();
  });
}

/** @param {Binding[]} table */
export function fillHelp(table) {
  const help = byId('help', HTMLDialogElement);
  const sections = [...new Set(table.map(({ group }) => group))].map((name) => {
    const lines = new Map(table.filter(({ group }) => group === name).map(({ shown, does }) => [shown, does]));
    const rows = [...lines].flatMap(([shown, does]) => [h('dt', {}, h('kbd', {}, shown)), h('dd', {}, does)]);
    return h('section', {}, h('h3', {}, name), h('dl', {}, ...rows));
  });
  help.querySelector('.keys')?.replaceChildren(...sections);
  help.addEventListener('keydown', (event) => {
    if (!['h', '?'].includes(event.key.toLowerCase())) return;
    event.preventDefault();
    help.close();
  });
}
