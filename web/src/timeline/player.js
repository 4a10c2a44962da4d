/** Which moment of the timeline is shown, and how it moves on. */
import { EMPTY } from './document.js';
import { clamp } from '../vector.js';

/** @typedef {import('./document.js').Timeline} Timeline */

/** Moments are asked for to the millisecond. */
const MS = 1000;

/** @param {() => number} clock Milliseconds */
export function createPlayer(clock) {
  /** @type {Timeline} */
  let timeline = EMPTY;
  let at_s = 0;
  let length_s = 20;
  let speed = 1;
  let isLooped = true;
  let isPlaying = false;
  /** True where the picture is to show the moment, and not the page's own scene. */
  let isShown = false;
  /** The moment whose scene the page has. @type {number | null} */
  let shownAt = null;
  let last = 0;

  /** Nothing but time changes after the last keyframe; one alone is played for the whole axis. */
  const end = () => {
    const last = timeline.keyframes.at(-1)?.at_s ?? 0;
    return timeline.keyframes.length > 1 && last > 0 ? last : length_s;
  };
  const advance = () => {
    const now = clock();
    const step = isPlaying ? ((now - last) / 1000) * speed : 0;
    last = now;
    if (step === 0) return;
    at_s += step;
    if (at_s < end()) return;
    if (isLooped) at_s %= end();
    else {
      at_s = end();
      isPlaying = false;
    }
  };

  return {
    get timeline() {
      return timeline;
    },
    get length_s() {
      return length_s;
    },
    isPlaying: () => isPlaying,
    isShown: () => isShown,
    at: () => at_s,
    shownAt: () => shownAt,
    /** The picture of a moment has come. @param {number} moment */
    showed: (moment) => (shownAt = moment),
    /** What the server is asked for now; null where that is the page's own scene. */
    moment() {
      advance();
      return isShown && timeline.keyframes.length > 0 ? { timeline, at_s: Math.round(at_s * MS) / MS } : null;
    },
    /** @param {Timeline} next */
    load(next) {
      timeline = next;
      if (next.keyframes.length === 0) isPlaying = isShown = false;
      else length_s = Math.max(length_s, next.keyframes[next.keyframes.length - 1].at_s);
    },
    /** Goes to a moment and shows it. @param {number} next */
    seek(next) {
      advance();
      at_s = clamp(next, 0, length_s);
      isShown = timeline.keyframes.length > 0;
    },
    /** Goes there, and leaves the picture alone. @param {number} next */
    point: (next) => (at_s = clamp(next, 0, length_s)),
    play() {
      if (timeline.keyframes.length === 0) return;
      if (at_s >= end()) at_s = 0;
      last = clock();
      isPlaying = isShown = true;
    },
    pause() {
      advance();
      isPlaying = false;
    },
    /** The page's own scene is what is shown from now on. */
    leave() {
      advance();
      isPlaying = isShown = false;
      shownAt = null;
    },
    /** @param {number} next */
    setSpeed(next) {
      advance();
      speed = next;
    },
    /** @param {boolean} next */
    setLoop: (next) => (isLooped = next),
    /** Not shorter than its keyframes. @param {number} next */
    setLength(next) {
      length_s = Math.max(next, timeline.keyframes.at(-1)?.at_s ?? 0);
      at_s = Math.min(at_s, length_s);
    },
  };
}

/** @typedef {ReturnType<typeof createPlayer>} Player */
