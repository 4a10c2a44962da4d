/**
 * Keeps the server's copy of the scene equal to the page's: the whole scene once, then at most one patch an animation
 * frame. Remembers what was sent under which number, so that an answer can be told to belong to it.
 */
import { equal, mergePatch } from './json.js';

/** @param {(message: any) => void} send @param {() => any} current The page's scene */
export function createSync(send, current) {
  let seq = 0;
  /** What the server holds; null where that is not known. @type {any} */
  let held = null;
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
    const scene = current();
    if (equal(held, scene) || equal(refusedScene, scene)) return {};
    const patch = held === null ? null : mergePatch(held, scene);
    held = scene;
    refusedScene = null;
    unanswered.push({ seq: seq + 1, scene });
    return patch === null ? { scene } : { patch };
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
      held = null;
      heldOutput = null;
      unanswered = [];
    },
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
      held = null;
      heldOutput = null;
      refusedScene = entry?.scene ?? null;
      return refusedScene;
    },
  };
}

/** @typedef {ReturnType<typeof createSync>} Sync */
