/** Mountains and models: what stands on the ground, from a seed, from the server's files, or from one sent there. */
import { namesOf, TERRAIN_FILES, terrainKind, upload } from '../assets.js';
import { byId, h, uniqueId } from '../dom.js';
import { announce } from '../toast.js';
import { choiceOf, heights, mesh, mountains } from './document.js';

/** @typedef {'heightfields' | 'meshes'} Kind */

const HEADINGS = { heightfields: 'Heightfields', meshes: 'Meshes' };
const KINDS = /** @type {Kind[]} */ (Object.keys(HEADINGS));

/** @param {import('../store.js').Store} store @param {{drop: HTMLElement}} parts `drop`: where a file may be dropped */
export function createTerrainFiles(store, { drop }) {
  const node = /** @type {import('../schema.js').Property} */ (store.root.properties?.find(({ key }) => key === 'terrain')).node;
  const ids = [uniqueId('terrain'), uniqueId('terrain'), uniqueId('terrain'), uniqueId('terrain')];
  const fold = h('button', { type: 'button', class: 'fold', 'aria-expanded': 'false', 'aria-controls': ids[0] }, 'Mountains and models');
  const select = h('select', { id: ids[1] });
  const other = h('button', { type: 'button' }, 'Others');
  const file = h('input', { type: 'file', id: ids[2], accept: TERRAIN_FILES });
  const progress = h('p', { class: 'note', role: 'status' });
  const error = h('p', { class: 'error', id: ids[3], role: 'alert', hidden: true });
  const body = h(
    'div',
    { class: 'group-body terrain-files', id: ids[0], hidden: true },
    h('label', { for: ids[1] }, 'On the ground'),
    h('div', { class: 'row' }, select, other),
    h('label', { for: ids[2] }, 'Heights (PNG of 16 bits, GeoTIFF, NPY) or a mesh (GLB; ZIP of OBJ, MTL and textures), or drop one here'),
    file, progress, error,
  );
  byId('terrain-files', HTMLElement).append(h('div', { class: 'group-head' }, fold), body);

  /** @type {Record<Kind, string[]>} */
  const names = { heightfields: [], meshes: [] };
  const held = () => store.scene.terrain;
  const set = (/** @type {any} */ terrain) => store.set('/terrain', terrain);
  const use = (/** @type {Kind} */ kind, /** @type {string} */ name) => set(kind === 'meshes' ? mesh(node, held(), name) : heights(node, held(), name));
  const complain = (/** @type {unknown} */ cause) => {
    const { message } = /** @type {Error} */ (cause);
    error.textContent = message.charAt(0).toUpperCase() + message.slice(1);
    error.hidden = false;
  };

  /** What the list was made of. */
  let listed = '';
  const update = () => {
    const current = choiceOf(held());
    const known = KINDS.map((kind) => [...new Set([...names[kind], ...(current.startsWith(`${kind}/`) ? [current.slice(kind.length + 1)] : [])])].toSorted());
    const next = JSON.stringify(known);
    if (next !== listed) {
      listed = next;
      const groups = KINDS.flatMap((kind, i) => (known[i].length > 0 ? [h('optgroup', { label: HEADINGS[kind] }, ...known[i].map((name) => h('option', { value: `${kind}/${name}` }, name)))] : []));
      select.replaceChildren(h('option', { value: '' }, 'Nothing'), h('option', { value: 'mountains' }, 'Mountains from a seed'), ...groups);
    }
    select.value = current;
    other.disabled = current !== 'mountains';
    other.title = 'Mountains of another seed';
  };
  const refresh = async () => {
    const lists = await Promise.all(KINDS.map(namesOf));
    KINDS.forEach((kind, i) => (names[kind] = lists[i]));
    update();
  };
  const attempt = async (/** @type {() => Promise<void>} */ act) => {
    error.hidden = true;
    try {
      await act();
    } catch (cause) {
      complain(cause);
    }
  };
  const send = (/** @type {File} */ sent) =>
    attempt(async () => {
      const kind = /** @type {Kind | null} */ (terrainKind(sent.name));
      if (!kind) throw new Error(`${sent.name} is neither heights (${TERRAIN_FILES.replaceAll(',', ' ')}) nor a mesh.`);
      progress.textContent = `Sending ${sent.name} …`;
      try {
        const name = await upload(kind, sent, kind === 'meshes' ? 'mesh' : 'heights');
        names[kind] = [...names[kind], name];
        use(kind, name);
        announce(`${sent.name} is kept as ${name}.`);
      } finally {
        progress.textContent = '';
      }
    });

  const open = (/** @type {boolean} */ shown) => {
    body.hidden = !shown;
    fold.setAttribute('aria-expanded', String(shown));
    if (shown) attempt(refresh);
  };
  fold.addEventListener('click', () => open(Boolean(body.hidden)));
  select.addEventListener('change', () => {
    const [kind, name] = select.value.split('/');
    if (select.value === '') set(null);
    else if (select.value === 'mountains') set(mountains(node, held()));
    else use(/** @type {Kind} */ (kind), name);
  });
  other.addEventListener('click', () => store.set('/terrain/mountains', { ...mountains(node, held()).mountains, seed: crypto.getRandomValues(new Uint32Array(1))[0] }));
  file.addEventListener('change', async () => {
    const [sent] = file.files ?? [];
    if (sent) await send(sent);
    file.value = '';
  });
  drop.addEventListener('dragover', (event) => {
    if (event.dataTransfer?.types.includes('Files')) event.preventDefault();
  });
  drop.addEventListener('drop', (event) => {
    const [sent] = event.dataTransfer?.files ?? [];
    if (!sent) return;
    event.preventDefault();
    open(true);
    send(sent);
  });

  return {
    update,
    heightfields: () => names.heightfields,
    /** What might stand in the place of what the scene names. */
    names: () => (held()?.kind === 'mesh' ? names.meshes : names.heightfields),
    mountains: () => mountains(node, held()),
    /** A mesh that the server has. */
    async meshName() {
      await refresh();
      const [first] = names.meshes;
      if (first === undefined) throw new Error('The server keeps no mesh yet. Send one under “Mountains and models”.');
      return first;
    },
  };
}
