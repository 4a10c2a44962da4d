/** The weather painted in the page: it reaches the server and the sky, is kept, loaded, sent as a file and refused. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { CHEAP, colours, difference, PHONE, sentScene, settled, STRIP, useBrowser } from './page.mjs';

const open = useBrowser();
const openWithout = useBrowser(['--max-assets', '0']);
/** A part of the picture's change that JPEG and dither do not make, of 255. */
const SEEN = 2;
/** Clouds of one layer, so that what is painted is all there is. */
const HASH = `#camera.direction.elevation_deg=30&camera.direction.azimuth_deg=0&clouds.layers=[{"kind":"volume"}]&${CHEAP}`;

/** @typedef {import('./page.mjs').Page} Page */
/** @param {Page} page */
const mapName = (page) => sentScene(page).clouds?.weather_map.name;
/** @param {Page} page @param {'channel' | 'tool'} name @param {string} value */
const choose = (page, name, value) => page.locator(`#paint-form label:has([name="${name}"][value="${value}"])`).click();
/** @param {Page} page @param {string} name @param {number} value */
const slide = (page, name, value) => page.locator(`#paint-form [name="${name}"]`).fill(String(value));
/** A colour of the map that the server keeps, R, G, B. @param {Page} page @param {string} name @param {number} x Of its side @param {number} y */
const kept = (page, name, x, y) =>
  page.evaluate(
    async ([map, u, v]) => {
      const bitmap = await createImageBitmap(await (await fetch(`v1/assets/weather-maps/${map}`)).blob());
      const context = /** @type {OffscreenCanvasRenderingContext2D} */ (new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d'));
      context.drawImage(bitmap, 0, 0);
      return [...context.getImageData(Math.floor(Number(u) * bitmap.width), Math.floor(Number(v) * bitmap.height), 1, 1).data.slice(0, 3)];
    },
    /** @type {const} */ ([name, x, y]),
  );
/** Does what makes the page send the map, and waits until the server has it, and the sky. @param {Page} page @param {() => Promise<unknown>} act */
async function sending(page, act) {
  const frames = Number(await page.locator('#sky').getAttribute('data-frames'));
  const [answer] = await Promise.all([page.waitForResponse((response) => response.request().method() === 'PUT' && response.ok()), act()]);
  assert.ok([200, 201].includes(answer.status()));
  await page.waitForFunction((old) => Number(document.getElementById('sky')?.dataset.frames) > old && document.body.dataset.state === 'final', frames);
}
/** @param {Page} page @param {[number, number][]} points Of the map's side */
async function stroke(page, points) {
  await page.locator('#map').scrollIntoViewIfNeeded();
  const box = await page.locator('#map').boundingBox();
  assert.ok(box);
  const [first, ...rest] = points.map(([x, y]) => /** @type {const} */ ([box.x + x * box.width, box.y + y * box.height]));
  await page.mouse.move(...first);
  await page.mouse.down();
  for (const point of rest) await page.mouse.move(...point, { steps: 6 });
  await page.mouse.up();
}
/** @param {Page} page */
const openMap = async (page) => {
  await page.locator('#open-painter').click();
  await page.locator('#paint-fill:enabled').waitFor();
};
/** @param {Page} page @param {string} text */
const error = async (page, text) => {
  await page.locator('#paint-error', { hasText: text }).waitFor({ state: 'visible' });
};
/** A PNG of one colour. @param {Page} page @param {string} colour */
const png = async (page, colour) =>
  Buffer.from(
    await page.evaluate(async (fill) => {
      const canvas = new OffscreenCanvas(64, 64);
      const context = /** @type {OffscreenCanvasRenderingContext2D} */ (canvas.getContext('2d'));
      context.fillStyle = fill;
      context.fillRect(0, 0, 64, 64);
      return [...new Uint8Array(await (await canvas.convertToBlob({ type: 'image/png' })).arrayBuffer())];
    }, colour),
  );

test('a stroke reaches the server and the sky, and is undone there', () =>
  open(
    async (page) => {
      await openMap(page);
      assert.match((await page.locator('#paint-status').textContent()) ?? '', /other weather/);
      await slide(page, 'size', 20);
      await slide(page, 'strength', 100);
      // North of the observer, where the camera looks.
      await sending(page, () => stroke(page, [[0.35, 0.4], [0.65, 0.4]]));
      const name = mapName(page);
      assert.match(name, /^painted-[a-z0-9]+$/);
      assert.deepEqual(sentScene(page).clouds.weather_map, { kind: 'asset', name, convention: 'coverage-type-rain', extent_m: 60_000 });
      assert.match((await page.locator('#paint-status').textContent()) ?? '', new RegExp(name));
      await page.waitForTimeout(500);
      const [under, beside] = [await kept(page, name, 0.5, 0.4), await kept(page, name, 0.5, 0.9)];
      assert.ok(under[0] > 250, `R is coverage: ${under}`);
      assert.deepEqual(beside, [0, 128, 0], 'nothing else was touched');
      await settled(page);
      const painted = await colours(page);
      await sending(page, () => page.locator('#paint-undo').click());
      assert.deepEqual(await kept(page, name, 0.5, 0.4), [0, 128, 0]);
      await settled(page);
      const clear = await colours(page);
      const seen = difference(painted, clear);
      assert.ok(seen > 3 * SEEN, `the clouds are gone: ${seen}`);
      assert.ok(await page.locator('#paint-undo').isDisabled());
      assert.equal(await page.locator('#paint-form [name="map"]').inputValue(), name);
      await sending(page, () => stroke(page, [[0.35, 0.6], [0.65, 0.6]]));
      await page.waitForTimeout(500);
      await page.waitForSelector('body[data-state="final"]');
      // In the north there are only those of the next repetition, 54 km away.
      assert.ok(difference(await colours(page), clear) < seen / 3, 'what is painted in the south stands behind the camera');
    },
    { hash: HASH, viewport: STRIP },
  ));

test('each channel is filled, erased and cleared, and acts in the scene', () =>
  open(
    async (page) => {
      await openMap(page);
      await sending(page, () => page.locator('#paint-fill').click());
      const full = await colours(page);
      await choose(page, 'channel', 'type');
      await slide(page, 'level', 20);
      await sending(page, () => page.locator('#paint-fill').click());
      assert.equal(sentScene(page).clouds.layers[0].type, null, 'the map says the type');
      await choose(page, 'channel', 'rain');
      await slide(page, 'level', 100);
      await sending(page, () => page.locator('#paint-fill').click());
      assert.equal(sentScene(page).clouds.precipitation, 1, 'what is painted falls');
      assert.deepEqual(await kept(page, mapName(page), 0.2, 0.7), [255, 51, 255]);
      assert.ok(difference(full, await colours(page)) > SEEN, 'rain clouds of another type look otherwise');
      await choose(page, 'channel', 'coverage');
      await choose(page, 'tool', 'erase');
      await slide(page, 'strength', 100);
      await slide(page, 'size', 4);
      await sending(page, () => stroke(page, [[0.5, 0.5], [0.52, 0.5]]));
      await page.waitForTimeout(500);
      assert.ok((await kept(page, mapName(page), 0.51, 0.5))[0] < 40, 'rubbed out');
      assert.deepEqual(await kept(page, mapName(page), 0.2, 0.7), [255, 51, 255]);
      await sending(page, () => page.locator('#paint-clear').click());
      assert.deepEqual(await kept(page, mapName(page), 0.2, 0.7), [0, 128, 0]);
    },
    { hash: `#clouds.layers=[{"kind":"volume","type":0.9}]&${CHEAP}`, viewport: STRIP },
  ));

test('the keys paint, too, and leave the sun alone', () =>
  open(
    async (page) => {
      await openMap(page);
      await slide(page, 'strength', 100);
      await page.locator('#map').focus();
      for (let i = 0; i < 8; i++) await page.keyboard.press('ArrowRight');
      await page.keyboard.press('Shift+ArrowUp');
      assert.match((await page.locator('#map').getAttribute('aria-label')) ?? '', /75 percent from the west, 50 from the north/);
      await sending(page, () => page.keyboard.press('Space'));
      assert.ok((await kept(page, mapName(page), 0.75, 0.495))[0] > 240);
      assert.equal(sentScene(page).sun.position.azimuth_deg, 180);
      await sending(page, () => page.keyboard.press('Control+z'));
      assert.equal((await kept(page, mapName(page), 0.75, 0.495))[0], 0);
    },
    { hash: HASH, viewport: STRIP },
  ));

test('a pen paints as hard as it is pressed', () =>
  open(
    async (page) => {
      await openMap(page);
      await slide(page, 'strength', 80);
      await sending(page, () =>
        page.locator('#map').evaluate((map) => {
          const { left, top, width } = map.getBoundingClientRect();
          const at = (/** @type {number} */ x, /** @type {number} */ pressure) => ({ pointerId: 7, pointerType: 'pen', button: 0, clientX: left + x * width, clientY: top + 0.5 * width, pressure, bubbles: true });
          map.setPointerCapture = () => {};
          for (const [x, pressure] of [[0.25, 0.5], [0.75, 1]]) {
            map.dispatchEvent(new PointerEvent('pointerdown', at(x, pressure)));
            map.dispatchEvent(new PointerEvent('pointerup', at(x, 0)));
          }
        }),
      );
      await page.waitForTimeout(500);
      const [light, hard] = [await kept(page, mapName(page), 0.25, 0.5), await kept(page, mapName(page), 0.75, 0.5)];
      // 0.4 and 0.8 of 255 in the middle of the dab; half a cell beside it some less.
      assert.ok(Math.abs(light[0] - 102) < 3 && Math.abs(hard[0] - 204) < 4, `${light} ${hard}`);
    },
    { hash: HASH, viewport: STRIP },
  ));

test('a map is kept under a name, replaced when one says so, and loaded', () =>
  open(
    async (page) => {
      await openMap(page);
      await sending(page, () => page.locator('#paint-fill').click());
      await page.locator('#paint-name').fill('Not a name');
      await page.locator('#paint-save').click();
      assert.equal(await page.locator('#paint-name').evaluate((e) => /** @type {HTMLInputElement} */ (e).validity.valid), false);
      await page.locator('#paint-name').fill('all-over');
      await sending(page, () => page.locator('#paint-save').click());
      assert.equal(mapName(page), 'all-over');
      await sending(page, () => page.locator('#paint-clear').click());
      assert.match(mapName(page), /^painted-/, 'what was saved stays as it was');
      const clear = await colours(page);
      await page.locator('#paint-save').click();
      await error(page, 'There is a map of the name all-over');
      await page.locator('#paint-form [name="map"]').selectOption('all-over');
      await page.waitForFunction(() => document.getElementById('paint-status')?.textContent?.includes('all-over'));
      await page.locator('#paint-undo:disabled').waitFor();
      await page.waitForFunction(() => document.body.dataset.state === 'final');
      assert.ok(difference(clear, await colours(page)) > SEEN);
      await slide(page, 'strength', 100);
      await choose(page, 'tool', 'erase');
      await sending(page, () => stroke(page, [[0.5, 0.5], [0.5, 0.5]]));
      assert.equal((await kept(page, mapName(page), 0.9, 0.9))[0], 255, 'it was on the board');
      await page.locator('#paint-save').click();
      await sending(page, () => page.locator('#paint-replace').click());
      assert.ok((await kept(page, 'all-over', 0.5, 0.5))[0] < 40);
    },
    { hash: HASH, viewport: STRIP, logs: /412/ },
  ));

test('a file is taken, by choice or dropped, or its refusal said', () =>
  open(
    async (page) => {
      await openMap(page);
      const file = page.locator('#paint-form [name="file"]');
      await file.setInputFiles({ name: 'notes.png', mimeType: 'image/png', buffer: Buffer.from('no picture') });
      await error(page, 'PNG');
      await sending(page, async () => file.setInputFiles({ name: 'My front.png', mimeType: 'image/png', buffer: await png(page, 'rgb(10,20,30)') }));
      assert.equal(mapName(page), 'my-front');
      assert.ok(await page.locator('#paint-error').isHidden());
      await sending(page, async () => file.setInputFiles({ name: 'My front.png', mimeType: 'image/png', buffer: await png(page, 'rgb(40,50,60)') }));
      assert.equal(mapName(page), 'my-front-2', 'one of the same name stays');
      const bytes = [...(await png(page, 'rgb(200,100,0)'))];
      await sending(page, () =>
        page.locator('#painter').evaluate((drawer, data) => {
          const transfer = new DataTransfer();
          transfer.items.add(new File([new Uint8Array(data)], 'dropped.png', { type: 'image/png' }));
          drawer.dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }));
        }, bytes),
      );
      assert.equal(mapName(page), 'dropped');
      assert.deepEqual(await kept(page, 'my-front', 0.5, 0.5), [10, 20, 30]);
      const shown = await page.locator('#map').evaluate((map) => [.../** @type {any} */ (map).getContext('2d').getImageData(5, 5, 1, 1).data]);
      assert.ok(shown[0] > 150, `the board shows it: ${shown}`);
    },
    { hash: HASH, viewport: STRIP, logs: /412|415/ },
  ));

