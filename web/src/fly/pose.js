/**
 * Where the camera is and how it is held, over the planet's sphere with its centre at (0, 0, -R).
 *
 * A scene gives directions in the frame of its origin. Far from there "level" is another plane; so a pose has a heading
 * in the plane that is level where the camera is, and a pitch and a roll against that plane. Going along the sphere,
 * these two stay, and the heading is carried parallel to itself.
 */
import { axes } from '../view.js';
import { clamp, combine, cross, dot, normalised, toAngles, wrap360 } from '../vector.js';

/** @typedef {import('../vector.js').Vec3} Vec3 */
/** @typedef {{position_m: Vec3, heading: Vec3, pitch_deg: number, roll_deg: number}} Pose `heading` is a unit vector, level. */
/** @typedef {{ahead: number, right: number, up: number}} Step Along the heading, to its right and away from the centre, metres. */

const RAD = Math.PI / 180;
/** Sine of the angle to the vertical below which a direction has no heading of its own. */
const VERTICAL = 1e-6;
/** Four decimals of a degree are finer than a pixel, millimetres finer than a step. */
const [ANGLE_STEPS, LENGTH_STEPS] = [1e4, 1e3];

const tidy = (/** @type {number} */ value, /** @type {number} */ steps) => Math.round(value * steps) / steps + 0;

/** The part of a vector at right angles to a unit vector, as a unit vector. @param {Vec3} v @param {Vec3} unit */
const across = (v, unit) => normalised(combine([1, v], [-dot(v, unit), unit]));

/** Away from the planet's centre. @param {Vec3} position @param {number} radius @returns {Vec3} */
export const upAt = ([x, y, z], radius) => normalised([x, y, z + radius]);

/** Height over the sphere: (|p|² + 2Rz) / (|p - c| + R), without the difference of large numbers. @param {Vec3} position @param {number} radius */
export const altitudeAt = ([x, y, z], radius) => (x * x + y * y + z * (z + 2 * radius)) / (Math.hypot(x, y, z + radius) + radius);

/** Right, up and forward without roll. @param {Pose} pose @param {number} radius */
function level(pose, radius) {
  const up = upAt(pose.position_m, radius);
  const right = cross(pose.heading, up);
  const forward = combine([Math.cos(pose.pitch_deg * RAD), pose.heading], [Math.sin(pose.pitch_deg * RAD), up]);
  return { right, up: cross(right, forward), forward };
}

/** @param {any} camera Of a scene @param {number} radius The planet's, metres @returns {Pose} */
export function readPose(camera, radius) {
  const up = upAt(camera.position_m, radius);
  const { right, forward } = axes(camera);
  const rise = dot(forward, up);
  const flat = combine([1, forward], [-rise, up]);
  const isVertical = Math.hypot(...flat) < VERTICAL;
  // Straight up or down the azimuth still says where the right-hand side is.
  const heading = isVertical ? cross(up, across(axes({ ...camera, roll_deg: 0 }).right, up)) : normalised(flat);
  const pose = { position_m: camera.position_m, heading, pitch_deg: Math.atan2(rise, Math.hypot(...flat)) / RAD, roll_deg: 0 };
  const plain = level(pose, radius);
  return { ...pose, roll_deg: Math.atan2(dot(right, plain.up), dot(right, plain.right)) / RAD };
}

/** What the scene's camera says of a pose, rounded. @param {Pose} pose @param {number} radius */
export function writePose(pose, radius) {
  const plain = level(pose, radius);
  const [c, s] = [Math.cos(pose.roll_deg * RAD), Math.sin(pose.roll_deg * RAD)];
  const right = combine([c, plain.right], [s, plain.up]);
  const isVertical = Math.hypot(plain.forward[0], plain.forward[1]) < VERTICAL;
  const azimuth_deg = isVertical ? toAngles(plain.right).azimuth_deg - 90 : toAngles(plain.forward).azimuth_deg;
  const direction = { azimuth_deg: tidy(wrap360(azimuth_deg), ANGLE_STEPS), elevation_deg: tidy(toAngles(plain.forward).elevation_deg, ANGLE_STEPS) };
  // Against the rounded azimuth, which near the zenith of the origin alone would turn the picture.
  const given = axes({ direction, roll_deg: 0 });
  const roll_deg = tidy(Math.atan2(dot(right, given.up), dot(right, given.right)) / RAD, ANGLE_STEPS);
  return { position_m: pose.position_m.map((v) => tidy(v, LENGTH_STEPS)), direction, roll_deg };
}

/** @param {Pose} pose @param {number} radius @param {number} azimuth Clockwise @param {number} elevation Steps, degrees @returns {Pose} */
export function turned(pose, radius, azimuth, elevation) {
  const right = cross(pose.heading, upAt(pose.position_m, radius));
  const heading = normalised(combine([Math.cos(azimuth * RAD), pose.heading], [Math.sin(azimuth * RAD), right]));
  return { ...pose, heading, pitch_deg: clamp(pose.pitch_deg + elevation, -90, 90) };
}

/**
 * Up first, then along the great circle: the height stays as it is.
 * @param {Pose} pose @param {number} radius @param {Step} step @param {[number, number]} heights The lowest and the highest allowed, metres
 * @returns {Pose}
 */
export function moved(pose, radius, step, [least, most]) {
  const up = upAt(pose.position_m, radius);
  const altitude = clamp(altitudeAt(pose.position_m, radius) + step.up, least, most);
  const length = Math.hypot(step.ahead, step.right);
  const to = length > 0 ? combine([step.ahead / length, pose.heading], [step.right / length, cross(pose.heading, up)]) : pose.heading;
  const angle = length / (radius + altitude);
  const nextUp = combine([Math.cos(angle), up], [Math.sin(angle), to]);
  const nextTo = combine([Math.cos(angle), to], [-Math.sin(angle), up]);
  const side = cross(up, to);
  const heading = combine([dot(pose.heading, to), nextTo], [dot(pose.heading, side), side]);
  const [x, y, z] = combine([radius + altitude, nextUp]);
  return { ...pose, position_m: [x, y, z - radius], heading: across(heading, nextUp) };
}

/** Azimuth of the heading where north is the scene's, carried to the camera along the shortest way. @param {Pose} pose @param {number} radius */
export function headingDeg(pose, radius) {
  const up = upAt(pose.position_m, radius);
  // The turn of z onto `up` takes v to v - (v·(z + up)) / (1 + z·up) (z + up) + 2 (v·z) up; v·z is 0 for east and north.
  const both = combine([1, up], [1, [0, 0, 1]]);
  const carried = (/** @type {Vec3} */ v) => combine([1, v], [-dot(v, both) / Math.max(1 + up[2], VERTICAL), both]);
  return wrap360(Math.atan2(dot(pose.heading, carried([1, 0, 0])), dot(pose.heading, carried([0, 1, 0]))) / RAD);
}
