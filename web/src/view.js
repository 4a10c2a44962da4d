/**
 * The camera of a scene on a picture of a given size: world direction to pixel and back.
 * Pixels have their origin in the upper left corner, y down.
 */
import { fisheye, perspective } from './lens.js';
import { clamp, combine, cross, directionAngles, dot, fromAngles, toAngles, wrap360 } from './vector.js';

/** @typedef {import('./vector.js').Vec3} Vec3 */
/** @typedef {{x: number, y: number}} Pixel */
/**
 * @typedef {object} View
 * @property {(direction: Vec3) => Pixel | null} project Null where the direction has no place on the picture's plane.
 * @property {(pixel: Pixel) => Vec3} unproject The direction seen at a pixel, or the nearest that can be seen.
 * @property {(direction: Vec3) => Pixel} bearing Unit step on the picture towards a direction, from the centre.
 * @property {boolean} free True where the camera's direction and field of view act on the picture.
 */

const RAD = Math.PI / 180;

/**
 * Right, up and forward of a camera, the picture turned clockwise by the roll.
 * Straight up or down the azimuth still says where the right-hand side is.
 * @param {any} camera
 */
export function axes(camera) {
  const angles = directionAngles(camera.direction);
  const forward = fromAngles(angles);
  const right = fromAngles({ azimuth_deg: angles.azimuth_deg + 90, elevation_deg: 0 });
  const up = cross(right, forward);
  const [c, s] = [Math.cos(camera.roll_deg * RAD), Math.sin(camera.roll_deg * RAD)];
  return { right: combine([c, right], [s, up]), up: combine([c, up], [-s, right]), forward };
}

/** @param {any} camera @param {number} width @param {number} height @returns {View} */
export function createView(camera, width, height) {
  const { kind } = camera.projection;
  if (kind === 'equirectangular') return equirectangular(width, height);
  if (kind === 'cubemap') return cubemap(width, height);
  const { right, up, forward } = axes(camera);
  const lens =
    kind === 'fisheye'
      ? fisheye(camera.projection.fov_deg, camera.projection.mapping, Math.min(width, height) / 2)
      : perspective(camera.projection.vertical_fov_deg, height / 2);
  const local = (/** @type {Vec3} */ d) => /** @type {Vec3} */ ([dot(d, right), dot(d, up), dot(d, forward)]);
  return {
    free: true,
    project(direction) {
      const point = lens.project(local(direction));
      return point && { x: width / 2 + point[0], y: height / 2 - point[1] };
    },
    unproject({ x, y }) {
      const [r, u, f] = lens.unproject([x - width / 2, height / 2 - y]);
      return combine([r, right], [u, up], [f, forward]);
    },
    bearing(direction) {
      const [r, u] = local(direction);
      const length = Math.hypot(r, u) || 1;
      return { x: r / length, y: -u / length };
    },
  };
}

/** Left edge west, centre east, zenith at the top. @param {number} width @param {number} height @returns {View} */
function equirectangular(width, height) {
  return {
    free: false,
    project(direction) {
      const { azimuth_deg, elevation_deg } = toAngles(direction);
      return { x: (wrap360(azimuth_deg + 90) / 360) * width, y: ((90 - elevation_deg) / 180) * height };
    },
    unproject: ({ x, y }) =>
      fromAngles({
        azimuth_deg: (x / width) * 360 - 90,
        elevation_deg: clamp(90 - (y / height) * 180, -90, 90),
      }),
    bearing: () => ({ x: 0, y: 0 }),
  };
}

/**
 * Right, up and outward axis of each face in the world frame, in the strip's order (+x, -x, +y, -y, +z, -z of three.js,
 * whose y is our z and whose z is our -y), as OpenGL lays out cube maps.
 * @type {[Vec3, Vec3, Vec3][]}
 */
const FACES = [
  [[0, 1, 0], [0, 0, 1], [1, 0, 0]],
  [[0, -1, 0], [0, 0, 1], [-1, 0, 0]],
  [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  [[1, 0, 0], [0, -1, 0], [0, 0, -1]],
  [[1, 0, 0], [0, 0, 1], [0, -1, 0]],
  [[-1, 0, 0], [0, 0, 1], [0, 1, 0]],
];

/** @param {number} width @param {number} height @returns {View} */
function cubemap(width, height) {
  const side = width / 6;
  const tall = height / 2;
  return {
    free: false,
    project(direction) {
      const depths = FACES.map(([, , outward]) => dot(direction, outward));
      const face = depths.indexOf(Math.max(...depths));
      const [right, up] = FACES[face];
      const depth = depths[face];
      return {
        x: side * (face + 0.5 + dot(direction, right) / depth / 2),
        y: tall * (1 - dot(direction, up) / depth),
      };
    },
    unproject({ x, y }) {
      const face = clamp(Math.floor(x / side), 0, 5);
      const [right, up, outward] = FACES[face];
      const v = combine([2 * (x / side - face) - 1, right], [1 - y / tall, up], [1, outward]);
      return combine([1 / Math.hypot(...v), v]);
    },
    bearing: () => ({ x: 0, y: 0 }),
  };
}
