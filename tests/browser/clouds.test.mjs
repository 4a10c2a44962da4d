/** Clouds in the panel, skies to choose from, and a sky by chance. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { changing, CHEAP, colours, difference, numberAt, PHONE, sent, sentScene, settled, STRIP, telling, useBrowser } from './page.mjs';

const open = useBrowser();
/** A part of the picture's change that JPEG and dither do not make, of 255. */
const SEEN = 2;
/** @param {string} pointer */
const field = (pointer) => `[data-pointer="${pointer}"]`;
/** @param {import('./page.mjs').Page} page @param {string} pointer */
const unfold = (page, pointer) => page.locator(`${field(pointer)} > .group-head .fold`).click();
/** @param {any} layer */
const kinds = ({ kind }) => kind;
const CLOUDS = `#${CHEAP}`;

test('a page without an address opens on fair weather', () =>
  open(
    async (page) => {
      assert.deepEqual(sentScene(page).clouds.layers.map(kinds), ['volume', 'sheet']);
      assert.equal(new URL(page.url()).hash, '');
    },
    { hash: '', clear: false, viewport: STRIP },
  ));

test('clouds are switched on, thickened, and off again', () =>
  open(
    async (page) => {
      const clear = await colours(page);
      await changing(page, () => page.locator(`${field('/clouds')} > .group-head .switch`).click());
      assert.equal(await numberAt(page, '/clouds/coverage'), 0.3);
      const some = await colours(page);
      assert.ok(difference(clear, some) > SEEN, 'there are clouds');
      await changing(page, () => page.locator(`${field('/clouds/coverage')} input[type="range"]`).first().fill('1000'));
      assert.equal(sentScene(page).clouds.coverage, 1);
      assert.ok(difference(some, await colours(page)) > SEEN, 'more of them');
      await changing(page, () => page.locator(`${field('/clouds')} > .group-head .switch`).click());
      assert.equal(sentScene(page).clouds, null);
      assert.ok(difference(clear, await colours(page)) < SEEN);
    },
    { hash: '#clouds=null', viewport: STRIP },
  ));

test('layers are added, put in another order, changed and removed', () =>
  open(
    async (page) => {
      await unfold(page, '/clouds');
      await unfold(page, '/clouds/layers');
      const layers = () => sentScene(page).clouds.layers;
      await telling(page, () => page.getByRole('button', { name: 'Move layer 2 up' }).click());
      assert.deepEqual(layers().map(kinds), ['sheet', 'volume']);
      assert.ok(await page.getByRole('button', { name: 'Move layer 1 down' }).evaluate((e) => e === document.activeElement), 'the focus goes along');
      await telling(page, () => page.getByRole('button', { name: 'Add a layer' }).click());
      assert.deepEqual(layers().map(kinds), ['sheet', 'volume', 'volume']);
      const kind = page.locator(`${field('/clouds/layers/2')} select`).first();
      assert.ok(await kind.evaluate((e) => e === document.activeElement), 'the new one is at hand');
      await telling(page, () => kind.selectOption('1'));
      await telling(page, () => page.locator(`.field${field('/clouds/layers/2/genus')} select`).selectOption('altocumulus'));
      assert.deepEqual([layers()[2].kind, layers()[2].genus], ['sheet', 'altocumulus']);
      await telling(page, () => page.locator('[data-optional="/clouds/layers/2/coverage"] .switch').click());
      assert.equal(layers()[2].coverage, 0.3, 'that of the clouds');
      await telling(page, () => page.getByRole('button', { name: 'Remove layer 1' }).click());
      assert.deepEqual(layers().map(kinds), ['volume', 'sheet']);
      for (let count = 2; count < 8; count++) await telling(page, () => page.getByRole('button', { name: 'Add a layer' }).click());
      assert.ok(await page.getByRole('button', { name: 'Add a layer' }).isDisabled(), 'eight are the most');
      await page.waitForURL(/clouds\.layers=/);
      assert.equal(await page.locator('.toast.bad').count(), 0);
    },
    { hash: CLOUDS, viewport: STRIP },
  ));

test('what layers cannot be is said at the layer', () =>
  open(
    async (page) => {
      await unfold(page, '/clouds');
      await unfold(page, '/clouds/layers');
      const top = page.locator(`.field${field('/clouds/layers/0/top_m')}`);
      await top.locator('input[type="number"]').fill('1000');
      await top.locator('.error').waitFor({ state: 'visible' });
      assert.match((await top.locator('.error').textContent()) ?? '', /base_m/);
    },
    { hash: CLOUDS, viewport: STRIP },
  ));

