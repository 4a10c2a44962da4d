/** Pointers and wheel on the picture: one finger or the first button drags, two fingers or another button look. */

/** @typedef {import('./view.js').Pixel} Pixel */

const ZOOM_PER_WHEEL_PX = 0.0015;
const WHEEL_LINE_PX = 16;

/**
 * @param {HTMLElement} surface @param {import('./drag.js').Drags} drags @param {import('./camera.js').Camera} camera
 */
export function listenToGestures(surface, drags, camera) {
  /** @type {Map<number, Pixel>} */
  const pointers = new Map();
  /** @type {import('./drag.js').Drag | null} */
  let drag = null;
  /** @type {{middle: Pixel, spread: number} | null} */
  let pinch = null;

  const place = (/** @type {MouseEvent} */ event) => {
    const box = surface.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  const measurePinch = () => {
    const [a, b] = [...pointers.values()];
    return { middle: { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 }, spread: Math.max(Math.hypot(a.x - b.x, a.y - b.y), 1) };
  };
  const isLook = (/** @type {PointerEvent} */ e) => e.button !== 0 || e.shiftKey || e.altKey || e.ctrlKey || e.metaKey;

  surface.addEventListener('pointerdown', (event) => {
    // A locked mouse has no place on the picture.
    if (event.pointerType === 'mouse' && (pointers.size > 0 || document.pointerLockElement)) return;
    surface.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, place(event));
    if (pointers.size === 1) {
      drag = isLook(event) ? drags.look(place(event)) : drags.begin(place(event));
      surface.dataset.dragging = 'true';
    } else if (pointers.size === 2) {
      drag = null;
      pinch = measurePinch();
    }
  });

  surface.addEventListener('pointermove', (event) => {
    if (!pointers.has(event.pointerId)) return;
    pointers.set(event.pointerId, place(event));
    drag?.move(place(event));
    if (pinch && pointers.size === 2) {
      const next = measurePinch();
      camera.drag(next.middle.x - pinch.middle.x, next.middle.y - pinch.middle.y);
      camera.zoom(pinch.spread / next.spread);
      pinch = next;
    }
  });

  const end = (/** @type {PointerEvent} */ event) => {
    pointers.delete(event.pointerId);
    drag = null;
    pinch = null;
    if (pointers.size === 0) delete surface.dataset.dragging;
  };
  surface.addEventListener('pointerup', end);
  surface.addEventListener('pointercancel', end);
  surface.addEventListener('contextmenu', (event) => event.preventDefault());

  surface.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? WHEEL_LINE_PX : 1);
      camera.zoom(Math.exp(pixels * ZOOM_PER_WHEEL_PX));
    },
    { passive: false },
  );
}
