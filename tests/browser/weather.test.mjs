/** Haze, bands, steps and weather reports: parts that may be off, and numbers that may be three. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { changing, colours, difference, numberAt, PHONE, useBrowser } from './page.mjs';

const open = useBrowser();
/** A part of the picture's change that JPEG and dither do not make, of 255. */
const SEEN = 2;
/** @param {string} pointer */
const field = (pointer) => `[data-pointer="${pointer}"]`;
/** @param {string} pointer */
const optional = (pointer) => `[data-optional="${pointer}"]`;
/** @param {import('./page.mjs').Page} page @param {string} pointer */
const unfold = (page, pointer) => page.locator(`${field(pointer)} > .group-head .fold`).click();
const GOOD = 'METAR EGUW 031250Z 05003KT 0600 FG FEW060 12/12 Q1021 RED';
const BAD = 'METAR EGUW 030650Z 05003KT 0600 FGX 12/12 Q1021';

test('haze is switched on, thickened on a logarithm, and told by extinction instead', () =>
  open(async (page) => {
    const before = await colours(page);
    await changing(page, () => page.locator(`${field('/haze')} > .group-head .switch`).click());
    assert.equal(await numberAt(page, '/haze/visibility_m'), 20_000);
    await changing(page, () => page.locator(`${field('/haze/visibility_m')} input[type="range"]`).fill('300'));
    const visibility = await numberAt(page, '/haze/visibility_m');
    // 50 m to 1000 km on a logarithm: 0.3 of the way is 50 · 20000^0.3.
    assert.equal(visibility, 976);
    assert.ok(difference(before, await colours(page)) > 10, 'fog hides the blue');
    await changing(page, () => page.locator(`${optional('/haze/extinction_per_m')} .switch`).click());
    assert.equal(await numberAt(page, '/haze/extinction_per_m'), 0.00401);
    assert.equal(await page.locator(`${optional('/haze/visibility_m')} .switch`).isChecked(), false, 'one of the two says it');
    await page.waitForURL('**#clouds=null&haze.extinction_per_m=0.00401');
    await changing(page, () => page.locator(`${field('/haze')} > .group-head .switch`).click());
    assert.ok(difference(before, await colours(page)) < SEEN);
    assert.equal(await page.locator('.toast.bad').count(), 0);
  }));

test('one number becomes three and one again', () =>
  open(async (page) => {
    await unfold(page, '/atmosphere');
    await unfold(page, '/atmosphere/mie');
    const scattering = page.locator(field('/atmosphere/mie/scattering_per_m'));
    const before = await colours(page);
    const toggle = scattering.getByRole('button', { name: 'R, G and B' });
    await changing(page, () => toggle.click());
    assert.equal(await toggle.getAttribute('aria-pressed'), 'true');
    const red = scattering.getByLabel('Scattering, R', { exact: true });
    assert.equal(await red.inputValue(), '3.996e-6');
    await changing(page, () => red.fill('2e-4'));
    assert.ok(difference(before, await colours(page)) > SEEN, 'the haze is red');
    await page.waitForURL('**#clouds=null&atmosphere.mie.scattering_per_m=[0.0002,0.000003996,0.000003996]');
    await changing(page, () => toggle.click());
    // The mean of the three, four digits.
    assert.equal(await numberAt(page, '/atmosphere/mie/scattering_per_m'), 6.933e-5);
  }));

test('steps are left to the program until they are given', () =>
  open(async (page) => {
    await unfold(page, '/atmosphere');
    await changing(page, () => page.locator(`${optional('/atmosphere/view_steps')} .switch`).click());
    assert.equal(await numberAt(page, '/atmosphere/view_steps'), 32);
    await changing(page, () => page.locator(`${field('/atmosphere/view_steps')} input[type="range"]`).fill('700'));
    assert.equal(await numberAt(page, '/atmosphere/view_steps'), 74, '4 · 64^0.7, whole');
    await changing(page, () => page.locator(`${field('/atmosphere/method')} select`).selectOption('table'));
    assert.match((await page.locator(`${field('/atmosphere/method')} select`).getAttribute('title')) ?? '', /O'Neil/);
    await changing(page, () => page.locator(`${optional('/atmosphere/view_steps')} .switch`).click());
    assert.equal(await page.locator(field('/atmosphere/view_steps')).count(), 0);
    assert.equal(await page.locator('.toast.bad').count(), 0);
  }));

test('a weather report becomes the scene; the camera stays', () =>
  open(
    async (page) => {
      const before = await colours(page);
      await page.locator('#weather-report .fold').focus();
      await page.keyboard.press('Enter');
      await page.keyboard.type(GOOD);
      await changing(page, () => page.keyboard.press('Enter'));
      const told = (await page.locator('#weather-report .told').textContent()) ?? '';
      assert.match(told, /EGUW \d{4}-\d\d-03 12:50 UTC/);
      assert.match(told, /not shown: RED/);
      assert.ok((await numberAt(page, '/haze/extinction_per_m')) > 0.004, 'fog');
      assert.ok(await page.locator('#time-place .switch').isChecked());
      assert.equal(await numberAt(page, '/camera/direction/azimuth_deg'), 200);
      assert.ok(difference(before, await colours(page)) > 10);
      await page.reload();
      await page.waitForSelector('body[data-state="final"]');
      assert.ok((await numberAt(page, '/haze/extinction_per_m')) > 0.004, 'the address holds it');
    },
    { hash: '#camera.direction.azimuth_deg=200&camera.direction.elevation_deg=10' },
  ));

test('in a bad report the wrong group is marked, on a phone too', () =>
  open(
    async (page) => {
      await page.locator('#toggle-panel').click();
      await page.locator('#weather-report .fold').click();
      const text = page.locator('#weather-report textarea');
      await text.fill(BAD);
      await page.locator('#weather-report button.primary').click();
      assert.equal(await page.locator('#weather-report mark').textContent(), 'FGX');
      assert.equal(await page.locator('#weather-report .echo').textContent(), BAD);
      assert.match((await page.locator('#weather-report .error').textContent()) ?? '', /FGX/);
      assert.equal(await text.getAttribute('aria-invalid'), 'true');
      const chosen = await text.evaluate((t) => /** @type {HTMLTextAreaElement} */ (t).value.slice(/** @type {HTMLTextAreaElement} */ (t).selectionStart, /** @type {HTMLTextAreaElement} */ (t).selectionEnd));
      assert.equal(chosen, 'FGX', 'typing replaces it');
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth), 0);
      const wide = await page.locator('#weather-report *').evaluateAll((all) => all.filter((e) => e.getBoundingClientRect().right > window.innerWidth).length);
      assert.equal(wide, 0);
      await page.keyboard.type('FG');
      assert.ok(await page.locator('#weather-report .error').isHidden());
      await changing(page, () => page.keyboard.press('Enter'));
      assert.match((await page.locator('#weather-report .told').textContent()) ?? '', /EGUW/);
    },
    // Chromium logs the refusal.
    { viewport: PHONE, logs: /422/ },
  ));
