/** Pointer lock: the mouse turns the camera until Esc. */
import { byId } from '../dom.js';
import { announce, toast } from '../toast.js';

const HINT = 'The mouse looks around. Esc gives it back.';

/**
 * @param {HTMLCanvasElement} surface @param {import('../camera.js').Camera} camera @param {() => boolean} isOn Whether hands move the camera
 * @param {() => void} changed Called when the mouse is locked or free again
 */
export function createLock(surface, camera, isOn, changed) {
  const hint = byId('lock-hint', HTMLParagraphElement);
  const isLocked = () => document.pointerLockElement === surface;
  const refused = (/** @type {unknown} */ cause) =>
    toast(`The browser does not give the mouse away: ${cause instanceof Error ? cause.message : 'not allowed'}`, { bad: true });
  const request = async () => {
    surface.focus();
    try {
      // Older browsers give no promise, and tell by an event.
      await surface.requestPointerLock();
    } catch (cause) {
      refused(cause);
    }
  };
  document.addEventListener('pointerlockchange', () => {
    hint.hidden = !isLocked();
    if (isLocked()) announce(HINT);
    changed();
  });
  document.addEventListener('mousemove', ({ movementX, movementY }) => {
    // Pulling the picture the other way is looking there.
    if (isLocked() && isOn()) camera.drag(-movementX, -movementY);
  });
  surface.addEventListener('dblclick', () => isLocked() || request());
  return { isLocked, request, toggle: () => (isLocked() ? document.exitPointerLock() : request()) };
}

/** @typedef {ReturnType<typeof createLock>} Lock */
