/** Turning the camera and changing its field of view. */
import { createView } from './view.js';
import { angleBetween, clamp, directionAngles, wrap360 } from './vector.js';

const DIRECTION = '/camera/direction';
const RAD = Math.PI / 180;
/** Wide enough for any view, and short of what each projection can show. @type {Record<string, [string, number, number]>} */
const FIELDS = { perspective: ['vertical_fov_deg', 0.5, 140], fisheye: ['fov_deg', 5, 300] };

/** @param {import('./store.js').Store} store @param {import('./stage.js').Stage} stage */
export function createCamera(store, stage) {
  /** The projection on the picture's box, whose corner is the origin. */
  const view = () => {
    const { width, height } = stage.box();
    return createView(store.scene.camera, width, height);
  };
  /** Degrees that one pixel spans in the middle of the picture. */
  const degreesPerPixel = () => {
    const { width, height } = stage.box();
    const { unproject } = view();
    const middle = { x: width / 2, y: height / 2 };
    return angleBetween(unproject(middle), unproject({ x: middle.x, y: middle.y + 1 }));
  };
  /** @param {number} azimuth @param {number} elevation Steps, degrees */
  const turn = (azimuth, elevation) => {
    if (!view().free) return;
    const { azimuth_deg, elevation_deg } = directionAngles(store.get(DIRECTION));
    store.set(DIRECTION, {
      azimuth_deg: Math.round(wrap360(azimuth_deg + azimuth) * 1e4) / 1e4,
      elevation_deg: Math.round(clamp(elevation_deg + elevation, -90, 90) * 1e4) / 1e4,
    });
  };
  return {
    view,
    turn,
    /** The picture follows the hand. @param {number} dx @param {number} dy Pixels on the screen */
    drag(dx, dy) {
      const step = degreesPerPixel();
      const roll = store.scene.camera.roll_deg * RAD;
      const [right, down] = [dx * Math.cos(roll) + dy * Math.sin(roll), dy * Math.cos(roll) - dx * Math.sin(roll)];
      const { elevation_deg } = directionAngles(store.get(DIRECTION));
      // Meridians draw together towards the zenith; a floor keeps the camera from spinning there.
      turn((-right * step) / Math.max(Math.cos(elevation_deg * RAD), 0.2), down * step);
    },
    /** @param {number} factor Above 1 shows more */
    zoom(factor) {
      const { projection } = store.scene.camera;
      const field = FIELDS[projection.kind];
      if (!field) return;
      const [name, least, most] = field;
      const next = clamp(projection[name] * factor, least, most);
      store.set(`/camera/projection/${name}`, Number(next.toPrecision(5)));
    },
    /** Elevation of the horizon: below 0 as the observer rises. */
    horizonDeg() {
      const { radius_m } = store.scene.planet;
      const [x, y, z] = store.scene.camera.position_m;
      const distance = Math.hypot(x, y, z + radius_m);
      return -Math.acos(clamp(radius_m / distance, 0, 1)) / RAD;
    },
  };
}

/** @typedef {ReturnType<typeof createCamera>} Camera */
