/** The way into the night, and the moon. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { changing, colours, difference, numberAt, sunAngles, useBrowser } from './page.mjs';

const open = useBrowser();
const MOON = '#sun.position.azimuth_deg=300&sun.position.elevation_deg=-18&moon.position.azimuth_deg=180&moon.position.elevation_deg=20';
/** @param {import('./page.mjs').Page} page */
const moonAngles = async (page) => ({
  azimuth: await numberAt(page, '/moon/position/azimuth_deg'),
  elevation: await numberAt(page, '/moon/position/elevation_deg'),
});
/** @param {import('./page.mjs').Page} page */
const unfoldMoon = (page) => page.locator('[data-pointer="/moon"] > .group-head .fold').click();
/** The middle of the part of the dome that stands for the moon. @param {import('./page.mjs').Page} page */
async function onDome(page) {
  const box = await page.locator('#dome-moon circle').boundingBox();
  assert.ok(box);
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

test('a sun dragged under the horizon leads through twilight to the stars', () =>
  open(
    async (page) => {
      await page.mouse.move(300, 200);
      await page.mouse.down();
      /** @type {{elevation: number, grid: number[]}[]} */
      const way = [];
      for (let y = 220; way.length < 7; y += 30) {
        await changing(page, () => page.mouse.move(300, y, { steps: 2 }));
        way.push({ elevation: (await sunAngles(page)).elevation, grid: await colours(page) });
      }
      await page.mouse.up();
      assert.ok(way[0].elevation > 0 && way[6].elevation < -12, `from ${way[0].elevation} to ${way[6].elevation}`);
      for (const { elevation, grid } of way) assert.ok(Math.max(...grid) > 40, `black at ${elevation}`);
      // The meter keeps the picture readable: each of these steps of some 3 degrees may change it by a fifth of the range at most.
      way.slice(1).forEach(({ elevation, grid }, i) => assert.ok(difference(way[i].grid, grid) < 51, `a jump at ${elevation}`));
    },
    { hash: '#sun.position.azimuth_deg=180&sun.position.elevation_deg=5&camera.direction.azimuth_deg=180&camera.direction.elevation_deg=10' },
  ));

test('the dome shows the moon and its phase, and moves a moon whose position is given', () =>
  open(
    async (page) => {
      assert.match((await page.locator('#moon-text').textContent()) ?? '', /^Moon 20\.0° · \d+ %$/);
      assert.match((await page.locator('#sky').getAttribute('aria-label')) ?? '', /Moon \d+ % lit, 20 degrees above the horizon in the south/);
      const sun = await sunAngles(page);
      const from = await onDome(page);
      await page.mouse.move(from.x, from.y);
      await page.mouse.down();
      await changing(page, () => page.mouse.move(from.x + 30, from.y - 20, { steps: 4 }));
      await page.mouse.up();
      const to = await onDome(page);
      // Pointers move in whole pixels.
      assert.ok(Math.hypot(to.x - from.x - 30, to.y - from.y + 20) < 1.5, `${to.x}, ${to.y}`);
      assert.deepEqual(await sunAngles(page), sun);
      const { azimuth } = await moonAngles(page);
      assert.ok(azimuth > 90 && azimuth < 180, `towards the south-east: ${azimuth}`);
      await changing(page, () => page.locator('[data-pointer="/moon"] > .group-head .switch').click());
      assert.ok(await page.locator('#dome-moon').isHidden());
      assert.ok(await page.locator('#moon-text').isHidden());
    },
    { hash: MOON },
  ));

test('the moon is dragged on the picture, and lights it', () =>
  open(
    async (page) => {
      const sun = await sunAngles(page);
      // The camera looks 10 degrees up, the moon stands at 20: 560 pixels are 60 degrees high.
      const at = { x: 450, y: 280 - 280 * (Math.tan((10 * Math.PI) / 180) / Math.tan(Math.PI / 6)) };
      await page.mouse.move(at.x, at.y);
      await page.mouse.down();
      await changing(page, () => page.mouse.move(at.x - 100, at.y - 60, { steps: 3 }));
      await page.mouse.up();
      const moon = await moonAngles(page);
      assert.ok(moon.azimuth > 165 && moon.azimuth < 172 && moon.elevation > 24 && moon.elevation < 28, `${moon.azimuth}, ${moon.elevation}`);
      assert.deepEqual(await sunAngles(page), sun);
      await unfoldMoon(page);
      const withMoon = await colours(page);
      await changing(page, () => page.locator('[data-pointer="/moon/irradiance_scale"] input[type="number"]').fill('0'));
      assert.ok(difference(withMoon, await colours(page)) > 2, 'its light is gone');
    },
    { hash: MOON },
  ));

test('a moon by time and place is told by the server, and stays where it is', () =>
  open(
    async (page) => {
      // The moon was full on 2026-11-24, and at midnight it stood in Greenwich's south.
      const [, elevation, lit] = ((await page.locator('#moon-text').textContent()) ?? '').match(/^Moon ([-\d.]+)° · (\d+) %$/) ?? [];
      assert.ok(Number(elevation) > 40 && Number(lit) > 97, `${elevation}, ${lit}`);
      const from = await onDome(page);
      await changing(page, () => page.mouse.click(from.x, from.y));
      assert.ok((await sunAngles(page)).elevation > 30, 'the sun was moved there');
      assert.ok(await page.locator('#dome-moon').isHidden(), 'without a time there is no moon but a given one');
      await unfoldMoon(page);
      await changing(page, () => page.locator('[data-optional="/moon/position"] .switch').click());
      assert.ok(await page.locator('#dome-moon').isVisible());
    },
    { hash: '#sun.position.time=2026-11-24T00:00:00Z&sun.position.latitude_deg=51.5&sun.position.longitude_deg=0' },
  ));
