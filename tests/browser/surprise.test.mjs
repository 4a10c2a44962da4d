/** Skies by chance: each is a scene that the server takes, and a plausible one. */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { dayHour, surprising } from '../../web/src/surprise.js';
import { createRandom } from './random.mjs';
import { startServer } from './server.mjs';

/** @type {Awaited<ReturnType<typeof startServer>>} */
let server;
before(async () => {
  server = await startServer();
});
after(() => server?.end());

test('a hundred surprises are all taken, lit by day, and unlike each other', async () => {
  const presets = await (await fetch(`${server.url}v1/presets`)).json();
  const [{ scene }, fair] = [presets[0], presets.find((/** @type {any} */ p) => p.name === 'fair-weather').scene.clouds];
  const random = createRandom(9);
  const seeds = new Set();
  for (let i = 0; i < 100; i++) {
    const { scene: next } = surprising(scene, fair, random.unit);
    const { clouds, sun } = next;
    assert.ok(sun.position.elevation_deg >= 4 && sun.position.elevation_deg <= 55);
    assert.ok(clouds.layers.every((/** @type {any} */ layer) => layer.kind === 'sheet' || layer.top_m > layer.base_m + 400));
    assert.deepEqual(next.camera, scene.camera, 'the view stays');
    seeds.add(clouds.seed);
    const answer = await fetch(`${server.url}v1/probe`, {
      method: 'POST', headers: { 'content-type': 'application/json' },
      body: JSON.stringify({ scene: { ...next, clouds: { ...clouds, coverage: 2 } }, directions: [] }),
    });
    // The one wrong member that was put in is all that is found.
    const problem = await answer.json();
    assert.deepEqual([answer.status, problem.errors?.map((/** @type {any} */ e) => e.pointer)], [422, ['/scene/clouds/coverage']], JSON.stringify(problem));
  }
  assert.ok(seeds.size === 100);
});

test('the hour is one of daylight, where there is any', () => {
  const random = createRandom(2);
  const hours = (/** @type {string} */ date, /** @type {number} */ latitude) => Array.from({ length: 200 }, () => dayHour(date, latitude, random.unit));
  // At an equinox the sun is 4° up some quarter of an hour after six.
  for (const hour of hours('2026-03-21', 0)) assert.ok(hour && hour > 6.2 && hour < 17.8);
  for (const hour of hours('2026-12-21', 60)) assert.ok(hour && hour > 9.5 && hour < 14.5);
  assert.ok(hours('2026-12-21', 75).every((hour) => hour === null), 'polar night');
  const summer = hours('2026-06-21', 80).map(Number);
  assert.ok(Math.min(...summer) < 1 && Math.max(...summer) > 23, 'midnight sun');
});

test('a sun by time and place stays one', () => {
  const random = createRandom(3);
  const position = { time: '2026-06-21T23:00:00Z', latitude_deg: 40, longitude_deg: -3.7, refraction: true };
  const scene = { sun: { position }, camera: { direction: { azimuth_deg: 180, elevation_deg: 5 } } };
  const fair = { layers: [{ kind: 'volume' }], wind: {} };
  const { scene: next } = surprising(scene, fair, random.unit);
  assert.equal(next.sun.position.latitude_deg, 40);
  const hour = Number(next.sun.position.time.slice(11, 13));
  assert.ok(hour >= 4 && hour <= 20, next.sun.position.time);
});
