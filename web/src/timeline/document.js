/** Timelines as documents: keyframes are patches of the timeline's scene, sorted by time. */
import { equal, isObject } from '../json.js';
import { getAt, setAt } from '../pointer.js';

/** @typedef {{at_s: number, patch: Record<string, any>}} Keyframe */
/** @typedef {{scene: any, keyframes: Keyframe[]}} Timeline */

/** Most keyframes that the server takes. */
export const MOST_KEYFRAMES = 256;
/** Times that keyframes can have: hundredths of a second. */
export const STEP_S = 0.01;
/** What passing time sets itself: a keyframe that said it would stop the clock. */
const OF_TIME = ['/time_s', '/clouds/wind/drift_m'];

/** @type {Timeline} */
export const EMPTY = { scene: {}, keyframes: [] };

/** @param {number} at_s */
export const tidy = (at_s) => Math.round(at_s / STEP_S) / Math.round(1 / STEP_S);

/**
 * What leads from one scene to another as keyframes say it: null switches a part off where the other is null, and removes
 * a member where there is none; an object of another `kind` stands whole.
 * @param {any} from @param {any} to @returns {Record<string, any>}
 */
export function difference(from, to) {
  /** @type {Record<string, any>} */
  const patch = {};
  for (const key of Object.keys(from)) if (!Object.hasOwn(to, key)) patch[key] = null;
  for (const [key, value] of Object.entries(to)) {
    const old = from[key];
    if (Object.hasOwn(from, key) && equal(old, value)) continue;
    const isSame = isObject(value) && isObject(old) && old.kind === value.kind;
    patch[key] = isSame ? difference(old, value) : value;
  }
  return patch;
}

/** The scene with what passing time sets as another has it. @param {any} scene @param {any} as */
function timeless(scene, as) {
  return OF_TIME.reduce((s, pointer) => {
    const value = getAt(as, pointer);
    return value === undefined || getAt(s, pointer) === undefined ? s : setAt(s, pointer, value);
  }, scene);
}

/** @param {Timeline} timeline @param {number} at_s */
export const indexAt = ({ keyframes }, at_s) => keyframes.findIndex((key) => Math.abs(key.at_s - at_s) < STEP_S / 2);

/** @param {Keyframe[]} keyframes */
const sorted = (keyframes) => keyframes.toSorted((a, b) => a.at_s - b.at_s);

/**
 * With a keyframe of this scene, in place of one that is there at this time. The first one's scene becomes the timeline's.
 * @param {Timeline} timeline @param {number} at_s @param {any} scene Complete @returns {Timeline}
 */
export function withKeyframe(timeline, at_s, scene) {
  if (timeline.keyframes.length === 0) {
    const begun = getAt(scene, '/time_s') - at_s;
    return { scene: setAt(scene, '/time_s', begun), keyframes: [{ at_s, patch: {} }] };
  }
  const patch = difference(timeline.scene, timeless(scene, timeline.scene));
  const others = timeline.keyframes.filter((_, i) => i !== indexAt(timeline, at_s));
  return { ...timeline, keyframes: sorted([...others, { at_s, patch }]) };
}

/** @param {Timeline} timeline @param {number} index @returns {Timeline} */
export function withoutKeyframe(timeline, index) {
  const keyframes = timeline.keyframes.toSpliced(index, 1);
  return keyframes.length === 0 ? EMPTY : { ...timeline, keyframes };
}

/**
 * A keyframe at another time; where one is already there, next to it.
 * @param {Timeline} timeline @param {number} index @param {number} at_s @returns {{timeline: Timeline, index: number}}
 */
export function moved(timeline, index, at_s) {
  const others = timeline.keyframes.toSpliced(index, 1);
  let free = Math.max(tidy(at_s), 0);
  while (others.some((key) => Math.abs(key.at_s - free) < STEP_S / 2)) free = tidy(free + STEP_S);
  const key = { ...timeline.keyframes[index], at_s: free };
  const keyframes = sorted([...others, key]);
  return { timeline: { ...timeline, keyframes }, index: keyframes.indexOf(key) };
}

/** A file's text; throws an `Error` that says what is wrong with its form. @param {string} text @returns {Timeline} */
export function parseTimeline(text) {
  /** @type {any} */
  let value;
  try {
    value = JSON.parse(text);
  } catch (cause) {
    throw new Error(`the file is not JSON: ${/** @type {Error} */ (cause).message}`);
  }
  if (!isObject(value)) throw new Error('a timeline is an object with scene and keyframes');
  const { scene = {}, keyframes } = value;
  if (!isObject(scene)) throw new Error('scene must be an object');
  if (!Array.isArray(keyframes) || keyframes.length === 0) throw new Error('keyframes must be a list with one keyframe at least');
  for (const [i, key] of keyframes.entries()) {
    if (typeof key?.at_s !== 'number') throw new Error(`keyframe ${i + 1} has no time at_s`);
    if (!isObject(key.patch ?? {})) throw new Error(`the patch of keyframe ${i + 1} must be an object`);
  }
  return { ...value, scene, keyframes: keyframes.map((/** @type {any} */ key) => ({ ...key, patch: key.patch ?? {} })) };
}
