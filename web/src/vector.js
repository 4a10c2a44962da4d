/** Vectors and directions of the world frame: x east, y north, z up. */

/** @typedef {[number, number, number]} Vec3 */
/** @typedef {{azimuth_deg: number, elevation_deg: number}} Angles Azimuth clockwise from north, elevation up. */

const RAD = Math.PI / 180;

/** @param {Vec3} a @param {Vec3} b */
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** @param {Vec3} a @param {Vec3} b @returns {Vec3} */
export const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** Σ weight · vector. @param {...[number, Vec3]} terms @returns {Vec3} */
export const combine = (...terms) => {
  const at = (/** @type {0 | 1 | 2} */ i) => terms.reduce((sum, [k, v]) => sum + k * v[i], 0);
  return [at(0), at(1), at(2)];
};

/** @param {Vec3} v @returns {Vec3} */
export const normalised = (v) => combine([1 / Math.hypot(...v), v]);

/** The unit vector of an azimuth and an elevation. @param {Angles} angles @returns {Vec3} */
export function fromAngles({ azimuth_deg, elevation_deg }) {
  const [az, el] = [azimuth_deg * RAD, elevation_deg * RAD];
  return [Math.sin(az) * Math.cos(el), Math.cos(az) * Math.cos(el), Math.sin(el)];
}

/** Inverse of {@link fromAngles}; azimuth in 0..360. @param {Vec3} v @returns {Angles} */
export function toAngles([x, y, z]) {
  const azimuth_deg = wrap360(Math.atan2(x, y) / RAD);
  return { azimuth_deg, elevation_deg: Math.atan2(z, Math.hypot(x, y)) / RAD };
}

/** Angle between two unit vectors, degrees. @param {Vec3} a @param {Vec3} b */
export const angleBetween = (a, b) => Math.atan2(Math.hypot(...cross(a, b)), dot(a, b)) / RAD;

/** Into 0..360. @param {number} deg */
export const wrap360 = (deg) => ((deg % 360) + 360) % 360;

/** Into -180..180. @param {number} deg */
export const wrap180 = (deg) => wrap360(deg + 180) - 180;

/** @param {number} value @param {number} low @param {number} high */
export const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

/** Either form of a direction in a scene as angles. @param {Angles | Vec3} direction @returns {Angles} */
export const directionAngles = (direction) => (Array.isArray(direction) ? toAngles(direction) : direction);
