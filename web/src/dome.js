/** The sky's dome from above, north at the top: shows the sun wherever it stands, and moves it. */
import { byId } from './dom.js';
import { LOWEST_SUN_DEG } from './sun.js';
import { compass, degrees } from './text.js';
import { clamp, directionAngles, wrap360 } from './vector.js';

const RAD = Math.PI / 180;
/** Radius of the horizon; the rim beyond it is the twilight down to the lowest sun. In the SVG's units. */
const HORIZON = 45;
const PER_DEGREE = HORIZON / 90;
/** Half the wedge that shows where the camera looks, degrees. */
const WEDGE_DEG = 28;

/** @param {import('./vector.js').Angles} angles */
export function domePoint({ azimuth_deg, elevation_deg }) {
  const r = (90 - Math.max(elevation_deg, LOWEST_SUN_DEG)) * PER_DEGREE;
  return { x: r * Math.sin(azimuth_deg * RAD), y: -r * Math.cos(azimuth_deg * RAD) };
}

/** Inverse of {@link domePoint}. @param {{x: number, y: number}} point @returns {import('./vector.js').Angles} */
export const domeAngles = ({ x, y }) => ({
  azimuth_deg: wrap360(Math.atan2(x, -y) / RAD),
  elevation_deg: clamp(90 - Math.hypot(x, y) / PER_DEGREE, LOWEST_SUN_DEG, 90),
});

/** @param {import('./store.js').Store} store @param {import('./sun.js').Sun} sun */
export function createDome(store, sun) {
  const figure = byId('dome', HTMLElement);
  const svg = /** @type {SVGSVGElement} */ (figure.querySelector('svg'));
  const dot = byId('dome-sun', SVGCircleElement);
  const wedge = byId('dome-view', SVGPathElement);
  const text = byId('sun-text', HTMLElement);

  const move = (/** @type {PointerEvent} */ event) => {
    const { left, top, width } = svg.getBoundingClientRect();
    const scale = svg.viewBox.baseVal.width / width;
    const half = svg.viewBox.baseVal.width / 2;
    sun.moveTo(domeAngles({ x: (event.clientX - left) * scale - half, y: (event.clientY - top) * scale - half }));
  };
  svg.addEventListener('pointerdown', (event) => {
    svg.setPointerCapture(event.pointerId);
    move(event);
  });
  svg.addEventListener('pointermove', (event) => svg.hasPointerCapture(event.pointerId) && move(event));

  return {
    update() {
      const looking = directionAngles(store.scene.camera.direction).azimuth_deg;
      const [a, b] = [looking - WEDGE_DEG, looking + WEDGE_DEG].map((azimuth_deg) => domePoint({ azimuth_deg, elevation_deg: 0 }));
      wedge.setAttribute('d', `M0 0L${a.x} ${a.y}A${HORIZON} ${HORIZON} 0 0 1 ${b.x} ${b.y}Z`);
      const angles = sun.angles();
      dot.toggleAttribute('hidden', !angles);
      if (!angles) return;
      const { x, y } = domePoint(angles);
      dot.setAttribute('cx', String(x));
      dot.setAttribute('cy', String(y));
      text.textContent = `${degrees(angles.azimuth_deg)} · ${degrees(angles.elevation_deg)}`;
      text.title = `Azimuth clockwise from north (${compass(angles.azimuth_deg)}), elevation above the horizon`;
    },
  };
}
