/** How high the ground is under the camera. Only the server knows its terrain: it is asked where the camera goes. */
import { postProbe } from '../api.js';
import { equal } from '../json.js';
import { combine } from '../vector.js';
import { altitudeAt, upAt } from './pose.js';

/** @typedef {import('../vector.js').Vec3} Vec3 */

/** Above any terrain, metres over the sphere: from here one looks straight down. */
const TOP_M = 45_000;
/** Steps shorter than this, or than this share of the height, change nothing that one sees. */
const [STEP_M, STEP_SHARE] = [0.3, 0.02];

/** The scene's ground and nothing else, seen from above a place: no air and no clouds to be computed. @param {any} scene @param {Vec3} position */
export function groundProbe({ planet, terrain }, position) {
  const up = upAt(position, planet.radius_m);
  const position_m = combine([1, position], [TOP_M - altitudeAt(position, planet.radius_m), up]);
  const bare = { atmosphere: null, clouds: null, haze: null, moon: null, stars: null, shafts: null };
  return { scene: { ...bare, planet, terrain, camera: { position_m } }, directions: [combine([-1, up])] };
}

/** @param {import('../store.js').Store} store @param {import('../camera.js').Camera} camera */
export function createGround(store, camera) {
  let height = 0;
  /** What the height belongs to. @type {{terrain: any, position: Vec3} | null} */
  let known = null;
  let isAsking = false;
  const isKnown = (/** @type {Vec3} */ position) => {
    if (!known || !equal(known.terrain, store.scene.terrain)) return false;
    const gone = Math.hypot(...combine([1, position], [-1, known.position]));
    return gone < Math.max(STEP_M, STEP_SHARE * (camera.altitude() - height));
  };
  const ask = async () => {
    const { terrain } = store.scene;
    const position = camera.pose().position_m;
    isAsking = true;
    try {
      const { distance_m: [distance] } = await postProbe(groundProbe(store.scene, position));
      height = distance === null ? 0 : Math.max(TOP_M - distance, 0);
      known = { terrain, position };
    } catch {
      // A server that is busy is asked again with the next step; one that refuses says so of the picture.
    } finally {
      isAsking = false;
    }
  };
  return {
    /** Over the sphere, metres: as the server last said, which is a step ago. */
    height: () => (store.scene.terrain ? height : 0),
    /** The camera is on its way. */
    watch() {
      if (store.scene.terrain && !isAsking && camera.altitude() < TOP_M && !isKnown(camera.pose().position_m)) ask();
    },
  };
}

/** @typedef {ReturnType<typeof createGround>} Ground */
