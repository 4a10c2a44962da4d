/** The weather maps that the server keeps, and the list of them to choose from. */
import { namesOf, upload } from '../assets.js';
import { h } from '../dom.js';

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
      names = await namesOf('weather-maps');
    },
    show,
    /** @param {File} file @returns {Promise<string>} Its name */
    upload: (file) => upload('weather-maps', file, 'map'),
  };
}
