/** The map without a page: brush, undo, where the observer stands, what of it the scene gets, and when it is sent. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { pressureOf, scaleBar } from '../../web/src/paint/board.js';
import { assetName } from '../../web/src/assets.js';
import { extentOf, observerOn, shownBy, shownName, viewCone } from '../../web/src/paint/place.js';
import { createPublisher } from '../../web/src/paint/publisher.js';
import { createRaster, createStroke, SIDE, tint } from '../../web/src/paint/raster.js';

const at = (/** @type {Float32Array} */ plane, /** @type {number} */ x, /** @type {number} */ y) => plane[y * SIDE + x];
/** A float of 24 bits. */
const EXACT = 1e-6;

test('a dab is strongest in its middle, ends at its rim, and leaves the other channels', () => {
  const { planes, dab } = createRaster();
  dab('coverage', { x: 100.5, y: 50.5 }, 10, 1, 0.5);
  assert.ok(Math.abs(at(planes.coverage, 100, 50) - 0.5) < EXACT);
  // (1 - 0.5²)² of it half-way to the rim.
  assert.ok(Math.abs(at(planes.coverage, 105, 50) - 0.5 * 0.5625) < EXACT);
  assert.equal(at(planes.coverage, 110, 50), 0);
  assert.ok(planes.type.every((v) => v === 0.5) && planes.rain.every((v) => v === 0));
  dab('coverage', { x: 100.5, y: 50.5 }, 10, 0, 1);
  assert.ok(at(planes.coverage, 100, 50) < EXACT, 'erased');
});

test('the map has no edge for the brush', () => {
  const { planes, dab } = createRaster();
  dab('rain', { x: 0.5, y: 511.5 }, 6, 1, 1);
  const [here, west, north] = [at(planes.rain, 3, 511), at(planes.rain, 509, 511), at(planes.rain, 0, 2)];
  assert.ok(here > 0.1 && Math.abs(here - west) < EXACT && Math.abs(here - north) < EXACT, `${here} ${west} ${north}`);
});

test('strokes, fills and clearing are undone one by one', () => {
  const raster = createRaster();
  const sum = () => raster.planes.coverage.reduce((s, v) => s + v, 0);
  raster.fill('coverage', 0.25);
  raster.begin('coverage');
  raster.dab('coverage', { x: 9, y: 9 }, 5, 1, 1);
  raster.clear();
  assert.equal(sum(), 0);
  assert.ok(raster.undo() && sum() > 0.25 * SIDE * SIDE);
  assert.ok(raster.undo() && raster.planes.coverage.every((v) => v === 0.25));
  assert.ok(raster.undo() && sum() === 0);
  assert.equal(raster.undo(), false);
});

test('a stroke is as dense however fast the hand is', () => {
  const dabs = (/** @type {number[]} */ stops) => {
    /** @type {number[]} */
    const found = [];
    const stroke = createStroke(({ x }) => found.push(x), 8);
    for (const x of stops) stroke.to({ x, y: 3 }, 1);
    return found;
  };
  assert.deepEqual(dabs([0, 20]), [0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20]);
  assert.deepEqual(dabs([0, 3, 7, 7.5, 20]), [0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20]);
});

test('what is sent is what was painted, to a step of 8 bits', () => {
  const raster = createRaster();
  raster.fill('coverage', 1);
  raster.fill('type', 0.2);
  const rgba = raster.rgba();
  assert.deepEqual([...rgba.slice(0, 4)], [255, 51, 0, 255]);
  const other = createRaster();
  other.read(rgba);
  assert.deepEqual(other.rgba(), rgba);
  assert.equal(other.canUndo(), false, 'nothing of it was painted here');
});

test('the channel that is painted stands out', () => {
  const raster = createRaster();
  const rgba = new Uint8ClampedArray(4 * SIDE * SIDE);
  const colour = (/** @type {'coverage' | 'type' | 'rain'} */ channel) => {
    tint(raster, channel, rgba);
    return [...rgba.slice(0, 3)];
  };
  const land = colour('coverage');
  raster.fill('coverage', 1);
  assert.ok(colour('coverage')[0] > land[0] + 150);
  const [stratus, cumulus] = [0, 1].map((type) => {
    raster.fill('type', type);
    return colour('type');
  });
  assert.ok(stratus[2] > stratus[0] + 50 && cumulus[0] > cumulus[2] + 50, 'blue to amber');
  raster.fill('rain', 1);
  assert.ok(colour('rain')[2] > colour('rain')[0] + 150);
});

const SCENE = {
  time_s: 0,
  camera: { position_m: [0, 0, 2], direction: { azimuth_deg: 90, elevation_deg: 10 }, projection: { kind: 'perspective', vertical_fov_deg: 60 } },
  clouds: {
    precipitation: 0, wind: { speed_m_s: 10, azimuth_deg: 270, drift_m: [0, 0, 0] }, weather_map: { kind: 'procedural', extent_m: 40_000, seed: null },
    layers: [{ kind: 'volume', type: 0.8 }, { kind: 'sheet', genus: 'cirrus' }],
  },
};
const moved = (/** @type {any} */ change) => ({ ...SCENE, ...change });

