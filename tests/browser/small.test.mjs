/** Small modules without a page: slider scales, clock, dome, frame header, commands. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { carryOver } from '../../web/src/carry.js';
import { clockText, toSolar, toUtc } from '../../web/src/clock.js';
import { domeAngles, domePoint } from '../../web/src/dome.js';
import { backoffMs } from '../../web/src/live.js';
import { isFinal, parseFrame } from '../../web/src/protocol.js';
import { createScale } from '../../web/src/scale.js';
import { curlCommand } from '../../web/src/share.js';
import { frameSize, pictureBox } from '../../web/src/stage.js';
import { turned } from '../../web/src/sun.js';
import { litPath } from '../../web/src/moon.js';
import { turnedOn } from '../../web/src/starts.js';
import { numberText } from '../../web/src/text.js';
import { PLACES } from '../../web/src/places.js';
import { parts } from '../../web/src/weather-report.js';
import { root } from './fixture.mjs';
import { createRandom } from './random.mjs';

/** @param {any} node */
const scale = (node) => createScale({ type: 'number', title: '', unit: '', description: '', nullable: false, ...node });

test('a coefficient of 1e-6 in a range to 0.1 gets a logarithmic slider', () => {
  const s = scale({ minimum: 0, maximum: 0.1, initial: 3.996e-6, unit: '1/m' });
  assert.ok(s);
  assert.equal(s.value(0), 0);
  assert.equal(s.value(1), 0.1);
  const middle = s.position(3.996e-6);
  assert.ok(middle > 0.2 && middle < 0.8, `the default stands at ${middle}`);
  // Three significant digits are kept: half a step of the third.
  assert.ok(Math.abs(s.value(middle) / 3.996e-6 - 1) < 0.005);
});

test('angles are linear, and a range too wide round zero has no slider', () => {
  const s = scale({ minimum: 0.01, maximum: 170, initial: 60, unit: '°' });
  assert.ok(s && Math.abs(s.position(85) - 0.5) < 1e-3);
  assert.equal(scale({ minimum: -1e9, maximum: 1e9, initial: 0 }), null);
  assert.equal(scale({ minimum: 0, initial: 0 }), null);
});

test('a slider of powers of two stops at them', () => {
  const s = scale({ minimum: 512, maximum: 8192, initial: 2048, integer: true, description: 'Side of the picture, pixels: a power of two.' });
  assert.ok(s && s.step === 1);
  assert.deepEqual([0, 0.3, 0.5, 0.7, 1].map(s.value), [512, 1024, 2048, 4096, 8192]);
  assert.equal(s.position(4096), 0.75);
});

test('whole numbers stay whole on a logarithmic slider', () => {
  const s = scale({ minimum: 4, maximum: 256, integer: true });
  assert.ok(s && s.step === 1);
  for (let i = 0; i <= 100; i++) assert.ok(Number.isInteger(s.value(i / 100)));
  assert.deepEqual([s.value(0), s.value(0.5), s.value(1)], [4, 32, 256]);
});

test('slider positions and values agree both ways', () => {
  const random = createRandom(4);
  for (const node of [{ minimum: 0, maximum: 1, initial: 0.1 }, { minimum: 1e5, maximum: 1e8, initial: 6.36e6 }, { minimum: -90, maximum: 90, initial: 0, unit: '°' }]) {
    const s = scale(node);
    assert.ok(s);
    for (let i = 0; i < 200; i++) {
      const position = random.unit();
      // Values are rounded to about a thousandth of the range.
      assert.ok(Math.abs(s.position(s.value(position)) - position) < 0.003);
    }
  }
});

test('numbers are written short', () => {
  assert.deepEqual([5.802e-6, 0, 100000, 0.1 + 0.2, 1.91198, 33.1e-6, 1e-3].map(numberText), ['5.802e-6', '0', '100000', '0.3', '1.91198', '3.31e-5', '0.001']);
});

