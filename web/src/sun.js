/** Where the sun stands, in whichever form the scene gives it, and how it is moved. */
import { clamp, directionAngles, fromAngles, toAngles, wrap180, wrap360 } from './vector.js';

/** @typedef {import('./vector.js').Angles} Angles */

export const POSITION = '/sun/position';

/** @param {any} position @returns {boolean} */
export const isTimed = (position) => typeof position === 'object' && 'time' in position;

/** Four decimals: finer than a pixel at any field of view that a person drags in. @param {number} deg */
const tidy = (deg) => Math.round(deg * 1e4) / 1e4 + 0;

/** Into range. @param {Angles} angles @returns {Angles} */
export const limited = ({ azimuth_deg, elevation_deg }) => ({
  azimuth_deg: tidy(wrap360(azimuth_deg)),
  elevation_deg: tidy(clamp(elevation_deg, -90, 90)),
});

/** @param {import('./store.js').Store} store */
export function createSun(store) {
  /** Told by the server, since a time and a place need an almanac. @type {Angles | null} */
  let reported = null;
  const angles = () => {
    const position = store.get(POSITION);
    return isTimed(position) ? reported : directionAngles(position);
  };
  return {
    /** Null until the server has told. */
    angles,
    direction: () => {
      const known = angles();
      return known && fromAngles(known);
    },
    /** @param {Angles} place */
    report: (place) => (reported = place),
    /** @param {Angles} next */
    moveTo: (next) => store.set(POSITION, limited(next)),
    /** @param {import('./vector.js').Vec3} direction */
    moveToDirection: (direction) => store.set(POSITION, limited(toAngles(direction))),
    /** Over the zenith it comes down on the other side. @param {number} azimuth @param {number} elevation Steps, degrees */
    nudge(azimuth, elevation) {
      const from = angles();
      if (!from) return;
      const over = from.elevation_deg + elevation > 90;
      const elevation_deg = over ? 180 - from.elevation_deg - elevation : from.elevation_deg + elevation;
      store.set(POSITION, limited({ azimuth_deg: from.azimuth_deg + azimuth + (over ? 180 : 0), elevation_deg }));
    },
  };
}

/** @typedef {ReturnType<typeof createSun>} Sun */

/**
 * Moves the sun by the turn from one direction to another, as seen when facing the sun.
 * @param {Angles} sun @param {Angles} from @param {Angles} to @returns {Angles}
 */
export const turned = (sun, from, to) => ({
  azimuth_deg: sun.azimuth_deg + wrap180(to.azimuth_deg - from.azimuth_deg),
  elevation_deg: sun.elevation_deg + to.elevation_deg - from.elevation_deg,
});
