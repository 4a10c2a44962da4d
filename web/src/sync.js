/**
 * Keeps the server's copy of the scene equal to the page's: the whole scene once, then at most one patch an animation
 * frame; or has it show moments of a timeline, which is sent once. Remembers what was sent under which number, so that an answer can be told to belong to it.
 */
import { equal, mergePatch } from './json.js';

/** @typedef {{timeline: any, at_s: number}} Moment */

/**
 * @param {(message: any) => void} send @param {() => any} current The page's scene
 * @param {() => Moment | null} [currentMoment] What is to be shown in its place
 */
export function createSync(send, current, currentMoment = () => null) {
  let seq = 0;
  /** What the server holds; null where that is not known. @type {any} */
  let held = null;
  /** What the server shows of which timeline, where it does. @type {any} */
  let heldTimeline = null;
  /** @type {number | null} */
  let heldAt = null;
  /** @type {any} */
  let output = null;
  /** @type {any} */
  let heldOutput = null;
  /** @type {{seq: number, scene: any}[]} */
  let unanswered = [];
  /** The latest scene that the server has drawn. @type {any} */
  let accepted = null;
  /** What the server would refuse again. @type {any} */
  let refusedScene = null;

  /** What a message must say of the scene; empty where the server knows. */
  const news = () => {
    const moment = currentMoment();
    if (moment) return newsOf(moment);
    heldAt = null;
    const scene = current();
    if (equal(held, scene) || equal(refusedScene, scene)) return {};
    const patch = held === null ? null : mergePatch(held, scene);
    held = scene;
    refusedScene = null;
    unanswered.push({ seq: seq + 1, scene });
    return patch === null ? { scene } : { patch };
  };
  /** @param {Moment} moment */
  const newsOf = ({ timeline, at_s }) => {
    const isKnown = heldTimeline === timeline;
    if (isKnown && heldAt === at_s) return {};
    [heldTimeline, heldAt] = [timeline, at_s];
    // The scene that the server makes of it is not known here.
    held = null;
    refusedScene = null;
    return isKnown ? { at_s } : { timeline, at_s };
  };
  const forgetHeld = () => {
    held = null;
    heldTimeline = null;
    heldAt = null;
    heldOutput = null;
  };

  return {
    get accepted() {
      return accepted;
    },
    /** The number of the latest message. */
    get seq() {
      return seq;
    },
    /** @param {any} next What kind of pictures are wanted */
    want: (next) => (output = next),
    /** Once an animation frame. True where something went out. */
    flush() {
      const message = { ...news(), ...(equal(output, heldOutput) ? {} : { output }) };
      if (Object.keys(message).length === 0) return false;
      heldOutput = output;
      seq += 1;
      send({ seq, ...message });
      return true;
    },
    /** After a new connection, which knows nothing. */
    forget() {
      forgetHeld();
      unanswered = [];
    },
    /** The server shows a moment whose scene this is. @param {any} scene */
    showed: (scene) => (accepted = scene),
    /** A picture or figures came that show message `answered`. @param {number} answered */
    confirm(answered) {
      const confirmed = unanswered.filter((entry) => entry.seq <= answered);
      if (confirmed.length === 0) return;
      accepted = confirmed[confirmed.length - 1].scene;
      unanswered = unanswered.filter((entry) => entry.seq > answered);
    },
    /** Message `refused` was no scene; the server's copy is told whole next time. @param {number} refused @returns {any} That scene */
    refuse(refused) {
      const entry = unanswered.find((e) => e.seq === refused);
      unanswered = unanswered.filter((e) => e.seq > refused);
      forgetHeld();
      refusedScene = entry?.scene ?? null;
      return refusedScene;
    },
  };
}

/** @typedef {ReturnType<typeof createSync>} Sync */