test('the weather map takes each of its kinds', () =>
  open(
    async (page, server) => {
      await unfold(page, '/clouds');
      const map = () => sentScene(page).clouds.weather_map;
      const kind = page.locator(`.field${field('/clouds/weather_map')} select`).first();
      await telling(page, () => page.locator(`${field('/clouds/weather_map/extent_m')} input[type="number"]`).fill('30000'));
      await telling(page, () => kind.selectOption({ label: 'Uniform' }));
      assert.deepEqual(map(), { kind: 'uniform', coverage: 1, rain: 0, type: 0.5 });
      await telling(page, () => kind.selectOption({ label: 'Blend' }));
      await telling(page, () => page.locator(`.field${field('/clouds/weather_map/from')} select`).selectOption({ label: 'Uniform' }));
      await telling(page, () => page.locator(`${field('/clouds/weather_map/share')} input[type="number"]`).fill('0.25'));
      assert.deepEqual([map().from.kind, map().to.kind, map().share], ['uniform', 'procedural', 0.25]);
      // The server has no map yet: a blank one is made, and there is where to paint it.
      // Drawn, so that there is a name to go back to.
      await changing(page, () => kind.selectOption({ label: 'Asset' }));
      assert.match(map().name, /^painted-/);
      await page.locator('#painter').waitFor({ state: 'visible' });
      const { assets } = await (await fetch(`${server.url}v1/assets/weather-maps`)).json();
      assert.deepEqual(assets.map((/** @type {any} */ a) => [a.name, a.width_px, a.height_px]), [[map().name, 512, 512]]);
      const name = page.locator(`.field${field('/clouds/weather_map/name')} input`);
      await name.focus();
      assert.equal(await page.locator(`.field${field('/clouds/weather_map/name')} option`).first().getAttribute('value'), map().name, 'known names are offered');
      await name.fill('nothing-there');
      await name.press('Enter');
      await page.locator(`.field${field('/clouds/weather_map/name')} .error`).waitFor({ state: 'visible' });
      await settled(page);
    },
    { hash: CLOUDS, viewport: STRIP },
  ));

test('skies to choose from have pictures, fetched one after another and only those in sight', () =>
  open(async (page) => {
    let [asked, underway, most] = [0, 0, 0];
    const isPicture = (/** @type {import('playwright-core').Request} */ request) => request.url().includes('/v1/frames?');
    page.on('request', (request) => {
      if (!isPicture(request)) return;
      [asked, underway] = [asked + 1, underway + 1];
      most = Math.max(most, underway);
    });
    page.on('requestfinished', (request) => isPicture(request) && (underway -= 1));
    assert.equal(asked, 0, 'none before they are looked for');
    await page.locator('#open-gallery').click();
    const card = page.locator('[data-gallery="stratus"]');
    await card.scrollIntoViewIfNeeded();
    await page.waitForFunction(() => /** @type {HTMLImageElement | null} */ (document.querySelector('[data-gallery="stratus"] img'))?.naturalWidth === 192);
    assert.equal(most, 1);
    const presets = await (await fetch(new URL('v1/presets', page.url()))).json();
    assert.equal(await page.locator('[data-gallery]').count(), presets.length);
    assert.ok(asked < presets.length, `${asked} of ${presets.length}`);
    const before = await colours(page);
    await telling(page, () => card.click());
    await page.waitForFunction((seq) => Number(document.getElementById('sky')?.dataset.seq) >= seq, sent(page).at(-1).seq);
    assert.equal(await card.getAttribute('aria-pressed'), 'true');
    const stratus = presets.find((/** @type {any} */ p) => p.name === 'stratus').scene;
    assert.deepEqual(sentScene(page), stratus);
    assert.ok(difference(before, await colours(page)) > SEEN);
    await page.keyboard.press('Escape');
    assert.ok(await page.locator('#gallery').isHidden());
    assert.ok(await page.locator('#open-gallery').evaluate((e) => e === document.activeElement));
  }));

test('a surprise is another sky in the same view, and is taken back', () =>
  open(
    async (page) => {
      const [before, scene] = [await colours(page), sentScene(page)];
      await telling(page, () => page.locator('#surprise').click());
      const next = sentScene(page);
      assert.ok(next.clouds.seed !== scene.clouds?.seed && next.sun.position.elevation_deg >= 4);
      assert.deepEqual(next.camera, scene.camera);
      // The first picture of it, which need not be the final one.
      await page.waitForFunction((seq) => Number(document.getElementById('sky')?.dataset.seq) >= seq, sent(page).at(-1).seq);
      assert.ok(difference(before, await colours(page)) > SEEN);
      await changing(page, () => page.locator('.toast button', { hasText: 'Undo' }).click());
      assert.deepEqual(sentScene(page), scene);
      assert.ok(difference(before, await colours(page)) < SEEN);
      await page.locator('#sky').focus();
      for (const key of ['n', 'n', 'u', 'u']) await telling(page, () => page.keyboard.press(key));
      assert.deepEqual(sentScene(page), scene);
    },
    { viewport: STRIP },
  ));

test('on a phone nothing overflows, whatever is open', () =>
  open(
    async (page) => {
      const wide = () =>
        page.evaluate(() =>
          [...document.querySelectorAll('body *')]
            .filter((e) => e.closest('#presets') === null && e.checkVisibility() && e.getBoundingClientRect().right > window.innerWidth + 0.5)
            .map((e) => e.outerHTML.slice(0, 80)),
        );
      for (const id of ['gallery', 'painter', 'timeline']) {
        await page.locator(`#open-${id}`).click();
        await page.locator(`#${id}`).waitFor({ state: 'visible' });
        assert.deepEqual(await wide(), [], id);
      }
      assert.ok(await page.locator('#gallery').isHidden(), 'one drawer at a time');
      const [drawer, bar] = [await page.locator('#painter').boundingBox(), await page.locator('#timeline').boundingBox()];
      assert.ok(drawer && bar && drawer.y > PHONE.height / 4 && drawer.y + drawer.height <= bar.y + 1, 'the sky stays in sight, and the drawer above the timeline');
      await page.locator('#toggle-panel').click();
      assert.ok(await page.locator('#painter').isHidden(), 'panel or drawer');
      assert.deepEqual(await wide(), []);
    },
    { viewport: PHONE },
  ));