test('solar time: an hour for each 15 degrees', () => {
  assert.deepEqual(toSolar('2026-06-21T05:00:00Z', 30), { date: '2026-06-21', hours: 7 });
  assert.deepEqual(toSolar('2026-06-21T20:00:00Z', 90), { date: '2026-06-22', hours: 2 });
  assert.equal(toUtc({ date: '2026-06-22', hours: 2 }, 90), '2026-06-21T20:00:00Z');
  assert.equal(clockText(6.5), '06:30');
  assert.equal(clockText(23.999), '00:00');
  for (const [name, , longitude] of PLACES) {
    assert.equal(toUtc(toSolar('2026-03-01T01:02:03Z', longitude), longitude), '2026-03-01T01:02:03Z', name);
  }
});

test('the dome shows the sun where it stands, down to the end of twilight', () => {
  const random = createRandom(5);
  for (let i = 0; i < 300; i++) {
    const angles = { azimuth_deg: random.between(0, 360), elevation_deg: random.between(-18, 89) };
    const back = domeAngles(domePoint(angles));
    assert.ok(Math.abs(back.azimuth_deg - angles.azimuth_deg) < 1e-9 && Math.abs(back.elevation_deg - angles.elevation_deg) < 1e-9);
  }
  const east = domePoint({ azimuth_deg: 90, elevation_deg: 0 });
  assert.ok(east.x > 44 && Math.abs(east.y) < 1e-9, 'east is at the right');
  assert.equal(domeAngles({ x: 0, y: -100 }).elevation_deg, -18);
});

test('the lit part of the moon has the area that its fraction says', () => {
  for (const fraction of [0, 0.2, 0.5, 0.8, 1]) {
    const [, across, sweep] = litPath(10, fraction).match(/A([\d.]+) 10 0 0 ([01]) 0 -10Z$/) ?? [];
    // Half the disc, and half an ellipse taken away from it or put to it.
    const area = 0.5 + (sweep === '1' ? 0.5 : -0.5) * (Number(across) / 10);
    assert.ok(Math.abs(area - fraction) < 1e-12, `${fraction}: ${area}`);
  }
});

test('parts that are switched on begin with what makes sense', () => {
  const known = { sun: () => ({ azimuth_deg: 200, elevation_deg: -9 }), moon: () => null, heightfields: () => ['alps'] };
  const node = /** @type {any} */ (root.properties).find((/** @type {any} */ p) => p.key === 'steps').node;
  const haze = { visibility_m: 2000, extinction_per_m: null };
  const byExtinction = turnedOn({ haze }, '/haze/extinction_per_m', node, known).haze;
  // Koschmieder: 3.912 over the visibility.
  assert.deepEqual(byExtinction, { visibility_m: null, extinction_per_m: 0.00196 });
  assert.deepEqual(turnedOn({ haze: byExtinction }, '/haze/visibility_m', node, known).haze, { visibility_m: 2000, extinction_per_m: null });
  assert.deepEqual(turnedOn({ moon: {} }, '/moon/position', node, known).moon.position, { azimuth_deg: 20, elevation_deg: 30 });
  const told = { azimuth_deg: 120.00001, elevation_deg: 7, phase_angle_deg: 33.3, angular_diameter_deg: 0.51234 };
  const withMoon = { ...known, moon: () => told };
  assert.deepEqual(turnedOn({ moon: {} }, '/moon/position', node, withMoon).moon.position, { azimuth_deg: 120, elevation_deg: 7 });
  assert.equal(turnedOn({ moon: {} }, '/moon/phase_angle_deg', node, withMoon).moon.phase_angle_deg, 33);
  assert.deepEqual(turnedOn({ terrain: { name: null, mountains: { seed: 3 } } }, '/terrain/name', node, known).terrain, { name: 'alps', mountains: null }, 'heights are a file’s or made');
  assert.equal(turnedOn({ steps: null }, '/steps', node, known).steps, 4, 'the least, where nothing is known');
});

test('a group of a report is cut out by characters', () => {
  assert.deepEqual(parts('METAR \u{1F327} EGUW', { start: 8, end: 12 }), ['METAR \u{1F327} ', 'EGUW', '']);
  assert.deepEqual(parts('METAR', { start: 5, end: 5 }), ['METAR', '', '']);
});

