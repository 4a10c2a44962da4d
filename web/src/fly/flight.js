/** Flying: the pilot, the hands that steer it, and what the page shows of it. */
import { byId } from '../dom.js';
import { toast } from '../toast.js';
import { createDay } from './day.js';
import { createGround } from './ground.js';
import { createHeld } from './held.js';
import { createLock } from './lock.js';
import { createPads } from './pads.js';
import { createPilot } from './pilot.js';
import { createReadout } from './readout.js';

/** One press of a speed key, and of its large sister. */
const [SPEED_STEP, LARGE_SPEED_STEP] = [1.25, 100];

/**
 * @param {HTMLCanvasElement} surface @param {import('../store.js').Store} store @param {import('../camera.js').Camera} camera
 * @param {import('../sun.js').Sun} sun @param {() => number} latitude Of the place that the page shows, degrees
 */
export function createFlight(surface, store, camera, sun, latitude) {
  const pilot = createPilot(camera, createGround(store, camera));
  const held = createHeld();
  const day = createDay(store, sun, latitude);
  const readout = createReadout(camera, pilot);
  const lock = createLock(surface, camera, pilot.isOn, () => show());
  const button = byId('fly', HTMLButtonElement);

  const speed = (/** @type {number} */ by) => () => {
    pilot.scaleSpeed(by);
    readout.speed();
  };
  const acts = {
    faster: speed(SPEED_STEP),
    slower: speed(1 / SPEED_STEP),
    muchFaster: speed(LARGE_SPEED_STEP),
    muchSlower: speed(1 / LARGE_SPEED_STEP),
    look: lock.toggle,
    controls: () => toast(pilot.toggle() ? 'The camera moves again.' : 'The camera stays where it is. T lets it move again.'),
    turbo() {
      pilot.toggleTurbo();
      readout.speed();
      show();
    },
    sun() {
      toast(day.toggle() ? 'The sun moves by itself: a day in six minutes.' : 'The sun stays where it is.');
      show();
    },
    position() {
      readout.toggle();
      show();
    },
  };
  const pads = createPads(acts);
  pilot.listen(held.read);
  pilot.listen(pads.read);

  /** Fingers get thumb sticks; a mouse is locked. */
  button.addEventListener('click', (event) => {
    const isTouch = event instanceof PointerEvent && event.pointerType === 'touch';
    if (isTouch || pads.isShown()) pads.show(!pads.isShown());
    else lock.request();
    show();
  });
  window.addEventListener('blur', held.releaseAll);
  // Ctrl + W is the browser's, and who flies down and ahead does not mean it.
  window.addEventListener('beforeunload', (event) => {
    const isDown = held.has('ControlLeft') || held.has('ControlRight');
    if (isDown && (held.count() > 1 || lock.isLocked())) event.preventDefault();
  });

  const show = () => {
    button.setAttribute('aria-pressed', String(lock.isLocked() || pads.isShown()));
    pads.update({ turbo: pilot.isTurbo(), sun: day.isOn(), position: readout.isOn() });
    readout.update();
  };
  return {
    acts,
    held,
    isLocked: lock.isLocked,
    /** @param {number} seconds Since the last step */
    step(seconds) {
      day.step(seconds);
      pilot.step(seconds);
    },
    update: show,
  };
}

/** @typedef {ReturnType<typeof createFlight>} Flight */
