/** Where the moon stands and how much of it is lit, and how it is moved where its place is given. */
import { limited } from './sun.js';
import { directionAngles, fromAngles, toAngles } from './vector.js';

/**
 * @typedef {import('./vector.js').Angles & {illuminated_fraction?: number, phase_angle_deg?: number, angular_diameter_deg?: number}} MoonPlace
 * Without the latter until the server has told.
 */

const POSITION = '/moon/position';

/** @param {import('./store.js').Store} store */
export function createMoon(store) {
  /** @type {MoonPlace | null} */
  let reported = null;
  const isGiven = () => Boolean(store.scene.moon?.position);
  const place = () => {
    if (!store.scene.moon) return null;
    return isGiven() ? { ...reported, ...directionAngles(store.get(POSITION)) } : reported;
  };
  return {
    /** Null where there is none. @type {() => MoonPlace | null} */
    place,
    /** True where a hand may move it: its position is a direction. */
    isGiven,
    direction: () => {
      const known = place();
      return known && fromAngles(known);
    },
    /** @param {MoonPlace | null} told */
    report: (told) => (reported = told ?? null),
    /** @param {import('./vector.js').Angles} next */
    moveTo: (next) => store.set(POSITION, limited(next)),
    /** @param {import('./vector.js').Vec3} direction */
    moveToDirection: (direction) => store.set(POSITION, limited(toAngles(direction))),
  };
}

/** @typedef {ReturnType<typeof createMoon>} Moon */

/**
 * Outline of the lit part of a disc about the origin, an SVG path: half the limb on the right, and the terminator, which
 * is half an ellipse.
 * @param {number} radius @param {number} fraction Lit share of the disc, 0 to 1
 */
export function litPath(radius, fraction) {
  const across = radius * Math.abs(1 - 2 * fraction);
  const sweep = fraction > 0.5 ? 1 : 0;
  return `M0 ${-radius}A${radius} ${radius} 0 0 1 0 ${radius}A${across} ${radius} 0 0 ${sweep} 0 ${-radius}Z`;
}
