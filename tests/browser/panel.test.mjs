/** Panel, presets, time and place, the address, and what the server refuses. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { changing, colours, difference, numberAt, PHONE, settled, STRIP, sunAngles, useBrowser } from './page.mjs';

const open = useBrowser();
const SEEN = 2;
/** @param {string} pointer */
const field = (pointer) => `[data-pointer="${pointer}"]`;
/** A field that may be off. @param {string} pointer */
const optional = (pointer) => `[data-optional="${pointer}"]`;
/** @param {import('./page.mjs').Page} page @param {string} pointer */
const unfold = (page, pointer) => page.locator(`${field(pointer)} > .group-head .fold`).click();

test('the panel has a field for every number, text and switch of the schema', () =>
  open(async (page) => {
    const scene = (await (await fetch(new URL('v1/presets', page.url()))).json())[0].scene;
    /** @param {any} value @param {string} pointer @returns {string[]} */
    const leaves = (value, pointer) =>
      value !== null && typeof value === 'object' && !Array.isArray(value)
        ? Object.entries(value).filter(([key]) => key !== 'kind').flatMap(([key, v]) => leaves(v, `${pointer}/${key}`))
        : [pointer];
    const stands = (/** @type {string} */ pointer) => page.locator(`.field${field(pointer)}, .group${field(pointer)}, ${optional(pointer)}`);
    for (const pointer of leaves(scene, '')) assert.equal(await stands(pointer).count(), 1, pointer);
    const label = page.locator(`.field${field('/camera/roll_deg')} label`);
    assert.equal(await label.textContent(), 'Roll°');
    assert.match((await label.getAttribute('title')) ?? '', /Rotation of the picture/);
  }));

test('every control has a name for a screen reader', () =>
  open(async (page) => {
    const nameless = await page.evaluate(() =>
      [...document.querySelectorAll('button, input, select, textarea, [role="application"]')]
        .filter((e) => !e.getAttribute('aria-label') && !e.getAttribute('aria-labelledby') && (e.matches('select') || !e.textContent?.trim()))
        .filter((e) => !('labels' in e && /** @type {NodeListOf<HTMLLabelElement>} */ (e.labels)?.length))
        .map((e) => e.outerHTML),
    );
    assert.deepEqual(nameless, []);
  }));

test('a preset shows its scene', () =>
  open(async (page) => {
    const before = await colours(page);
    await changing(page, () => page.locator('[data-preset="golden-hour"]').click());
    assert.deepEqual(await sunAngles(page), { azimuth: 250, elevation: 6 });
    assert.equal(await page.locator('[data-preset="golden-hour"]').getAttribute('aria-pressed'), 'true');
    assert.ok(difference(before, await colours(page)) > SEEN);
    await changing(page, () => page.keyboard.press('1'));
    assert.equal(await page.locator('[data-preset]').first().getAttribute('aria-pressed'), 'true');
  }));

test('a field acts and resets', () =>
  open(async (page) => {
    const before = await colours(page);
    await unfold(page, '/planet');
    const albedo = page.locator(`${field('/planet/ground_albedo')} input`);
    await changing(page, () => albedo.nth(0).fill('0.9'));
    assert.ok(difference(before, await colours(page)) > SEEN, 'the ground is red');
    await changing(page, () => page.locator(`.field${field('/planet/ground_albedo')} .reset`).click());
    assert.equal(await albedo.nth(0).inputValue(), '0.1');
    await unfold(page, '/atmosphere');
    await changing(page, () => page.locator(`${field('/atmosphere/density_factor')} input[type="range"]`).fill('900'));
    assert.ok((await numberAt(page, '/atmosphere/density_factor')) > 10, 'the slider is logarithmic');
    await changing(page, () => page.locator(`${field('/atmosphere')} > .group-head .reset`).click());
    assert.equal(await numberAt(page, '/atmosphere/density_factor'), 1);
  }));

test('a part is switched off and on, and stays so in the address', () =>
  open(async (page) => {
    const before = await colours(page);
    await changing(page, () => page.locator(`${field('/atmosphere')} > .group-head .switch`).click());
    assert.ok(difference(before, await colours(page)) > 20, 'vacuum is black');
    await page.waitForURL('**#clouds=null&atmosphere=null');
    await changing(page, () => page.locator(`${field('/atmosphere')} > .group-head .switch`).click());
    assert.ok(difference(before, await colours(page)) < SEEN);
    await changing(page, () => page.locator(`${field('/atmosphere/ozone')} > .group-head .switch`).click());
    await page.waitForURL('**#clouds=null&atmosphere.ozone=null');
  }));

test('another variant keeps what the old one said', () =>
  open(async (page) => {
    await unfold(page, '/display');
    const kinds = page.locator(`.field${field('/display/exposure')} select`);
    const before = await colours(page);
    await changing(page, () => kinds.selectOption({ label: 'EV' }));
    const ev = await numberAt(page, '/display/exposure/ev');
    assert.ok(ev > 5 && ev < 20, `metered EV ${ev}`);
    // The metered value is rounded to a tenth of a stop, 7 % of the light.
    assert.ok(difference(before, await colours(page)) < 10);
    const position = page.locator(`.field${field('/sun/position')} select`);
    await changing(page, () => position.selectOption({ index: 1 }));
    const north = Number(await page.locator(`${field('/sun/position')} input[type="number"]`).nth(1).inputValue());
    assert.ok(Math.abs(north + Math.cos((35 * Math.PI) / 180)) < 1e-5, 'the sun stays in the south');
  }));