test('a sun out of view turns the short way with the hand', () => {
  const sun = { azimuth_deg: 10, elevation_deg: 5 };
  assert.deepEqual(turned(sun, { azimuth_deg: 350, elevation_deg: 10 }, { azimuth_deg: 5, elevation_deg: 12 }), { azimuth_deg: 25, elevation_deg: 7 });
});

test('a frame header is read little-endian', () => {
  const bytes = new Uint8Array(20);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, 0x04030201, true);
  [1, 2, 640, 360].forEach((v, i) => view.setUint16(4 + 2 * i, v, true));
  bytes[12] = 1;
  bytes.set([9, 8, 7, 6], 16);
  const { body, ...head } = parseFrame(bytes.buffer);
  assert.deepEqual(head, { seq: 0x04030201, pass: 1, passes: 2, width: 640, height: 360, format: 1 });
  assert.deepEqual([...body], [9, 8, 7, 6]);
  assert.ok(isFinal({ ...head, body }) && !isFinal({ ...head, body, pass: 0 }));
  assert.throws(() => parseFrame(new ArrayBuffer(15)), /header/);
});

test('waits double, within bounds', () => {
  assert.deepEqual([0, 1, 2].map((n) => backoffMs(n, 0.5)), [250, 500, 1000]);
  assert.equal(backoffMs(40, 0.5), 8000);
  assert.ok(backoffMs(3, 0) < backoffMs(3, 1));
});

test('pictures have the shape that the projection demands, and a size within bounds', () => {
  assert.deepEqual(pictureBox('perspective', 1280, 800), { x: 0, y: 0, width: 1280, height: 800 });
  assert.deepEqual(pictureBox('equirectangular', 1280, 800), { x: 0, y: 80, width: 1280, height: 640 });
  const cube = frameSize('cubemap', pictureBox('cubemap', 1280, 800), 1);
  assert.equal(cube.width_px, cube.height_px * 6);
  assert.deepEqual(frameSize('perspective', { x: 0, y: 0, width: 360, height: 740 }, 2), { width_px: 720, height_px: 1480 });
  const large = frameSize('perspective', { x: 0, y: 0, width: 3840, height: 2160 }, 2);
  assert.ok(large.width_px * large.height_px < 2_410_000 && Math.abs(large.width_px / large.height_px - 16 / 9) < 0.01);
});

test('a command quotes what a shell would read', () => {
  const text = curlCommand('http://127.0.0.1:8080/', { scene: { name: "it's" }, format: 'png' });
  assert.match(text, /-X POST 'http:\/\/127\.0\.0\.1:8080\/v1\/frames'/);
  assert.ok(text.includes(`it'\\''s`));
});

test('a part that changes its shape keeps what it says', async () => {
  const known = { sun: () => ({ azimuth_deg: 90, elevation_deg: 0 }), ev: () => 12.34, timeAndPlace: () => ({ time: 'now' }), mapName: async () => 'front', meshName: async () => 'town', mountains: () => ({ kind: 'heightfield', mountains: { seed: 1 } }) };
  assert.deepEqual(carryOver({ azimuth_deg: 90, elevation_deg: 0 }, [0, 0, 0], known), [1, 0, 0]);
  assert.deepEqual(carryOver({ time: 'x' }, { azimuth_deg: 0, elevation_deg: 0 }, known), { azimuth_deg: 90, elevation_deg: 0 });
  assert.deepEqual(carryOver({ kind: 'auto' }, { kind: 'ev', ev: 0 }, known), { kind: 'ev', ev: 12.3 });
  assert.deepEqual(carryOver({}, { time: '' }, known), { time: 'now' });
  assert.deepEqual(await carryOver({ kind: 'heightfield' }, { kind: 'mesh', name: '', scale: 1 }, known), { kind: 'mesh', name: 'town', scale: 1 });
  assert.deepEqual(carryOver({ kind: 'mesh' }, { kind: 'heightfield', mountains: null }, known), { kind: 'heightfield', mountains: { seed: 1 } });
  assert.deepEqual(carryOver({ kind: 'auto' }, { kind: 'pupil', gain: 17 }, known), { kind: 'pupil', gain: 17 });
});
