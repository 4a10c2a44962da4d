/** The weather maps that the server keeps, and the list of them to choose from. */
import { listMaps, putMap } from '../api.js';
import { h } from '../dom.js';
import { assetName } from './place.js';

const PRECONDITION_FAILED = 412;
const MOST_TRIES = 100;

/** @param {HTMLSelectElement} select @param {(name: string) => void} chosen */
export function createMaps(select, chosen) {
  /** @type {string[]} */
  let names = [];
  select.addEventListener('change', () => select.value && chosen(select.value));
  const show = (/** @type {string | null} */ current) => {
    const all = current === null || names.includes(current) ? names : [...names, current];
    select.replaceChildren(h('option', { value: '' }, all.length > 0 ? 'Choose a map' : 'No maps yet'), ...all.map((name) => h('option', { value: name }, name)));
    select.value = current ?? '';
  };
  return {
    names: () => names,
    /** The server has this one, too. @param {string} name */
    add(name) {
      if (!names.includes(name)) names = [...names, name].toSorted();
    },
    async refresh() {
      names = (await listMaps()).map(({ name }) => name);
    },
    show,
    /** Under the file's name, or that with a number where there is one of it. @param {File} file @returns {Promise<string>} */
    async upload(file) {
      const base = assetName(file.name);
      for (let i = 1; ; i++) {
        const name = i === 1 ? base : `${base}-${i}`;
        try {
          return (await putMap(name, file, { isNew: true })).name;
        } catch (error) {
          if (/** @type {any} */ (error).problem?.status !== PRECONDITION_FAILED || i === MOST_TRIES) throw error;
        }
      }
    },
  };
}
