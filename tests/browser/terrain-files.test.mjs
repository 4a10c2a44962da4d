/** Terrain from files: sent, listed, chosen, refused. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { assetName, terrainKind } from '../../web/src/assets.js';
import { sentScene, settled, telling, useBrowser } from './page.mjs';

const open = useBrowser();
const SMALL = { viewport: { width: 740, height: 320 } };
const SIDE = 16;

/** Heights of a cone, metres, as NumPy writes them. */
function npy() {
  const text = `{'descr': '<f4', 'fortran_order': False, 'shape': (${SIDE}, ${SIDE}), }`;
  // Magic, version and length take 10 bytes; the header ends at a multiple of 64.
  const header = `${text.padEnd(128 - 10 - 1)}\n`;
  const begin = Buffer.concat([Buffer.from('\x93NUMPY\x01\x00', 'latin1'), Buffer.from([header.length, 0]), Buffer.from(header)]);
  const heights = Float32Array.from({ length: SIDE ** 2 }, (_, i) => Math.max(0, 500 - 80 * Math.hypot((i % SIDE) - 8, Math.floor(i / SIDE) - 8)));
  return Buffer.concat([begin, Buffer.from(heights.buffer)]);
}

/** One triangle as binary glTF. */
function glb() {
  const points = Buffer.from(Float32Array.from([0, 0, 0, 100, 0, 0, 0, 80, 0]).buffer);
  const json = JSON.stringify({
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [0, 0, 0], max: [100, 80, 0] }],
    bufferViews: [{ buffer: 0, byteLength: points.length }],
    buffers: [{ byteLength: points.length }],
  });
  const text = Buffer.from(json.padEnd(Math.ceil(json.length / 4) * 4));
  const word = (/** @type {number} */ value) => Buffer.from(Uint32Array.of(value).buffer);
  const length = 12 + 8 + text.length + 8 + points.length;
  return Buffer.concat([Buffer.from('glTF'), word(2), word(length), word(text.length), Buffer.from('JSON'), text, word(points.length), Buffer.from('BIN\0'), points]);
}

test('the end of its name tells what a file is for', () => {
  assert.deepEqual(['Alps.TIF', 'a.npy', 'town.GLB', 'town.zip', 'notes.txt', 'npy'].map(terrainKind), ['heightfields', 'heightfields', 'meshes', 'meshes', null, null]);
  assert.equal(assetName('Mont Blanc (2).tif', 'heights'), 'mont-blanc-2');
  assert.equal(assetName('ü.tif', 'heights'), 'heights');
});

test('heights and meshes are sent, stand on the ground, and can be chosen again', () =>
  open(
    async (page, server) => {
      await page.getByRole('button', { name: 'Mountains and models' }).click();
      const [file, choice, error] = [page.locator('.terrain-files input[type="file"]'), page.getByLabel('On the ground'), page.locator('.terrain-files .error')];
      const terrain = () => sentScene(page).terrain;
      await telling(page, () => file.setInputFiles({ name: 'My alps.npy', mimeType: '', buffer: npy() }));
      assert.deepEqual([terrain().kind, terrain().name, terrain().mountains, terrain().extent_m], ['heightfield', 'my-alps', null, null]);
      assert.equal(await choice.inputValue(), 'heightfields/my-alps');
      await settled(page);
      await telling(page, () => file.setInputFiles({ name: 'tower.glb', mimeType: 'model/gltf-binary', buffer: glb() }));
      assert.deepEqual([terrain().kind, terrain().name, terrain().scale], ['mesh', 'tower', 1]);
      await settled(page);
      const kept = async (/** @type {string} */ kind) => (await (await fetch(`${server.url}v1/assets/${kind}`)).json()).assets.map((/** @type {any} */ a) => a.name);
      assert.deepEqual([await kept('heightfields'), await kept('meshes')], [['my-alps'], ['tower']]);
      await telling(page, () => choice.selectOption('heightfields/my-alps'));
      assert.equal(terrain().name, 'my-alps');
      // The same name again is another file.
      await telling(page, () =>
        page.locator('#sky').evaluate((sky, bytes) => {
          const transfer = new DataTransfer();
          transfer.items.add(new File([Uint8Array.from(bytes)], 'My alps.npy'));
          sky.dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }));
        }, [...npy()]),
      );
      assert.equal(terrain().name, 'my-alps-2');
      // The kind of terrain in the panel below takes a mesh that there is.
      await page.locator('section[data-pointer="/terrain"] .fold').first().click();
      await telling(page, () => page.locator('.field[data-pointer="/terrain"] select').selectOption({ label: 'Mesh' }));
      assert.equal(terrain().name, 'tower');
      for (const [name, buffer, says] of /** @type {[string, Buffer, RegExp][]} */ ([['notes.txt', Buffer.from('no'), /neither heights/], ['bad.npy', Buffer.from('no heights'), /./]])) {
        await file.setInputFiles({ name, mimeType: '', buffer });
        await page.waitForFunction((text) => document.querySelector('.terrain-files .error')?.textContent !== text, '');
        await error.waitFor({ state: 'visible' });
        assert.match((await error.textContent()) ?? '', says);
        assert.equal(terrain().name, 'tower', 'the scene stays');
      }
      await settled(page);
    },
    // What the server refuses, Chromium logs.
    { ...SMALL, logs: /status of 4\d\d/ },
  ));
