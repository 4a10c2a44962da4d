/** What a drag on the picture does: it moves the sun or the moon, or it turns the camera. */
import { turned } from './sun.js';
import { toAngles } from './vector.js';

/** @typedef {import('./view.js').Pixel} Pixel */
/** @typedef {{move: (to: Pixel) => void}} Drag */

/** Within this distance sun and moon are grabbed wherever they stand, CSS pixels. */
const GRAB_PX = 36;
/** A drag that begins this far below the horizon means the ground, degrees. */
const GROUND_DEG = 0.5;

/**
 * @param {object} parts
 * @param {import('./sun.js').Sun} parts.sun
 * @param {import('./moon.js').Moon} parts.moon
 * @param {import('./camera.js').Camera} parts.camera
 * @param {import('./stage.js').Stage} parts.stage
 */
export function createDrags({ sun, moon, camera, stage }) {
  /** From the window to the picture. @param {Pixel} pixel @returns {Pixel} */
  const inBox = (pixel) => {
    const { x, y } = stage.box();
    return { x: pixel.x - x, y: pixel.y - y };
  };

  /** @param {Pixel} from @returns {Drag} */
  const look = (from) => {
    let last = from;
    return {
      move(to) {
        camera.drag(to.x - last.x, to.y - last.y);
        last = to;
      },
    };
  };

  /**
   * What is in view keeps its distance to the pointer on the picture.
   * @param {{moveToDirection: (direction: import('./vector.js').Vec3) => void}} body @param {Pixel} offset @returns {Drag}
   */
  const carry = (body, offset) => ({
    move(to) {
      const { x, y } = inBox(to);
      body.moveToDirection(camera.view().unproject({ x: x + offset.x, y: y + offset.y }));
    },
  });

  /** A sun out of view turns by as much as the pointer does. @param {Pixel} from @returns {Drag} */
  const swing = (from) => {
    const start = sun.angles();
    const grabbed = toAngles(camera.view().unproject(inBox(from)));
    return {
      move(to) {
        if (start) sun.moveTo(turned(start, grabbed, toAngles(camera.view().unproject(inBox(to)))));
      },
    };
  };

  return {
    look,
    /** What a plain drag from here does. @param {Pixel} from @returns {Drag} */
    begin(from) {
      const view = camera.view();
      const at = inBox(from);
      const { width, height } = stage.box();
      const fromPointer = (/** @type {import('./vector.js').Vec3 | null} */ direction) => {
        const mark = direction && view.project(direction);
        return mark && { x: mark.x - at.x, y: mark.y - at.y };
      };
      const reach = (/** @type {Pixel | null} */ step) => (step ? Math.hypot(step.x, step.y) : Infinity);
      const offset = fromPointer(sun.direction());
      const toMoon = moon.isGiven() ? fromPointer(moon.direction()) : null;
      if (toMoon && reach(toMoon) < Math.min(GRAB_PX, reach(offset))) return carry(moon, toMoon);
      if (offset && reach(offset) < GRAB_PX) return carry(sun, offset);
      if (camera.elevationDeg(view.unproject(at)) < camera.horizonDeg() - GROUND_DEG) return look(from);
      const isWithin = (/** @type {number} */ v, /** @type {number} */ most) => v >= 0 && v <= most;
      const inView = offset && isWithin(at.x + offset.x, width) && isWithin(at.y + offset.y, height);
      return inView ? carry(sun, offset) : swing(from);
    },
  };
}

/** @typedef {ReturnType<typeof createDrags>} Drags */
