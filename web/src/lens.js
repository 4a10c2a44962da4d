/**
 * How directions fall on the picture, and back: one pair of functions a projection.
 *
 * Camera frame: x right, y up, z forward. Picture coordinates have their origin in the centre, x right, y up, and the
 * unit in which `half` (half the picture's height, or the fisheye's radius) is given.
 */
import { clamp } from './vector.js';

/** @typedef {import('./vector.js').Vec3} Vec3 */
/** @typedef {[number, number]} Point */
/**
 * @typedef {object} Lens
 * @property {(d: Vec3) => Point | null} project Null where the direction has no place on the picture's plane.
 * @property {(p: Point) => Vec3} unproject The nearest direction that the projection can show.
 */

const RAD = Math.PI / 180;

/**
 * r = half · tan θ / tan(fov / 2).
 * @param {number} fovDeg Between lower and upper edge @param {number} half @returns {Lens}
 */
export function perspective(fovDeg, half) {
  const focal = half / Math.tan((fovDeg * RAD) / 2);
  return {
    project: ([x, y, z]) => (z > 1e-9 ? [(focal * x) / z, (focal * y) / z] : null),
    unproject: ([x, y]) => {
      const length = Math.hypot(x, y, focal);
      return [x / length, y / length, focal / length];
    },
  };
}

/** Radius as a function of the angle from the axis, and its inverse. @type {Record<string, [(t: number) => number, (r: number) => number]>} */
const MAPPINGS = {
  equidistant: [(t) => t, (r) => r],
  equisolid: [(t) => Math.sin(t / 2), (r) => 2 * Math.asin(clamp(r, -1, 1))],
  stereographic: [(t) => Math.tan(t / 2), (r) => 2 * Math.atan(r)],
};

/**
 * r = half · m(θ) / m(fov / 2).
 * @param {number} fovDeg Across the circle @param {string} mapping @param {number} half @returns {Lens}
 */
export function fisheye(fovDeg, mapping, half) {
  const [radius, angle] = MAPPINGS[mapping] ?? MAPPINGS.equidistant;
  const edge = (fovDeg * RAD) / 2;
  const scale = half / radius(edge);
  return {
    project: ([x, y, z]) => {
      const sine = Math.hypot(x, y);
      const theta = Math.atan2(sine, z);
      if (theta > edge + 1e-9) return null;
      const r = scale * radius(theta);
      return sine === 0 ? [0, 0] : [(r * x) / sine, (r * y) / sine];
    },
    unproject: ([x, y]) => {
      const r = Math.hypot(x, y);
      const theta = Math.min(angle(Math.min(r, half) / scale), edge);
      return r === 0 ? [0, 0, 1] : [(Math.sin(theta) * x) / r, (Math.sin(theta) * y) / r, Math.cos(theta)];
    },
  };
}
