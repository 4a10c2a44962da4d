/** What a drag on the picture does: it moves the sun, or it turns the camera. */
import { turned } from './sun.js';
import { toAngles } from './vector.js';

/** @typedef {import('./view.js').Pixel} Pixel */
/** @typedef {{move: (to: Pixel) => void}} Drag */

/** Within this distance of its mark the sun is grabbed wherever it stands, CSS pixels. */
const GRAB_PX = 36;
/** A drag that begins this far below the horizon means the ground, degrees. */
const GROUND_DEG = 0.5;

/**
 * @param {import('./sun.js').Sun} sun @param {import('./camera.js').Camera} camera
 * @param {import('./stage.js').Stage} stage
 */
export function createDrags(sun, camera, stage) {
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

  /** A sun in view keeps its distance to the pointer on the picture. @param {Pixel} offset @returns {Drag} */
  const carry = (offset) => ({
    move(to) {
      const { x, y } = inBox(to);
      sun.moveToDirection(camera.view().unproject({ x: x + offset.x, y: y + offset.y }));
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
      const direction = sun.direction();
      const mark = direction && view.project(direction);
      const offset = mark && { x: mark.x - at.x, y: mark.y - at.y };
      if (offset && Math.hypot(offset.x, offset.y) < GRAB_PX) return carry(offset);
      if (toAngles(view.unproject(at)).elevation_deg < camera.horizonDeg() - GROUND_DEG) return look(from);
      const inView = mark && mark.x >= 0 && mark.x <= width && mark.y >= 0 && mark.y <= height;
      return offset && inView ? carry(offset) : swing(from);
    },
  };
}

/** @typedef {ReturnType<typeof createDrags>} Drags */
