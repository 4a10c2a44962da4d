/** Lamps put on the ground by hand or from files, and the ice over them: the drawer and the clicks on the picture. */
import { postProbe } from '../api.js';
import { LIGHT_FILES, lightFile, namesOf, upload } from '../assets.js';
import { byId, h } from '../dom.js';
import { initialVariant } from '../document.js';
import { sentence } from '../text.js';
import { announce, toast } from '../toast.js';
import { byNight, choiceOf, freshIce, groundRequest, KELVIN, layersOf, lightOf, OWN, placeAt, tilted, tiltOf, toSphere, townOf, upTo, withLayers } from './document.js';

/** @typedef {import('../schema.js').Node} Node */

/** How sliders read: from and to their value. Those of light and density go by powers of ten. */
const POWER = { to: (/** @type {number} */ v) => 10 ** v, from: Math.log10 };
const PLAIN = { to: (/** @type {number} */ v) => v, from: (/** @type {number} */ v) => v };
const SHORT = new Intl.NumberFormat('en', { maximumSignificantDigits: 3 });

/**
 * @param {object} parts
 * @param {import('../store.js').Store} parts.store @param {import('../camera.js').Camera} parts.camera @param {import('../stage.js').Stage} parts.stage
 * @param {import('../sun.js').Sun} parts.sun @param {HTMLElement} parts.surface The picture
 */
