/** How high the ground is about the camera. Only the server knows its terrain: it is asked for a patch where the camera goes. */
import { postProbe } from '../api.js';
import { equal } from '../json.js';
import { clamp, combine, cross, dot, normalised } from '../vector.js';
import { altitudeAt, upAt } from './pose.js';

/** @typedef {import('../vector.js').Vec3} Vec3 */
/**
 * Heights over the sphere at the corners of a square net.
 * @typedef {object} Patch
 * @property {any} terrain What they are heights of
 * @property {Vec3} middle
 * @property {[Vec3, Vec3]} axes Level where the middle is
 * @property {number} reach From the middle to an edge, metres
 * @property {number[]} heights Row by row
 */

/** Above any terrain, metres over the sphere: from here one looks down. */
const TOP_M = 45_000;
const CELLS = 8;
/** So far one comes in this time is known; half the way there the next patch is asked for. */
const AHEAD_S = 2.5;
const LEAST_REACH_M = 4;
const RETRY_MS = 1000;

/** The heights of a patch at a place; beyond an edge those of the edge. @param {Patch} patch @param {Vec3} position */
export function heightOn({ middle, axes, reach, heights }, position) {
  const gone = combine([1, position], [-1, middle]);
  const [x, y] = axes.map((axis) => clamp((dot(gone, axis) / reach + 1) / 2, 0, 1) * CELLS);
  const [i, j] = [x, y].map((v) => Math.min(Math.floor(v), CELLS - 1));
  const at = (/** @type {number} */ column, /** @type {number} */ row) => heights[row * (CELLS + 1) + column];
  const along = (/** @type {number} */ row) => at(i, row) + (at(i + 1, row) - at(i, row)) * (x - i);
  return along(j) + (along(j + 1) - along(j)) * (y - j);
}

/**
 * The scene's ground and nothing else, seen from above a place, towards the corners of a net about it.
 * @param {any} scene @param {import('./pose.js').Pose} pose @param {number} reach
 */
export function groundProbe({ planet, terrain }, { position_m: middle, heading }, reach) {
  const up = upAt(middle, planet.radius_m);
  /** @type {[Vec3, Vec3]} */
  const axes = [cross(heading, up), heading];
  const from = combine([1, middle], [TOP_M - altitudeAt(middle, planet.radius_m), up]);
  const directions = Array.from({ length: (CELLS + 1) ** 2 }, (_, i) => {
    const [x, y] = [i % (CELLS + 1), Math.floor(i / (CELLS + 1))].map((v) => ((2 * v) / CELLS - 1) * reach);
    return normalised(combine([1, middle], [x, axes[0]], [y, axes[1]], [-1, from]));
  });
  const bare = { atmosphere: null, clouds: null, haze: null, moon: null, stars: null, shafts: null };
  return {
    request: { scene: { ...bare, planet, terrain, camera: { position_m: from } }, directions },
    /** @param {(number | null)[]} distances @returns {Patch} */
    patch(distances) {
      const height = (/** @type {number | null} */ distance, /** @type {number} */ i) =>
        distance === null ? 0 : Math.max(altitudeAt(combine([1, from], [distance, directions[i]]), planet.radius_m), 0);
      return { terrain, middle, axes, reach, heights: distances.map(height) };
    },
  };
}

/** @param {import('../store.js').Store} store @param {import('../camera.js').Camera} camera */
export function createGround(store, camera) {
  /** @type {Patch | null} */
  let known = null;
  let isAsking = false;
  const isKnown = (/** @type {number} */ reach) => {
    if (!known || !equal(known.terrain, store.scene.terrain) || reach > 2 * known.reach || reach < known.reach / 8) return false;
    return Math.hypot(...combine([1, camera.pose().position_m], [-1, known.middle])) < known.reach / 2;
  };
  const ask = async (/** @type {number} */ reach) => {
    const { request, patch } = groundProbe(store.scene, camera.pose(), reach);
    isAsking = true;
    try {
      known = patch((await postProbe(request)).distance_m);
    } catch {
      // One that refuses the scene says so of the picture; one that is busy is asked again.
      await new Promise((resolve) => setTimeout(resolve, RETRY_MS));
    } finally {
      isAsking = false;
    }
  };
  return {
    /** Under the camera, over the sphere, metres; as far as it is known. */
    height: () => (store.scene.terrain && known ? heightOn(known, camera.pose().position_m) : 0),
    /** The camera is on its way. @param {number} speed Metres a second */
    watch(speed) {
      const reach = Math.max(speed * AHEAD_S, LEAST_REACH_M);
      if (store.scene.terrain && !isAsking && camera.altitude() < TOP_M && !isKnown(reach)) ask(reach);
    },
  };
}

/** @typedef {ReturnType<typeof createGround>} Ground */