test('the observer stands where the map has come from', () => {
  assert.deepEqual(observerOn(SCENE), { x: 0.5, y: 0.5 });
  const east = moved({ camera: { ...SCENE.camera, position_m: [10_000, 0, 2] } });
  assert.deepEqual(observerOn(east), { x: 0.75, y: 0.5 });
  const north = moved({ camera: { ...SCENE.camera, position_m: [0, 30_000, 2] } });
  assert.ok(Math.abs(observerOn(north).y - 0.75) < EXACT, 'once round');
  // A west wind carries the weather east, so that the observer moves west on it: 10 km in 1000 s.
  assert.ok(Math.abs(observerOn(moved({ time_s: 1000 })).x - 0.25) < EXACT);
  const drifted = moved({ clouds: { ...SCENE.clouds, wind: { ...SCENE.clouds.wind, drift_m: [0, 10_000, 0] } } });
  assert.ok(Math.abs(observerOn(drifted).y - 0.75) < EXACT, 'south on a map that went north');
  assert.equal(extentOf({ clouds: null }), 60_000);
});

test('the wedge is as wide as what the camera sees', () => {
  const cone = (/** @type {any} */ projection, elevation_deg = 10) => viewCone({ direction: { azimuth_deg: 90, elevation_deg }, projection }, 2);
  const { from, to } = cone({ kind: 'perspective', vertical_fov_deg: 60 });
  // 2 atan(2 tan 30°) = 98.2°.
  assert.ok(Math.abs(from - 40.9) < 0.05 && Math.abs(to - 139.1) < 0.05, `${from} ${to}`);
  assert.deepEqual(cone({ kind: 'fisheye', fov_deg: 80 }), { from: 50, to: 130 });
  for (const all of [cone({ kind: 'equirectangular' }), cone({ kind: 'fisheye', fov_deg: 180 }), cone({ kind: 'perspective', vertical_fov_deg: 60 }, 80)]) {
    assert.deepEqual(all, { from: 0, to: 360 });
  }
});

test('what is painted acts: the map is the scene’s, and what would hide it gives way', () => {
  const map = { name: 'painted-1', extent_m: 40_000 };
  const shown = shownBy(SCENE, null, map, ['coverage']);
  assert.deepEqual(shown.clouds.weather_map, { kind: 'asset', convention: 'coverage-type-rain', ...map });
  assert.equal(shownName(shown), 'painted-1');
  assert.equal(shownName(SCENE), null);
  assert.deepEqual([shown.clouds.layers, shown.clouds.precipitation], [SCENE.clouds.layers, 0]);
  const all = shownBy(SCENE, null, map, ['type', 'rain']);
  assert.deepEqual(all.clouds.layers, [{ kind: 'volume', type: null }, { kind: 'sheet', genus: 'cirrus' }]);
  assert.equal(all.clouds.precipitation, 1);
  assert.equal(shownBy({ ...SCENE, clouds: null }, SCENE.clouds, map, []).clouds.weather_map.name, 'painted-1');
});

test('files get names that the server takes', () => {
  assert.deepEqual(['Front No. 3.PNG', 'ü.png', '__x-y.png', `${'a'.repeat(99)}.png`].map((name) => assetName(name, 'map')), ['front-no-3', 'map', 'x-y', 'a'.repeat(60)]);
});

test('a pen presses, a mouse does not', () => {
  const press = (/** @type {string} */ pointerType, /** @type {number} */ pressure) => pressureOf(/** @type {any} */ ({ pointerType, pressure }));
  assert.deepEqual([press('pen', 0.2), press('mouse', 0.5), press('touch', 0.3), press('touch', 1), press('touch', 0)], [0.2, 1, 0.3, 1, 1]);
});

test('the scale bar is a round length', () => {
  assert.deepEqual([60_000, 4_000, 1e7].map((m) => scaleBar(m).km), [10, 1, 2000]);
  assert.equal(scaleBar(60_000).share, 1 / 6);
});

test('of a map that changes quickly the latest is sent, one at a time', async () => {
  const events = /** @type {string[]} */ ([]);
  let state = 0;
  const publisher = createPublisher(
    async () => {
      const sent = state;
      events.push(`begin ${sent}`);
      await new Promise((resolve) => setTimeout(resolve, 5));
      if (sent === 3) throw new Error('full');
      events.push(`end ${sent}`);
    },
    (error) => events.push(error.message),
    0,
  );
  const change = () => {
    state += 1;
    return publisher.changed();
  };
  change();
  const done = change();
  change();
  await done;
  assert.deepEqual(events, ['begin 1', 'end 1', 'begin 3', 'full']);
  await change();
  assert.deepEqual(events.slice(4), ['begin 4', 'end 4'], 'after a failure it goes on with the next change');
});