export function createLamps({ store, camera, stage, sun, surface }) {
  const drawer = byId('lamps', HTMLElement);
  const form = byId('lamp-form', HTMLFormElement);
  const field = (/** @type {string} */ name) => /** @type {HTMLInputElement} */ (form.elements.namedItem(name));
  const [status, error] = [byId('lamp-status', HTMLElement), byId('lamp-error', HTMLElement)];
  const nodeOf = (/** @type {string} */ name) => /** @type {Node} */ (store.root.properties?.find(({ key }) => key === name)?.node);
  const [lights, ice, town] = ['lights', 'ice_crystals', 'town'].map(nodeOf);
  const options = (/** @type {string} */ name) => lights.items?.properties?.find(({ key }) => key === name)?.node.options ?? [];
  const [undo, clear] = ['undo', 'clear'].map((id) => byId(`lamp-${id}`, HTMLButtonElement));
  const select = /** @type {HTMLSelectElement} */ (/** @type {unknown} */ (field('town')));
  field('kind').append(...options('lamp').map(({ value, description }) => h('option', { value, title: description }, sentence(value))), h('option', { value: OWN }, 'A colour of your own'));
  field('emission').append(...options('emission').map(({ value, description }) => h('option', { value, title: description }, sentence(value))));
  /** @type {string[]} */
  let names = [];

  const held = () => store.scene;
  const layers = (/** @type {(layer: any) => any} */ change) => store.set('/ice_crystals', withLayers(held().ice_crystals, change));
  /** Sliders: what they read of the scene (none: of the next lamp), and what they set. */
  const SLIDES = /** @type {const} */ ([
    { name: 'kelvin', unit: 'K', scale: PLAIN },
    { name: 'candela', unit: 'cd', scale: POWER },
    { name: 'height', unit: 'm', scale: PLAIN },
    { name: 'plates', unit: '/m³', scale: POWER, read: (/** @type {any} */ l) => l.number_density_per_m3, set: (/** @type {number} */ v) => layers((l) => ({ ...l, number_density_per_m3: v })) },
    { name: 'tilt', unit: '°', scale: PLAIN, read: tiltOf, set: (/** @type {number} */ v) => layers((l) => tilted(l, v)) },
    { name: 'top', unit: 'm', scale: PLAIN, read: (/** @type {any} */ l) => l.top_m, set: (/** @type {number} */ v) => layers((l) => upTo(l, v)) },
    { name: 'extinction', unit: '/km', scale: PLAIN, read: (/** @type {any} */ l) => l.extinction_per_m * 1000, set: (/** @type {number} */ v) => layers((l) => ({ ...l, extinction_per_m: Number((v / 1000).toPrecision(4)) })) },
  ]);
  const valueOf = (/** @type {string} */ name) => {
    const { scale } = /** @type {(typeof SLIDES)[number]} */ (SLIDES.find((slide) => slide.name === name));
    return Number(scale.to(field(name).valueAsNumber).toPrecision(3));
  };
  const lamp = () => ({ kind: field('kind').value, kelvin: valueOf('kelvin'), colour: field('colour').value, candela: valueOf('candela'), height_m: valueOf('height'), emission: field('emission').value });

  const attempt = async (/** @type {() => Promise<void>} */ act) => {
    error.hidden = true;
    try {
      await act();
    } catch (cause) {
      const { message } = /** @type {Error} */ (cause);
      error.textContent = message.charAt(0).toUpperCase() + message.slice(1);
      error.hidden = false;
    }
  };
  const put = (/** @type {[number, number]} */ place) => {
    if (held().lights.length >= (lights.most ?? Infinity)) throw new Error(`a scene has ${lights.most} lamps at most.`);
    store.replace({ ...held(), lights: [...held().lights, lightOf(lights, lamp(), place)], ice_crystals: held().ice_crystals ?? freshIce(ice) });
    announce(`A lamp stands there. There are ${held().lights.length}.`);
  };
  /** A tap on the picture. @param {import('../view.js').Pixel} at */
  const tap = (at) => {
    if (drawer.hidden) return;
    const { x, y } = stage.box();
    const direction = camera.view().unproject({ x: at.x - x, y: at.y - y });
    const from = held().camera.position_m;
    attempt(async () => {
      const asked = held().terrain ? (await postProbe(groundRequest(held(), direction))).distance_m[0] : toSphere(from, direction, camera.radius());
      if (asked === null) throw new Error('There is no ground. Lamps stand below the horizon.');
      put(placeAt(from, direction, asked));
    });
  };
  const send = (/** @type {File} */ sent) =>
    attempt(async () => {
      if (!lightFile(sent.name)) throw new Error(`${sent.name} is not a list of lamps (${LIGHT_FILES.replaceAll(',', ' ')}).`);
      const name = await upload('lights', sent, 'lamps');
      names = [...names, name];
      store.set('/town', townOf(town, held().town, name));
      announce(`${sent.name} is kept as ${name}.`);
    });

  form.addEventListener('submit', (event) => event.preventDefault());
  form.addEventListener('input', ({ target }) => {
    const input = /** @type {HTMLInputElement} */ (target);
    const slide = SLIDES.find(({ name }) => name === input.name);
    if (slide && 'set' in slide) slide.set(valueOf(slide.name));
    if (input.name === 'kind' && KELVIN[input.value]) field('kelvin').valueAsNumber = KELVIN[input.value];
    // What those say is not in the scene before they are changed.
    if (!['town', 'ice'].includes(input.name)) update();
  });
  field('ice').addEventListener('change', () => store.set('/ice_crystals', field('ice').checked ? freshIce(ice) : null));
  undo.addEventListener('click', () => store.set('/lights', held().lights.slice(0, -1)));
  clear.addEventListener('click', () => {
    const before = held().lights;
    store.set('/lights', []);
    toast('All lamps are away.', { action: { name: 'Undo', act: () => store.set('/lights', before) } });
  });
  byId('lamp-night', HTMLButtonElement).addEventListener('click', () => store.replace(byNight(held(), sun.angles()?.azimuth_deg ?? 0)));
  select.addEventListener('change', () => {
    if (select.value === '') store.set('/town', null);
    else if (select.value === 'procedural') store.set('/town', initialVariant(town, 0));
    else store.set('/town', townOf(town, held().town, select.value.slice('lights/'.length)));
  });
  field('file').addEventListener('change', async () => {
    const [sent] = field('file').files ?? [];
    if (sent) await send(sent);
    field('file').value = '';
  });
  drawer.addEventListener('dragover', (event) => event.preventDefault());
  drawer.addEventListener('drop', (event) => {
    event.preventDefault();
    const [sent] = event.dataTransfer?.files ?? [];
    if (sent) send(sent);
  });
  // Two lamps in one place are two clicks, not a wish to look about.
  surface.addEventListener('dblclick', (event) => drawer.hidden || event.stopImmediatePropagation(), { capture: true });

  /** What the list of towns was made of. */
  let listed = '';
  function update() {
    if (drawer.hidden) return;
    const { ice_crystals, town: current, lights: { length } } = held();
    const [layer] = layersOf(ice_crystals);
    field('ice').checked = ice_crystals !== null;
    for (const slide of SLIDES) {
      const input = field(slide.name);
      if ('read' in slide) {
        input.disabled = !layer;
        if (layer && valueOf(slide.name) !== Number(slide.read(layer).toPrecision(3))) input.valueAsNumber = slide.scale.from(slide.read(layer));
      }
      const text = `${SHORT.format('read' in slide && layer ? slide.read(layer) : valueOf(slide.name))} ${slide.unit}`;
      const [least, most] = [Number(input.min), Number(input.max)];
      input.style.setProperty('--filled', `${((input.valueAsNumber - least) / (most - least)) * 100}%`);
      input.setAttribute('aria-valuetext', text);
      const output = input.parentElement?.querySelector('output');
      if (output) output.value = text;
    }
    const { kind } = lamp();
    for (const [name, shown] of /** @type {const} */ ([['kelvin', Boolean(KELVIN[kind])], ['colour', kind === OWN]])) {
      /** @type {HTMLElement} */ (field(name).closest('label')).hidden = !shown;
    }
    status.textContent = length === 0 ? 'Click the ground to put a lamp there.' : `${length} ${length === 1 ? 'lamp stands' : 'lamps stand'} on the ground.`;
    undo.disabled = clear.disabled = length === 0;
    const chosen = choiceOf(current);
    const known = [...new Set([...names, ...(current?.kind === 'asset' ? [current.name] : [])])].toSorted();
    if (JSON.stringify(known) !== listed) {
      listed = JSON.stringify(known);
      const files = known.length > 0 ? [h('optgroup', { label: 'Files' }, ...known.map((name) => h('option', { value: `lights/${name}` }, name)))] : [];
      select.replaceChildren(h('option', { value: '' }, 'None'), h('option', { value: 'procedural' }, 'A town by chance'), ...files);
    }
    select.value = chosen;
  }
  const refresh = async () => {
    names = await namesOf('lights');
    update();
  };
  return {
    tap,
    update,
    names: () => names,
    opened() {
      update();
      attempt(refresh);
    },
    /** A list of lamps that the server has. */
    async townName() {
      await refresh();
      if (names.length === 0) throw new Error('The server keeps no list of lamps yet. Send one under “Lamps and pillars”.');
      return names[0];
    },
  };
}