test('a reload goes on with the map', () =>
  open(
    async (page) => {
      await openMap(page);
      await sending(page, () => page.locator('#paint-fill').click());
      const name = mapName(page);
      await page.waitForURL(new RegExp(name));
      await page.reload();
      await page.waitForSelector('body[data-state="final"]');
      await openMap(page);
      await page.waitForFunction((map) => document.getElementById('paint-status')?.textContent?.includes(map), name);
      await page.waitForFunction(() => /** @type {any} */ (document.getElementById('map')).getContext('2d').getImageData(9, 9, 1, 1).data[0] > 200);
      await slide(page, 'strength', 100);
      await choose(page, 'tool', 'erase');
      await sending(page, () => stroke(page, [[0.5, 0.5], [0.5, 0.5]]));
      assert.equal(mapName(page), name);
      assert.equal((await kept(page, name, 0.1, 0.1))[0], 255);
    },
    // Polling the board is the test's own doing.
    { hash: HASH, viewport: STRIP, logs: /willReadFrequently/ },
  ));

test('the map shows its extent, the observer and where the camera looks', () =>
  open(
    async (page) => {
      await openMap(page);
      await sending(page, () => page.locator('#paint-fill').click());
      const extent = page.locator('#paint-form [name="extent"]');
      assert.equal(await extent.inputValue(), '60');
      assert.equal(await page.locator('#map-scale text').textContent(), '10 km');
      await extent.fill('6');
      await page.waitForFunction(() => document.querySelector('#map-scale text')?.textContent === '1 km');
      assert.equal(sentScene(page).clouds.weather_map.extent_m, 6000);
      const wedge = () => page.locator('#map-view').getAttribute('d');
      const north = await wedge();
      await page.locator('#sky').focus();
      await page.keyboard.press('e');
      await page.waitForFunction((old) => document.getElementById('map-view')?.getAttribute('d') !== old, north);
    },
    { hash: HASH, viewport: STRIP },
  ));

