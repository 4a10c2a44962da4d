/** Walks, flies and turns the camera by what is held: keys, thumbs. Motion follows the clock, not the keys' repetition. */
import { clamp } from '../vector.js';
import { moved, turned } from './pose.js';

/** What hands ask for; each from -1 to 1. */
export const STILL = { ahead: 0, right: 0, up: 0, turn: 0, pitch: 0, turbo: 0 };
/** @typedef {typeof STILL} Intent */

/** A walk. */
const WALK_M_S = 1.5;
/** Up here the speed grows by as much each second: from the ground to orbit in half a minute. */
const PER_HEIGHT_S = 0.5;
/** And never by more, however fast: a hundredfold would be at the moon before a finger is off the key. */
const MOST_PER_HEIGHT_S = 5;
const TURBO = 10;
const [LEAST_FACTOR, MOST_FACTOR] = [1e-3, 1e6];
/** Below this one walks: ahead is level, wherever one looks. Metres over the ground. */
export const WALK_BELOW_M = 3;
/** Who comes down by looking down lands on their feet; only going down goes lower. */
const [EYE_M, FLOOR_M] = [2, 0.1];
/** High enough to see the planet as a ball of 20°. */
const MOST_ALTITUDE_M = 5e7;
const FASTEST_M_S = 1e8;
/** In a field of view of 60° or more; in a narrower one it is as much of the picture. */
const TURN_DEG_S = 60;
/** Within this time motion comes up to speed, and to rest. */
const EASE_S = 0.12;
const AT_REST = 1e-3;

/** @param {number} height Over the ground, metres @param {number} factor Over a walk's speed */
export const speedAt = (height, factor) =>
  WALK_M_S * factor + Math.min(PER_HEIGHT_S * factor, MOST_PER_HEIGHT_S) * Math.max(height - WALK_BELOW_M, 0);

/**
 * @param {import('../camera.js').Camera} camera
 * @param {Pick<import('./ground.js').Ground, 'height' | 'watch'>} ground Under the camera
 */
export function createPilot(camera, ground) {
  /** @type {(() => Intent)[]} */
  const hands = [];
  let flow = STILL;
  let factor = 1;
  let isTurbo = false;
  let isOn = true;
  /** How high one stands over the ground while one walks. @type {number | null} */
  let standing = null;
  /** Where the last step led: who is elsewhere was put there. @type {import('./pose.js').Pose | null} */
  let last = null;

  const intent = () => {
    const all = hands.map((hand) => hand());
    const sum = (/** @type {keyof Intent} */ key) => (isOn ? clamp(all.reduce((s, one) => s + one[key], 0), -1, 1) : 0);
    return /** @type {Intent} */ (Object.fromEntries(Object.keys(STILL).map((key) => [key, sum(/** @type {keyof Intent} */ (key))])));
  };
  const height = () => camera.altitude() - ground.height();
  const speed = () => Math.min(speedAt(standing ?? height(), factor * (isTurbo || flow.turbo > 0.5 ? TURBO : 1)), FASTEST_M_S);

  /** @param {number} seconds */
  const ease = (seconds) => {
    const wanted = intent();
    const share = 1 - Math.exp(-seconds / EASE_S);
    const next = (/** @type {keyof Intent} */ key) => {
      const value = flow[key] + (wanted[key] - flow[key]) * share;
      return wanted[key] === 0 && Math.abs(value) < AT_REST ? 0 : value;
    };
    flow = /** @type {Intent} */ (Object.fromEntries(Object.keys(STILL).map((key) => [key, next(/** @type {keyof Intent} */ (key))])));
  };

  /** How far the ground lifts who walks on it. @param {number} seconds @param {Intent} asked */
  const lift = (seconds, { ahead, right, up }) => {
    if (up !== 0 || camera.pose() !== last) standing = null;
    if (up === 0 && (ahead !== 0 || right !== 0) && height() <= WALK_BELOW_M) standing ??= height() < FLOOR_M ? EYE_M : height();
    const left = standing === null ? 0 : standing - height();
    return Math.abs(left) < AT_REST ? 0 : left * (1 - Math.exp(-seconds / EASE_S));
  };

  return {
    /** @param {() => Intent} hand What is asked for, read once a step */
    listen: (hand) => hands.push(hand),
    /** Metres a second at full press. */
    speed,
    height,
    factor: () => factor,
    isTurbo: () => isTurbo,
    isOn: () => isOn,
    toggleTurbo: () => (isTurbo = !isTurbo),
    /** Whether hands move the camera at all. */
    toggle: () => (isOn = !isOn),
    /** @param {number} by */
    scaleSpeed: (by) => (factor = clamp(Number((factor * by).toPrecision(3)), LEAST_FACTOR, MOST_FACTOR)),
    /** @param {number} seconds Since the last step */
    step(seconds) {
      ease(seconds);
      const { ahead, right, up, turn, pitch } = flow;
      const isStill = [ahead, right, up, turn, pitch].every((v) => v === 0);
      const rise = lift(seconds, flow);
      if (isStill && rise === 0) return;
      const [from, radius] = [camera.pose(), camera.radius()];
      const reach = speed() * seconds;
      const climb = standing !== null || height() <= WALK_BELOW_M ? 0 : from.pitch_deg * (Math.PI / 180);
      // Walkers are lifted gently, who flies is kept out of the mountain.
      const least = standing === null ? ground.height() + Math.max(up < 0 ? 0 : Math.min(height(), EYE_M), FLOOR_M) : FLOOR_M;
      const step = { ahead: ahead * reach * Math.cos(climb), right: right * reach, up: rise + up * reach + ahead * reach * Math.sin(climb) };
      const rate = TURN_DEG_S * Math.min(1, camera.fieldDeg() / 60) * seconds;
      const next = camera.isFree() ? turned(from, radius, turn * rate, pitch * rate) : from;
      last = moved(next, radius, step, [least, MOST_ALTITUDE_M]);
      camera.place(last);
      ground.watch(speed());
    },
  };
}

/** @typedef {ReturnType<typeof createPilot>} Pilot */
