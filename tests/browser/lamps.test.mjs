/** Lamps put on the ground by hand or from files, and the plates of ice over them. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { lightFile } from '../../web/src/assets.js';
import { placeAt, radiantIntensity, tilted, toSphere, upTo, withLayers } from '../../web/src/lamps/document.js';
import { altitudeAt } from '../../web/src/fly/pose.js';
import { fromAngles } from '../../web/src/vector.js';
import { changing, colours, difference, sentScene, settled, telling, useBrowser } from './page.mjs';

const open = useBrowser();
const SMALL = { viewport: { width: 900, height: 420 } };
const RADIUS = 6_360_000;
const NIGHT = '#sun.position.azimuth_deg=0&sun.position.elevation_deg=-30&moon=null&stars=null&camera.direction.elevation_deg=4&camera.position_m=[0,0,12]&display.exposure.kind=ev&display.exposure.ev=-3';

test('a click below the horizon is a place on the sphere', () => {
  for (const [height, elevation_deg, about] of [[10, -1, 573], [10, -10, 56.7], [2000, -30, 3464], [2, -0.1, 1300]]) {
    const direction = fromAngles({ azimuth_deg: 90, elevation_deg });
    const away = toSphere([0, 0, height], direction, RADIUS);
    assert.ok(away !== null);
    const [east, north] = placeAt([0, 0, height], direction, away);
    // Flat ground is that near; the sphere bends by some metres in the last of them.
    assert.ok(Math.abs(east / about - 1) < 0.15 && Math.abs(north) < 1e-6, `${east} for ${about}`);
    const there = altitudeAt([east, north, height + away * direction[2]], RADIUS);
    assert.ok(Math.abs(there) < 1e-3, `${there} m over the sphere`);
  }
  assert.equal(toSphere([0, 0, 10], [1, 0, 0], RADIUS), null);
  assert.equal(toSphere([0, 0, 10], [0, 0, 1], RADIUS), null);
});

test('a colour of its own is as bright as it is said', () => {
  for (const colour of ['#ffffff', '#3b7bff', '#ff2000']) {
    const radiant = radiantIntensity(colour, 1000);
    const candela = radiant.reduce((sum, v, i) => sum + [0.2126 * 90_231, 0.7152 * 71_876, 0.0722 * 69_561][i] * v, 0);
    // Four digits of each.
    assert.ok(Math.abs(candela - 1000) < 1, `${candela} cd`);
  }
  assert.deepEqual(radiantIntensity('#000000', 1000), [0, 0, 0]);
});

test('sliders change every layer, whatever its law', () => {
  const layer = { base_m: 100, top_m: 400, tilt: { kind: 'gaussian', sigma_deg: 1, max_deg: 6 } };
  assert.deepEqual(withLayers([layer, layer], (l) => tilted(l, 2)).map((/** @type {any} */ l) => l.tilt), [{ kind: 'gaussian', sigma_deg: 2, max_deg: 8 }, { kind: 'gaussian', sigma_deg: 2, max_deg: 8 }]);
  assert.deepEqual(tilted({ ...layer, tilt: { kind: 'uniform', max_deg: 3 } }, 2).tilt, { kind: 'uniform', max_deg: 2 });
  assert.equal(upTo(layer, 20).top_m, 110);
  assert.deepEqual(['a.csv', 'b.GeoJSON', 'c.json', 'd.png'].map(lightFile), [true, true, true, false]);
});

test('clicks put lamps on the ground, and a pillar stands over each', () =>
  open(
    async (page) => {
      await page.getByRole('button', { name: 'Lamps and pillars' }).click();
      await page.getByRole('button', { name: 'Scene', exact: true }).click();
      const sky = page.locator('#sky');
      const { height } = /** @type {{width: number, height: number}} */ (await sky.boundingBox());
      const at = { x: 700, y: Math.round(height * 0.64) };
      const dark = await colours(page);
      await page.locator('#lamp-form select[name="kind"]').selectOption('white-led');
      await changing(page, () => sky.click({ position: at }));
      const [lamp, ...others] = sentScene(page).lights;
      assert.equal(others.length, 0);
      assert.equal(lamp.lamp, 'white-led');
      assert.ok(lamp.position_m[1] > 20 && lamp.position_m[1] < 3000, JSON.stringify(lamp.position_m));
      assert.ok(sentScene(page).ice_crystals, 'with the first lamp comes ice');
      assert.ok(difference(dark, await colours(page)) > 1, 'the pillar is seen');
      await telling(page, () => page.locator('#lamp-form select[name="kind"]').selectOption('own').then(() => sky.click({ position: { x: at.x + 60, y: at.y + 30 } })));
      assert.equal(sentScene(page).lights.length, 2);
      assert.ok(sentScene(page).lights[1].radiant_intensity_w_sr[2] > sentScene(page).lights[1].radiant_intensity_w_sr[0], 'bluer than red');
      assert.match((await page.locator('#lamp-status').textContent()) ?? '', /2 lamps stand/);
      // A drag looks about and puts nothing; a click into the sky says why.
      await page.mouse.move(at.x, at.y);
      await page.mouse.down();
      await page.mouse.move(at.x + 40, at.y, { steps: 4 });
      await telling(page, () => page.mouse.up().then(() => page.mouse.wheel(0, 1)));
      assert.equal(sentScene(page).lights.length, 2);
      await sky.click({ position: { x: at.x, y: 100 } });
      assert.match((await page.locator('#lamp-error').textContent()) ?? '', /no ground/);
      const plates = page.locator('#lamp-form input[name="plates"]');
      await telling(page, () => plates.fill('5'));
      assert.equal(sentScene(page).ice_crystals.number_density_per_m3, 1e5);
      await telling(page, () => page.locator('#lamp-form input[name="tilt"]').fill('3'));
      assert.deepEqual([sentScene(page).ice_crystals.tilt.sigma_deg, sentScene(page).ice_crystals.tilt.max_deg], [3, 12]);
      await telling(page, () => page.locator('#lamp-form input[name="top"]').fill('900'));
      await telling(page, () => page.locator('#lamp-form input[name="extinction"]').fill('1'));
      assert.deepEqual([sentScene(page).ice_crystals.top_m, sentScene(page).ice_crystals.extinction_per_m], [900, 1e-3]);
      await telling(page, () => page.getByRole('button', { name: 'Undo', exact: true }).first().click());
      assert.equal(sentScene(page).lights.length, 1);
      await telling(page, () => page.getByLabel('Plates of ice in the air').uncheck());
      assert.equal(sentScene(page).ice_crystals ?? null, null);
      assert.ok(await plates.isDisabled());
      await telling(page, () => page.getByRole('button', { name: 'Remove all' }).click());
      assert.deepEqual(sentScene(page).lights ?? [], []);
    },
    { ...SMALL, hash: NIGHT },
  ));

