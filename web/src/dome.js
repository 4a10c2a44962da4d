/** The sky's dome from above, north at the top: shows sun and moon wherever they stand, and moves them. */
import { byId } from './dom.js';
import { litPath } from './moon.js';
import { compass, degrees, percent } from './text.js';
import { clamp, directionAngles, wrap360 } from './vector.js';

const RAD = Math.PI / 180;
/** End of astronomical twilight: below it no sunlight reaches the sky. */
const LOWEST_SUN_DEG = -18;
/** Radius of the horizon; the rim beyond it is the twilight down to the lowest sun. In the SVG's units. */
const HORIZON = 45;
const PER_DEGREE = HORIZON / 90;
/** Radius of the moon, and how near to it one must press to grab it, in the SVG's units. */
const [MOON, MOON_GRAB] = [3.6, 8];
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

/** @param {import('./store.js').Store} store @param {import('./sun.js').Sun} sun @param {import('./moon.js').Moon} moon */
export function createDome(store, sun, moon) {
  const figure = byId('dome', HTMLElement);
  const svg = /** @type {SVGSVGElement} */ (figure.querySelector('svg'));
  const dot = byId('dome-sun', SVGCircleElement);
  const wedge = byId('dome-view', SVGPathElement);
  const disc = byId('dome-moon', SVGGElement);
  const lit = /** @type {SVGPathElement} */ (disc.querySelector('path'));
  const [text, moonText] = ['sun-text', 'moon-text'].map((id) => byId(id, HTMLElement));

  /** What the pointer moves. @type {{moveTo: (next: import('./vector.js').Angles) => void}} */
  let grabbed = sun;
  const at = (/** @type {PointerEvent} */ event) => {
    const { left, top, width } = svg.getBoundingClientRect();
    const scale = svg.viewBox.baseVal.width / width;
    const half = svg.viewBox.baseVal.width / 2;
    return { x: (event.clientX - left) * scale - half, y: (event.clientY - top) * scale - half };
  };
  const distance = (/** @type {import('./vector.js').Angles | null} */ body, /** @type {{x: number, y: number}} */ point) => {
    if (!body) return Infinity;
    const { x, y } = domePoint(body);
    return Math.hypot(point.x - x, point.y - y);
  };
  const move = (/** @type {PointerEvent} */ event) => grabbed.moveTo(domeAngles(at(event)));
  svg.addEventListener('pointerdown', (event) => {
    svg.setPointerCapture(event.pointerId);
    const toMoon = moon.isGiven() ? distance(moon.place(), at(event)) : Infinity;
    grabbed = toMoon < Math.min(MOON_GRAB, distance(sun.angles(), at(event))) ? moon : sun;
    move(event);
  });
  svg.addEventListener('pointermove', (event) => svg.hasPointerCapture(event.pointerId) && move(event));

  /** The lit limb points to the sun. @param {import('./moon.js').MoonPlace} place @param {{x: number, y: number}} sunAt */
  const showMoon = (place, sunAt) => {
    const { x, y } = domePoint(place);
    const turn = Math.atan2(sunAt.y - y, sunAt.x - x) / RAD;
    disc.setAttribute('transform', `translate(${x} ${y}) rotate(${turn})`);
    disc.classList.toggle('sunk', place.elevation_deg < 0);
    lit.setAttribute('d', litPath(MOON, place.illuminated_fraction ?? 1));
    const share = place.illuminated_fraction === undefined ? '' : ` · ${percent(place.illuminated_fraction)}`;
    moonText.textContent = `Moon ${degrees(place.elevation_deg)}${share}`;
    moonText.title = `The moon's elevation above the horizon, azimuth ${degrees(place.azimuth_deg)}, and how much of it is lit`;
  };

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
      const place = moon.place();
      for (const part of [disc, moonText]) part.toggleAttribute('hidden', !place);
      if (place) showMoon(place, { x, y });
      text.title = `Azimuth clockwise from north (${compass(angles.azimuth_deg)}), elevation above the horizon`;
    },
  };
}
