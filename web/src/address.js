/** The scene in the address bar: written when things come to rest, read at the start and on back and forward. */
import { debounced } from './dom.js';
import { fromHash, toHash } from './hash.js';

const REST_MS = 400;

/** @param {import('./store.js').Store} store @param {(message: string) => void} complain */
export function bindAddress(store, complain) {
  const read = () => {
    try {
      store.load(fromHash(location.hash), 'address');
    } catch (error) {
      store.load({}, 'address');
      complain(`The address holds no scene: ${/** @type {Error} */ (error).message}. This is the default scene.`);
    }
  };
  /** Where a timeline led is no place to go back to. */
  let isPlayed = false;
  const write = () => {
    const hash = toHash(store.short());
    const url = hash || location.pathname + location.search;
    if (hash === location.hash) return;
    if (isPlayed) history.replaceState(null, '', url);
    else history.pushState(null, '', url);
  };
  const writeSoon = debounced(write, REST_MS);
  read();
  store.subscribe((_, cause) => {
    isPlayed = cause === 'played';
    if (cause !== 'address') writeSoon();
  });
  window.addEventListener('popstate', read);
  return { link: () => new URL(toHash(store.short()) || '#', location.href).href };
}
