/** The scene that the page shows, and who is told when it changes. */
import { complete, minimal } from './document.js';
import { equal } from './json.js';
import { getAt, setAt } from './pointer.js';

/** @typedef {import('./schema.js').Node} Node */
/**
 * @typedef {'page' | 'address' | 'refused' | 'played'} Cause Who changed it: the user here, the address bar, the server's refusal,
 * a timeline that is played.
 */

/** @param {Node} root The schema's tree */
export function createStore(root) {
  /** @type {((scene: any, cause: Cause) => void)[]} */
  const listeners = [];
  let scene = complete(root, {});
  const replace = (/** @type {any} */ next, /** @type {Cause} */ cause = 'page') => {
    if (equal(scene, next)) return;
    scene = next;
    for (const listener of listeners) listener(scene, cause);
  };
  return {
    root,
    get scene() {
      return scene;
    },
    /** @param {string} pointer */
    get: (pointer) => getAt(scene, pointer),
    /** @param {string} pointer @param {any} value */
    set: (pointer, value) => replace(setAt(scene, pointer, value)),
    /** A whole scene, complete. */
    replace,
    /** A document that may leave fields out. @param {any} document @param {Cause} [cause] */
    load: (document, cause) => replace(complete(root, document), cause),
    /** The shortest document that means this scene. */
    short: () => minimal(root, scene) ?? {},
    /** @param {(scene: any, cause: Cause) => void} listener */
    subscribe: (listener) => listeners.push(listener),
  };
}

/** @typedef {ReturnType<typeof createStore>} Store */