test('fingers paint on a phone, and the sheet does not scroll away under them', () =>
  open(
    async (page) => {
      await openMap(page);
      await slide(page, 'strength', 100);
      await page.locator('#map').scrollIntoViewIfNeeded();
      const box = await page.locator('#map').boundingBox();
      assert.ok(box && box.width > 150);
      await sending(page, () => page.touchscreen.tap(box.x + box.width / 4, box.y + box.height / 4));
      await page.waitForTimeout(500);
      assert.ok((await kept(page, mapName(page), 0.25, 0.25))[0] > 200);
      assert.equal(await page.locator('#map').evaluate((e) => getComputedStyle(e).touchAction), 'none');
    },
    { hash: HASH, viewport: PHONE, touch: true },
  ));

test('where the server keeps no maps it is said, and nothing can be painted', () =>
  openWithout(
    async (page) => {
      await page.locator('#open-painter').click();
      await error(page, 'keeps no assets');
      assert.match((await page.locator('#paint-status').textContent()) ?? '', /Nothing can be painted/);
      assert.ok(await page.locator('#paint-fill').isDisabled());
      assert.ok(await page.locator('#map').evaluate((e) => e.hasAttribute('inert')));
      await page.locator('[data-pointer="/clouds"] > .group-head .fold').click();
      const kind = page.locator('.field[data-pointer="/clouds/weather_map"] select').first();
      await kind.selectOption({ label: 'Asset' });
      await page.locator('.field[data-pointer="/clouds/weather_map"] .error', { hasText: 'keeps no assets' }).waitFor({ state: 'visible' });
      assert.equal(await kind.locator('option:checked').textContent(), 'Procedural');
    },
    { hash: HASH, viewport: STRIP, logs: /404/ },
  ));
