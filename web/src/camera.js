/** Placing and turning the camera, and changing its field of view. */
import { altitudeAt, readPose, turned, upAt, writePose } from './fly/pose.js';
import { equal } from './json.js';
import { createView } from './view.js';
import { angleBetween, clamp, dot } from './vector.js';

const RAD = Math.PI / 180;
/** Wide enough for any view, and short of what each projection can show. @type {Record<string, [string, number, number]>} */
const FIELDS = { perspective: ['vertical_fov_deg', 0.5, 140], fisheye: ['fov_deg', 5, 300] };
/** What a projection without a field of its own shows, degrees. */
const WHOLE_DEG = 180;

/** @param {import('./store.js').Store} store @param {import('./stage.js').Stage} stage */
export function createCamera(store, stage) {
  /** The projection on the picture's box, whose corner is the origin. */
  const view = () => {
    const { width, height } = stage.box();
    return createView(store.scene.camera, width, height);
  };
  const radius = () => store.scene.planet.radius_m;
  /** Not rounded, so that small steps add up; true while the scene holds what was written of it. @type {{pose: import('./fly/pose.js').Pose, written: any} | null} */
  let exact = null;
  const pose = () => {
    const { position_m, direction, roll_deg } = store.scene.camera;
    return exact && equal(exact.written, { position_m, direction, roll_deg }) ? exact.pose : readPose(store.scene.camera, radius());
  };
  /** @param {import('./fly/pose.js').Pose} next */
  const place = (next) => {
    exact = { pose: next, written: writePose(next, radius()) };
    store.set('/camera', { ...store.scene.camera, ...exact.written });
  };
  /** Degrees that one pixel spans in the middle of the picture. */
  const degreesPerPixel = () => {
    const { width, height } = stage.box();
    const { unproject } = view();
    const middle = { x: width / 2, y: height / 2 };
    return angleBetween(unproject(middle), unproject({ x: middle.x, y: middle.y + 1 }));
  };
  const altitude = () => altitudeAt(store.scene.camera.position_m, radius());
  return {
    view,
    pose,
    place,
    radius,
    altitude,
    /** True where turning the camera acts on the picture. */
    isFree: () => view().free,
    fieldDeg() {
      const { projection } = store.scene.camera;
      const field = FIELDS[projection.kind];
      return field ? projection[field[0]] : WHOLE_DEG;
    },
    /** The picture follows the hand. @param {number} dx @param {number} dy Pixels on the screen */
    drag(dx, dy) {
      if (!view().free) return;
      const step = degreesPerPixel();
      const from = pose();
      const roll = from.roll_deg * RAD;
      const [right, down] = [dx * Math.cos(roll) + dy * Math.sin(roll), dy * Math.cos(roll) - dx * Math.sin(roll)];
      // Meridians draw together towards the zenith; a floor keeps the camera from spinning there.
      place(turned(from, radius(), (-right * step) / Math.max(Math.cos(from.pitch_deg * RAD), 0.2), down * step));
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
    /** Angle of a direction over the plane that is level at the camera. @param {import('./vector.js').Vec3} direction A unit vector */
    elevationDeg: (direction) => Math.asin(clamp(dot(direction, upAt(store.scene.camera.position_m, radius())), -1, 1)) / RAD,
    /** Of the horizon: below 0 as the observer rises. */
    horizonDeg: () => -Math.acos(clamp(radius() / (radius() + altitude()), 0, 1)) / RAD,
  };
}

/** @typedef {ReturnType<typeof createCamera>} Camera */