test('what the server refuses is said at the field, and the picture stays', () =>
  open(async (page) => {
    const before = await colours(page);
    await unfold(page, '/planet');
    const row = page.locator(`.field${field('/planet/radius_m')}`);
    await row.locator('input[type="number"]').fill('5');
    await row.locator('.error').waitFor({ state: 'visible' });
    assert.match((await row.locator('.error').textContent()) ?? '', /radius_m must be .*100 ?000/);
    assert.equal(await row.locator('input[type="number"]').getAttribute('aria-invalid'), 'true');
    await settled(page);
    assert.ok(difference(before, await colours(page)) < SEEN);
    await changing(page, () => page.keyboard.press('Escape').then(() => page.locator('#sky').focus()).then(() => page.keyboard.press('ArrowLeft')));
    assert.ok(await row.locator('.error').isVisible(), 'it stays until the field is mended');
    await changing(page, () => row.locator('input[type="number"]').fill('6400000'));
    assert.ok(await row.locator('.error').isHidden());
    await row.locator('input[type="number"]').fill('');
    assert.match((await row.locator('.error').textContent()) ?? '', /number is needed/);
  }));

test('what no field shows is said over the picture', () =>
  open(
    async (page) => {
      assert.match((await page.locator('.toast.bad').textContent()) ?? '', /rainbow/);
      assert.deepEqual(await sunAngles(page), { azimuth: 180, elevation: 35 });
    },
    { hash: '#rainbow.order=2&sun.position.azimuth_deg=20&sun.position.elevation_deg=5', viewport: STRIP },
  ));

test('the address holds the scene: reload, back and forward', () =>
  open(async (page) => {
    await changing(page, () => page.keyboard.press('ArrowRight'));
    await page.waitForURL('**#clouds=null&sun.position.azimuth_deg=181&sun.position.elevation_deg=35');
    await changing(page, () => page.locator('[data-preset="twilight"]').click());
    await page.waitForURL(/elevation_deg=-/);
    const twilight = await sunAngles(page);
    await page.reload();
    await settled(page);
    assert.deepEqual(await sunAngles(page), twilight);
    await changing(page, () => page.goBack());
    assert.deepEqual(await sunAngles(page), { azimuth: 181, elevation: 35 });
    await changing(page, () => page.goForward());
    assert.deepEqual(await sunAngles(page), twilight);
  }));

test('a broken address is said, and the default scene shown', () =>
  open(
    async (page) => {
      assert.match((await page.locator('.toast.bad').textContent()) ?? '', /address holds no scene/);
      assert.deepEqual(await sunAngles(page), { azimuth: 180, elevation: 35 });
    },
    { hash: '#sun.position=[1,2', viewport: STRIP },
  ));

test('time and place set the sun, and a drag takes it back', () =>
  open(async (page) => {
    await changing(page, () => page.locator('#time-place .switch').click());
    await changing(page, () => page.locator('#time-place select').selectOption({ label: 'Quito' }));
    await changing(page, () => page.locator('#time-place input[type="date"]').fill('2026-03-20'));
    const shown = async () => (await page.locator('#sun-text').textContent())?.split('·').map(parseFloat) ?? [];
    // At an equinox the noon sun of the equator stands in the zenith; the equation of time is two degrees then.
    assert.ok((await shown())[1] > 86, `${await shown()}`);
    assert.match((await page.locator('#time-place .clock').textContent()) ?? '', /12:00 solar.*17:1\d UTC/);
    await changing(page, () => page.locator('#day').fill(String(9 * 60)));
    const [azimuth, elevation] = await shown();
    assert.ok(Math.abs(elevation - 43) < 3 && azimuth > 80 && azimuth < 100, 'in the morning it stands half way up the east');
    await page.locator('#sky').focus();
    await changing(page, () => page.keyboard.press('ArrowUp'));
    assert.equal(await page.locator('#time-place .switch').isChecked(), false);
    const kept = await sunAngles(page);
    assert.ok(Math.abs(kept.elevation - elevation - 1) < 0.1 && Math.abs(kept.azimuth - azimuth) < 0.1);
  }));

test('on a phone nothing overflows, and the panel is a sheet at the bottom', () =>
  open(
    async (page) => {
      const overflow = () => page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
      assert.equal(await overflow(), 0);
      assert.ok(await page.locator('#panel').isHidden());
      await page.locator('#toggle-panel').click();
      assert.equal(await overflow(), 0);
      const box = await page.locator('#panel').boundingBox();
      assert.ok(box && box.width === PHONE.width && Math.abs(box.y + box.height - PHONE.height) < 1 && box.height < PHONE.height / 2);
      const wide = await page.evaluate(() => [...document.querySelectorAll('#interface *')].filter((e) => e.closest('#presets') === null && e.getBoundingClientRect().right > window.innerWidth + 0.5).map((e) => e.outerHTML.slice(0, 80)));
      assert.deepEqual(wide, []);
    },
    { viewport: PHONE },
  ));

test('help, panel and everything else are shown and hidden by keys', () =>
  open(async (page) => {
    await page.keyboard.press('?');
    await page.locator('#help').waitFor({ state: 'visible' });
    assert.match((await page.locator('#help .keys').textContent()) ?? '', /Move the sun/);
    await page.keyboard.press('Escape');
    await page.locator('#help').waitFor({ state: 'hidden' });
    await page.keyboard.press('i');
    await page.locator('#panel').waitFor({ state: 'hidden' });
    await page.keyboard.press('v');
    await page.locator('#hud[open]').waitFor();
    await page.keyboard.press('b');
    await page.locator('#hud').waitFor({ state: 'hidden' });
    await page.keyboard.press('b');
    await page.locator('#hud').waitFor({ state: 'visible' });
  }));
