/** Paints the weather: the map's drawer, its brush, and the way of the map to the server and into the scene. */
import { getAsset, putAsset } from '../api.js';
import { byId } from '../dom.js';
import { announce } from '../toast.js';
import { createBoard } from './board.js';
import { createMaps } from './maps.js';
import { fromPng, toPng } from './picture.js';
import { extentOf, observerOn, shownBy, shownName, viewCone } from './place.js';
import { createPublisher } from './publisher.js';
import { BLANK, createRaster, SIDE } from './raster.js';

const OWN_NAME = 'welkin-painted';
const PRECONDITION_FAILED = 412;

/** The name that this tab paints under: a reload goes on with it, another tab has its own. */
function ownName() {
  const known = sessionStorage.getItem(OWN_NAME);
  const name = known ?? `painted-${crypto.getRandomValues(new Uint32Array(1))[0].toString(36)}`;
  sessionStorage.setItem(OWN_NAME, name);
  return name;
}

/**
 * @param {import('../store.js').Store} store @param {import('../stage.js').Stage} stage
 * @param {any} fair Clouds for a scene without any @param {() => void} open Opens the drawer
 */
export function createPainter(store, stage, fair, open) {
  const drawer = byId('painter', HTMLElement);
  const form = byId('paint-form', HTMLFormElement);
  const field = (/** @type {string} */ name) => /** @type {HTMLInputElement} */ (form.elements.namedItem(name));
  const [size, level, strength, extent, saveName, file] = ['size', 'level', 'strength', 'extent', 'name', 'file'].map(field);
  const [undo, fill, clear, replace] = ['undo', 'fill', 'clear', 'replace'].map((id) => byId(`paint-${id}`, HTMLButtonElement));
  const [status, error] = [byId('paint-status', HTMLElement), byId('paint-error', HTMLElement)];
  const raster = createRaster();
  const name = ownName();
  /** The map that the raster holds; none while it holds what was never sent. @type {string | null} */
  let held = null;
  /** What was painted since the map was last sent. @type {Set<import('./raster.js').Channel>} */
  const painted = new Set();
  let canKeep = true;

  const channel = () => /** @type {import('./raster.js').Channel} */ (field('channel').value);
  const isErasing = () => field('tool').value === 'erase';
  const extentM = () => extentOf(store.scene);
  const brush = () => ({
    channel: channel(),
    radius: Math.max((size.valueAsNumber * 1000 * SIDE) / extentM() / 2, 1),
    level: isErasing() ? BLANK[channel()] : level.valueAsNumber / 100,
    strength: strength.valueAsNumber / 100,
  });

  const complain = (/** @type {Error} */ { message }) => {
    error.textContent = message.charAt(0).toUpperCase() + message.slice(1);
    error.hidden = false;
  };
  const settle = () => (error.hidden = true);
  const use = (/** @type {string} */ map, /** @type {import('./raster.js').Channel[]} */ channels = []) => {
    held = map;
    store.replace(shownBy(store.scene, fair, { name: map, extent_m: extentM() }, channels));
  };
  const publisher = createPublisher(async () => {
    const channels = [...painted];
    painted.clear();
    await putAsset('weather-maps', name, await toPng(raster));
    maps.add(name);
    settle();
    use(name, channels);
  }, complain);
  const changed = () => {
    painted.add(channel());
    undo.disabled = !raster.canUndo();
    board.stale();
    update();
    return publisher.changed();
  };
  const board = createBoard(raster, brush, changed);

  /** What the server says against an act is said here; false where there was something. @param {() => Promise<void>} act */
  const attempt = async (act) => {
    settle();
    try {
      await act();
      return true;
    } catch (cause) {
      complain(/** @type {Error} */ (cause));
      return false;
    }
  };
  const maps = createMaps(/** @type {HTMLSelectElement} */ (/** @type {unknown} */ (field('map'))), async (chosen) => {
    if (await load(chosen)) use(chosen);
  });
  const refresh = async () => {
    try {
      await maps.refresh();
      canKeep = true;
    } catch (cause) {
      canKeep = false;
      complain(/** @type {Error} */ (cause));
    }
    board.enable(canKeep);
    for (const element of form.elements) /** @type {HTMLInputElement} */ (element).disabled = !canKeep;
    if (canKeep) undo.disabled = !raster.canUndo();
    update();
  };
  /** The map that the scene shows comes onto the board. @param {string} map */
  const load = (map) => {
    held = map;
    return attempt(async () => {
      const rgba = await fromPng(await getAsset('weather-maps', map));
      if (held !== map) return;
      raster.read(rgba);
      undo.disabled = true;
      board.stale();
      update();
    });
  };
  const send = (/** @type {File} */ sent) =>
    attempt(async () => {
      const map = await maps.upload(sent);
      await refresh();
      await load(map);
      use(map);
      announce(`The map is kept as ${map}.`);
    });

  undo.addEventListener('click', () => raster.undo() && changed());
  fill.addEventListener('click', () => {
    raster.fill(channel(), brush().level);
    changed();
  });
  clear.addEventListener('click', () => {
    raster.clear();
    changed();
  });
  form.addEventListener('change', (event) => {
    if (event.target === field('file') || !(event.target instanceof HTMLInputElement)) return;
    board.stale();
    update();
  });
  extent.addEventListener('input', () => {
    if (extent.validity.valid && store.scene.clouds) store.set('/clouds/weather_map/extent_m', extent.valueAsNumber * 1000);
  });
  drawer.addEventListener('keydown', (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.key !== 'z' || event.target === saveName || undo.disabled) return;
    event.preventDefault();
    undo.click();
  });

  const keep = (/** @type {boolean} */ isNew) =>
    attempt(async () => {
      if (!saveName.reportValidity()) return;
      const map = saveName.value;
      replace.hidden = true;
      try {
        await putAsset('weather-maps', map, await toPng(raster), { isNew });
      } catch (cause) {
        if (!isNew || /** @type {any} */ (cause).problem?.status !== PRECONDITION_FAILED) throw cause;
        replace.hidden = false;
        replace.focus();
        throw new Error(`there is a map of the name ${map}. Replace it, or choose another name.`);
      }
      await refresh();
      use(map);
      announce(`The map is kept as ${map}.`);
    });
  form.addEventListener('submit', (event) => {
    event.preventDefault();
    keep(true);
  });
  replace.addEventListener('click', () => keep(false));
  saveName.addEventListener('input', () => {
    replace.hidden = true;
    settle();
  });
  file.addEventListener('change', () => {
    const [sent] = file.files ?? [];
    if (sent) send(sent);
    file.value = '';
  });
  drawer.addEventListener('dragover', (event) => event.preventDefault());
  drawer.addEventListener('drop', (event) => {
    event.preventDefault();
    const [sent] = event.dataTransfer?.files ?? [];
    if (sent && canKeep) send(sent);
  });

  function update() {
    if (drawer.hidden) return;
    const shown = shownName(store.scene);
    // A name that the server does not know is about to be refused.
    if (canKeep && shown !== null && shown !== held && maps.names().includes(shown)) load(shown);
    maps.show(shown);
    status.textContent = told(shown);
    extent.valueAsNumber === extentM() / 1000 || (extent.valueAsNumber = extentM() / 1000);
    extent.disabled = !canKeep || !store.scene.clouds;
    for (const [input, unit] of /** @type {const} */ ([[size, 'km'], [level, '%'], [strength, '%']])) {
      const [least, most] = [Number(input.min), Number(input.max)];
      input.style.setProperty('--filled', `${((input.valueAsNumber - least) / (most - least)) * 100}%`);
      input.setAttribute('aria-valuetext', `${input.value} ${unit}`);
      const output = input.parentElement?.querySelector('output');
      if (output) output.value = `${input.value} ${unit}`;
    }
    const { width, height } = stage.box();
    board.draw(observerOn(store.scene), viewCone(store.scene.camera, width / height), extentM());
  }
  const told = (/** @type {string | null} */ shown) => {
    if (!canKeep) return 'Nothing can be painted into the sky here.';
    if (shown === null) return 'The sky shows other weather. Paint, and it shows this map.';
    return shown === held ? `The sky shows this map, ${shown}.` : `The sky shows ${shown}.`;
  };

  return {
    opened: refresh,
    update,
    names: maps.names,
    /** A map that the server has; a blank one is sent where it has none. */
    async mapName() {
      await maps.refresh();
      if (maps.names().length > 0) return held ?? maps.names()[0];
      await putAsset('weather-maps', name, await toPng(raster));
      maps.add(name);
      held = name;
      open();
      return name;
    },
  };
}
