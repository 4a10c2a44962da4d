/** The sun moves by itself, as on a day that is much faster. */
import { combine, cross, dot, fromAngles } from '../vector.js';
import { isTimed, POSITION } from '../sun.js';

/** @typedef {import('../vector.js').Vec3} Vec3 */

/** A day in six minutes: a degree of the sun's circle a second. */
export const DAY_SPEED = 240;
const DEGREES_PER_SECOND = 360 / 86_400;
const RAD = Math.PI / 180;

/**
 * Where a body goes as the sky turns about its pole: v cos a + (k × v) sin a + k (k·v)(1 - cos a) with k the pole.
 * Seen from the north the sky turns clockwise.
 * @param {Vec3} body @param {number} latitudeDeg @param {number} degrees @returns {Vec3}
 */
export function carriedBySky(body, latitudeDeg, degrees) {
  const pole = fromAngles({ azimuth_deg: 0, elevation_deg: latitudeDeg });
  const [c, s] = [Math.cos(-degrees * RAD), Math.sin(-degrees * RAD)];
  return combine([c, body], [s, cross(pole, body)], [dot(pole, body) * (1 - c), pole]);
}

/**
 * @param {import('../store.js').Store} store @param {import('../sun.js').Sun} sun
 * @param {() => number} latitude Of the place that the page shows, degrees
 */
export function createDay(store, sun, latitude) {
  let isOn = false;
  /** Not rounded to what the scene holds. @type {{written: any, direction: Vec3} | {written: any, ms: number} | null} */
  let exact = null;
  const write = (/** @type {any} */ position) => {
    store.set(POSITION, position);
    return store.get(POSITION);
  };
  return {
    isOn: () => isOn,
    toggle: () => (isOn = !isOn),
    /** @param {number} seconds Since the last step */
    step(seconds) {
      if (!isOn) return;
      const position = store.get(POSITION);
      const known = exact && exact.written === position ? exact : null;
      if (isTimed(position)) {
        const ms = (known && 'ms' in known ? known.ms : Date.parse(position.time)) + seconds * 1000 * DAY_SPEED;
        const time = new Date(Math.round(ms / 1000) * 1000).toISOString().replace('.000Z', 'Z');
        exact = { written: write({ ...position, time }), ms };
        return;
      }
      const from = known && 'direction' in known ? known.direction : sun.direction();
      if (!from) return;
      const direction = carriedBySky(from, latitude(), seconds * DAY_SPEED * DEGREES_PER_SECOND);
      sun.moveToDirection(direction);
      exact = { written: store.get(POSITION), direction };
    },
  };
}
