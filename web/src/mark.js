/** The ring round the sun on the picture, and the arrow towards a sun out of view. */
import { byId } from './dom.js';
import { degrees } from './text.js';
import { clamp } from './vector.js';

/** Distance of the arrow from the edge of what is free, pixels. */
const EDGE_PX = 30;

/**
 * Where a ray from the middle of a box leaves it.
 * @param {import('./stage.js').Box} box @param {import('./view.js').Pixel} step @param {number} margin
 */
export function edgePoint(box, step, margin) {
  const [halfX, halfY] = [box.width / 2 - margin, box.height / 2 - margin];
  const reach = Math.min(halfX / Math.abs(step.x || 1e-9), halfY / Math.abs(step.y || 1e-9));
  return { x: box.x + box.width / 2 + step.x * reach, y: box.y + box.height / 2 + step.y * reach };
}

/**
 * @param {import('./sun.js').Sun} sun @param {import('./camera.js').Camera} camera @param {import('./stage.js').Stage} stage
 */
export function createMark(sun, camera, stage) {
  /** The window without the bar, and without the panel where it stands at the side. @returns {import('./stage.js').Box} */
  const free = () => {
    const [bar, panel] = ['.bar', '#panel'].map((s) => /** @type {Element} */ (document.querySelector(s)).getBoundingClientRect());
    const beside = panel.width > 0 && panel.left > window.innerWidth / 2;
    const under = panel.width > 0 && !beside;
    const [right, bottom] = [beside ? panel.left : window.innerWidth, under ? panel.top : window.innerHeight];
    return { x: 0, y: bar.bottom, width: right, height: bottom - bar.bottom };
  };
  const ring = byId('sun-mark', HTMLDivElement);
  const text = byId('sun-mark-text', HTMLOutputElement);
  const arrow = byId('sun-arrow', HTMLDivElement);
  return {
    update() {
      const angles = sun.angles();
      const direction = sun.direction();
      const box = stage.box();
      const view = camera.view();
      const at = direction && view.project(direction);
      const seen = at && clamp(at.x, 0, box.width) === at.x && clamp(at.y, 0, box.height) === at.y;
      ring.hidden = !seen;
      arrow.hidden = Boolean(seen) || !direction || !view.free;
      if (direction && at && seen && angles) {
        ring.style.transform = `translate(${box.x + at.x}px, ${box.y + at.y}px)`;
        ring.classList.toggle('sunk', camera.elevationDeg(direction) < camera.horizonDeg());
        text.value = `${degrees(angles.azimuth_deg)}  ${degrees(angles.elevation_deg)}`;
      }
      if (!arrow.hidden && direction) {
        const step = view.bearing(direction);
        const { x, y } = edgePoint(free(), step, EDGE_PX);
        arrow.style.transform = `translate(${x}px, ${y}px) rotate(${Math.atan2(step.y, step.x)}rad)`;
      }
    },
  };
}