test('a click on a mountain puts the lamp there', () =>
  open(
    async (page) => {
      await page.getByRole('button', { name: 'Lamps and pillars' }).click();
      await page.getByRole('button', { name: 'Scene', exact: true }).click();
      const sky = page.locator('#sky');
      const { height } = /** @type {{width: number, height: number}} */ (await sky.boundingBox());
      await telling(page, () => sky.click({ position: { x: 700, y: Math.round(height * 0.8) } }));
      const [{ position_m, above }] = sentScene(page).lights;
      assert.equal(above, 'ground');
      assert.ok(Math.hypot(position_m[0], position_m[1]) < 40_000, JSON.stringify(position_m));
    },
    { ...SMALL, hash: '#terrain.kind=heightfield&camera.position_m=[0,0,1500]&camera.direction.elevation_deg=-8' },
  ));

test('a town of a file is sent, chosen, refused, and made by chance', () =>
  open(
    async (page, server) => {
      await page.getByRole('button', { name: 'Lamps and pillars' }).click();
      const [file, town, error] = [page.locator('#lamp-form input[type="file"]'), page.locator('#lamp-form select[name="town"]'), page.locator('#lamp-error')];
      await telling(page, () => file.setInputFiles({ name: 'Main street.csv', mimeType: 'text/csv', buffer: Buffer.from('east_m,north_m,height_m,lamp\n-40,-600,8,white-led\n40,-600,8,mercury\n') }));
      assert.deepEqual([sentScene(page).town.kind, sentScene(page).town.name], ['asset', 'main-street']);
      await settled(page);
      const point = (/** @type {number} */ longitude) => ({ type: 'Feature', geometry: { type: 'Point', coordinates: [longitude, 78.2] }, properties: { lamp: 'mercury', height_m: 6 } });
      const geojson = JSON.stringify({ type: 'FeatureCollection', features: [point(15.6), point(15.61)] });
      await telling(page, () => file.setInputFiles({ name: 'hull.geojson', mimeType: 'application/geo+json', buffer: Buffer.from(geojson) }));
      assert.equal(sentScene(page).town.name, 'hull');
      await settled(page);
      const kept = (await (await fetch(`${server.url}v1/assets/lights`)).json()).assets.map((/** @type {any} */ a) => a.name);
      assert.deepEqual(kept, ['hull', 'main-street']);
      await telling(page, () => town.selectOption('lights/main-street'));
      assert.equal(sentScene(page).town.name, 'main-street');
      await file.setInputFiles({ name: 'bad.csv', mimeType: 'text/csv', buffer: Buffer.from('east_m,width\n1,2\n') });
      await error.waitFor({ state: 'visible' });
      assert.match((await error.textContent()) ?? '', /width/);
      assert.equal(sentScene(page).town.name, 'main-street');
      await telling(page, () => town.selectOption('procedural'));
      assert.deepEqual([sentScene(page).town.kind, sentScene(page).town.count], ['procedural', 300]);
      // Of the panel below, too.
      await page.locator('section[data-pointer="/town"] .fold').first().click();
      await telling(page, () => page.locator('.field[data-pointer="/town"] select').selectOption({ label: 'Asset' }));
      assert.deepEqual([sentScene(page).town.kind, kept.includes(sentScene(page).town.name)], ['asset', true]);
      await telling(page, () => town.selectOption(''));
      assert.equal(sentScene(page).town ?? null, null);
      await telling(page, () => page.getByRole('button', { name: 'Night', exact: true }).click());
      assert.equal(sentScene(page).sun.position.elevation_deg, -25);
      await settled(page);
    },
    // What the server refuses, Chromium logs.
    { ...SMALL, logs: /status of 4\d\d/ },
  ));
