/** Two thumb sticks and buttons for screens without a keyboard. */
import { byId } from '../dom.js';
import { STILL } from './pilot.js';

/** @typedef {import('./pilot.js').Intent} Intent */

/** Thumbs tremble: this share of the stick's way counts as none. */
const DEAD = 0.12;

/**
 * How far a stick is pushed, by its offset from the middle over its radius: right and up from -1 to 1.
 * @param {number} x @param {number} y Down, as pixels have it
 */
export function pushed(x, y) {
  const reach = Math.hypot(x, y);
  const push = Math.max(Math.min(reach, 1) - DEAD, 0) / (1 - DEAD);
  return reach === 0 ? { right: 0, up: 0 } : { right: (x / reach) * push, up: (-y / reach) * push + 0 };
}

/**
 * Calls back with a stick's push as long as a finger holds it.
 * @param {HTMLElement} stick @param {(push: {right: number, up: number}) => void} push
 */
function listenToStick(stick, push) {
  const knob = /** @type {HTMLElement} */ (stick.firstElementChild);
  const show = (/** @type {{right: number, up: number}} */ at) => {
    push(at);
    knob.style.transform = `translate(${at.right * 100}%, ${-at.up * 100}%)`;
  };
  const follow = (/** @type {PointerEvent} */ event) => {
    const { left, top, width, height } = stick.getBoundingClientRect();
    show(pushed((event.clientX - left) / (width / 2) - 1, (event.clientY - top) / (height / 2) - 1));
  };
  stick.addEventListener('pointerdown', (event) => {
    stick.setPointerCapture(event.pointerId);
    follow(event);
  });
  stick.addEventListener('pointermove', (event) => stick.hasPointerCapture(event.pointerId) && follow(event));
  stick.addEventListener('lostpointercapture', () => show({ right: 0, up: 0 }));
}

/** @param {Record<string, () => void>} acts What the buttons do, by their `data-fly` */
export function createPads(acts) {
  const pads = byId('pads', HTMLDivElement);
  let asked = STILL;
  const part = (/** @type {string} */ name) => /** @type {HTMLElement} */ (pads.querySelector(`[data-stick="${name}"]`));
  listenToStick(part('move'), ({ right, up }) => (asked = { ...asked, right, ahead: up }));
  listenToStick(part('look'), ({ right, up }) => (asked = { ...asked, turn: right, pitch: up }));
  for (const button of pads.querySelectorAll('button')) {
    const { rise, fly } = button.dataset;
    if (fly) button.addEventListener('click', acts[fly]);
    if (!rise) continue;
    const hold = (/** @type {number} */ up) => (asked = { ...asked, up });
    button.addEventListener('pointerdown', (event) => {
      button.setPointerCapture(event.pointerId);
      hold(Number(rise));
    });
    button.addEventListener('lostpointercapture', () => hold(0));
    button.addEventListener('keydown', ({ key }) => [' ', 'Enter'].includes(key) && hold(Number(rise)));
    for (const name of ['keyup', 'blur']) button.addEventListener(name, () => hold(0));
  }
  return {
    /** @returns {Intent} */
    read: () => asked,
    isShown: () => !pads.hidden,
    /** @param {boolean} shown */
    show(shown) {
      pads.hidden = !shown;
      asked = STILL;
    },
    /** @param {Record<string, boolean>} states Which of the buttons are on */
    update(states) {
      for (const [name, isOn] of Object.entries(states)) pads.querySelector(`[data-fly="${name}"]`)?.setAttribute('aria-pressed', String(isOn));
    },
  };
}
