/** Keys that are held down, as what they ask of the pilot. */
import { STILL } from './pilot.js';

/** @typedef {import('./pilot.js').Intent} Intent */

export function createHeld() {
  /** By the key's place on the keyboard: with Shift it gives another letter. @type {Map<string, {asks: Partial<Intent>, isUp: boolean}>} */
  const keys = new Map();
  return {
    /** @param {string} code @param {Partial<Intent>} asks */
    press: (code, asks) => keys.set(code, { asks, isUp: false }),
    /** A tap between two steps still counts for one. @param {string} code */
    release(code) {
      const key = keys.get(code);
      if (key) key.isUp = true;
    },
    releaseAll: () => keys.clear(),
    /** @param {string} code */
    has: (code) => keys.has(code),
    count: () => keys.size,
    /** Once a step. @returns {Intent} */
    read() {
      const all = [...keys.values()];
      for (const [code, { isUp }] of keys) if (isUp) keys.delete(code);
      const sum = (/** @type {keyof Intent} */ key) => all.reduce((s, { asks }) => s + (asks[key] ?? 0), 0);
      return /** @type {Intent} */ (Object.fromEntries(Object.keys(STILL).map((key) => [key, sum(/** @type {keyof Intent} */ (key))])));
    },
  };
}

/** @typedef {ReturnType<typeof createHeld>} Held */
