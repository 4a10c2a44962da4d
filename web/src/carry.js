/** When a part takes another shape, what the old one says is kept where the new one can say it. */
import { isObject } from './json.js';
import { directionAngles, fromAngles } from './vector.js';

const SUNNY_EV = 15;

/**
 * @param {any} value The part as it was @param {any} fresh The new shape, holding defaults
 * @param {object} known
 * @param {() => import('./vector.js').Angles | null} known.sun Where the sun stands now
 * @param {() => number | null} known.ev What the last picture was exposed with
 * @param {() => any} known.timeAndPlace
 * @param {() => string | Promise<string>} known.mapName A weather map that the server has
 * @param {() => Promise<string>} known.meshName A mesh that the server has
 * @param {() => any} known.mountains Mountains from a seed
 * @returns {any} A promise where the server must be asked
 */
export function carryOver(value, fresh, known) {
  if (isObject(fresh) && 'time' in fresh) return known.timeAndPlace();
  if (isObject(fresh) && fresh.kind === 'ev') return { ...fresh, ev: Math.round((known.ev() ?? SUNNY_EV) * 10) / 10 };
  if (isObject(value) && isObject(fresh) && 'extent_m' in value && 'extent_m' in fresh) fresh = { ...fresh, extent_m: value.extent_m };
  if (isObject(fresh) && fresh.kind === 'asset') return Promise.resolve(known.mapName()).then((name) => ({ ...fresh, name }));
  if (isObject(fresh) && fresh.kind === 'mesh') return known.meshName().then((name) => ({ ...fresh, name }));
  if (isObject(fresh) && fresh.kind === 'heightfield') return known.mountains();
  const isDirection = Array.isArray(fresh) || (isObject(fresh) && 'azimuth_deg' in fresh);
  if (!isDirection) return fresh;
  const angles = isObject(value) && 'time' in value ? known.sun() : directionAngles(value);
  if (!angles) return fresh;
  return Array.isArray(fresh) ? fromAngles(angles).map((v) => Number(v.toFixed(6))) : angles;
}
