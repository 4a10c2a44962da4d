/** Walking over the planet's sphere, without a page. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { carriedBySky } from '../../web/src/fly/day.js';
import { pushed } from '../../web/src/fly/pads.js';
import { speedAt, WALK_BELOW_M } from '../../web/src/fly/pilot.js';
import { altitudeAt, headingDeg, moved, readPose, turned, upAt, writePose } from '../../web/src/fly/pose.js';
import { distance } from '../../web/src/text.js';
import { angleBetween, dot, fromAngles, toAngles } from '../../web/src/vector.js';
import { axes } from '../../web/src/view.js';
import { createRandom } from './random.mjs';

const RADIUS = 6_360_000;
/** @type {[number, number]} */
const ANYWHERE = [0.1, 1e8];
const PROJECTION = { kind: 'perspective', vertical_fov_deg: 60 };
/** A picture is written with four decimals of a degree, a place with three of a metre. */
const [WRITTEN_DEG, WRITTEN_M] = [1.5e-4, 1e-3];
/** Rounding of f64 at the size of the planet. */
const EXACT_M = 1e-7;

/** @param {any} [more] */
const camera = (more = {}) => ({ position_m: [0, 0, 2], direction: { azimuth_deg: 180, elevation_deg: 10 }, roll_deg: 0, projection: PROJECTION, ...more });

/** Largest angle between the axes of two cameras, degrees. @param {any} a @param {any} b */
function apart(a, b) {
  const [x, y] = [axes(a), axes(b)];
  return Math.max(...[[x.right, y.right], [x.up, y.up], [x.forward, y.forward]].map(([p, q]) => angleBetween(p, q)));
}

test('what is read of a camera is written as the same camera, anywhere and any way up', () => {
  const random = createRandom(7);
  for (let i = 0; i < 500; i++) {
    const position_m = [random.between(-2e7, 2e7), random.between(-2e7, 2e7), random.between(0, 2e7)];
    const steep = random.unit() < 0.2 ? [-90, 90, 89.9999][i % 3] : random.between(-90, 90);
    const from = camera({ position_m, direction: { azimuth_deg: random.between(0, 360), elevation_deg: steep }, roll_deg: random.between(-180, 180) });
    const to = camera(writePose(readPose(from, RADIUS), RADIUS));
    assert.ok(apart(from, to) < WRITTEN_DEG, `${JSON.stringify(from)} became ${JSON.stringify(to)}`);
    assert.ok(Math.hypot(...from.position_m.map((/** @type {number} */ v, /** @type {number} */ axis) => v - to.position_m[axis])) < WRITTEN_M);
  }
});

test('at home a pose says what the scene says', () => {
  for (const direction of [{ azimuth_deg: 180, elevation_deg: 10 }, { azimuth_deg: 275.5, elevation_deg: -89 }, { azimuth_deg: 42, elevation_deg: 90 }]) {
    const { position_m, ...written } = writePose(readPose(camera({ direction, roll_deg: 12 }), RADIUS), RADIUS);
    // Straight up the scene's azimuth and roll turn the same axis.
    const expected = direction.elevation_deg === 90 ? { direction: { azimuth_deg: 42, elevation_deg: 90 }, roll_deg: 12 } : { direction, roll_deg: 12 };
    assert.deepEqual(written, expected);
    assert.deepEqual(position_m, [0, 0, 2]);
  }
});

test('going ahead keeps height, pitch and roll, and comes round the planet where it began', () => {
  const start = turned(readPose(camera({ roll_deg: 5 }), RADIUS), RADIUS, 30, -20);
  let pose = start;
  const round = 2 * Math.PI * (RADIUS + 2);
  const steps = 1000;
  for (let i = 0; i < steps; i++) {
    pose = moved(pose, RADIUS, { ahead: round / steps, right: 0, up: 0 }, ANYWHERE);
    assert.ok(Math.abs(altitudeAt(pose.position_m, RADIUS) - 2) < 1e-4, 'the height stays');
    assert.ok(Math.abs(dot(pose.heading, upAt(pose.position_m, RADIUS))) < 1e-12, 'the heading is level');
    const again = readPose(camera(writePose(pose, RADIUS)), RADIUS);
    assert.ok(Math.abs(again.pitch_deg - start.pitch_deg) < WRITTEN_DEG && Math.abs(again.roll_deg - start.roll_deg) < 4 * WRITTEN_DEG);
    if (i === steps / 4) assert.ok(pose.position_m[2] < -0.9 * RADIUS, 'a quarter round, the ground is far below the plane of home');
  }
  // A thousand turns of rounding on a sphere of 6360 km.
  assert.ok(Math.hypot(...pose.position_m.map((v, axis) => v - start.position_m[axis])) < 1e-3);
  assert.ok(angleBetween(pose.heading, start.heading) < 1e-7);
});

test('round an eighth of the planet, the heading has turned by a quarter more than the walker', () => {
  // The angles of a spherical triangle exceed a flat one's by its area over R²: an eighth of the sphere has π/2.
  const ahead = { ahead: (Math.PI / 2) * (RADIUS + 2), right: 0, up: 0 };
  let pose = readPose(camera(), RADIUS);
  const home = pose.position_m;
  for (const turn of [0, 90, 90]) pose = moved(turned(pose, RADIUS, turn, 0), RADIUS, ahead, ANYWHERE);
  assert.ok(Math.hypot(...pose.position_m.map((v, axis) => v - home[axis])) < 1e-6, 'three quarter circles lead home');
  assert.ok(Math.abs(headingDeg(pose, RADIUS) - 90) < 1e-9, 'south and half a turn to the right is north in a plane, and east here');
});

test('up and down end at the ground and at the top', () => {
  const pose = readPose(camera(), RADIUS);
  const height = (/** @type {number} */ up) => altitudeAt(moved(pose, RADIUS, { ahead: 0, right: 0, up }, ANYWHERE).position_m, RADIUS);
  assert.ok(Math.abs(height(-50) - 0.1) < EXACT_M);
  assert.ok(Math.abs(height(40) - 42) < EXACT_M);
  assert.ok(Math.abs(height(1e9) - 1e8) < 1e-6);
});

test('turning is about what is up here, and stops at the zenith', () => {
  const random = createRandom(8);
  for (let i = 0; i < 200; i++) {
    const position_m = [random.between(-5e6, 5e6), random.between(-5e6, 5e6), random.between(0, 1e6)];
    const pose = readPose(camera({ position_m }), RADIUS);
    const by = random.between(-180, 180);
    const next = turned(pose, RADIUS, by, 200);
    assert.equal(next.pitch_deg, 90);
    assert.ok(Math.abs(angleBetween(pose.heading, next.heading) - Math.abs(by)) < 1e-6);
  }
  const north = readPose(camera({ direction: { azimuth_deg: 0, elevation_deg: 0 } }), RADIUS);
  assert.ok(Math.abs(headingDeg(turned(north, RADIUS, 75, 0), RADIUS) - 75) < 1e-9);
  const east = moved(turned(north, RADIUS, 90, 0), RADIUS, { ahead: 3e6, right: 0, up: 0 }, ANYWHERE);
  assert.ok(Math.abs(headingDeg(east, RADIUS) - 90) < 1e-9, 'straight on, the heading stays');
});

test('one walks on the ground and is in orbit in half a minute', () => {
  assert.equal(speedAt(2, 1), 1.5);
  const toOrbit = (/** @type {number} */ factor) => {
    let [height, seconds] = [WALK_BELOW_M, 0];
    for (; height < 4e5; seconds += 0.001) height += speedAt(height, factor) * 0.001;
    return seconds;
  };
  assert.ok(toOrbit(1) > 10 && toOrbit(1) < 30, `${toOrbit(1)} s`);
  // Turbo is ten times as fast all the way; more is faster on the ground, and a key can still be let go in time.
  assert.ok(Math.abs(toOrbit(10) - toOrbit(1) / 10) < 0.01, `${toOrbit(10)} s`);
  assert.equal(speedAt(2, 1000), 1500);
  assert.ok(toOrbit(1000) > 1, `${toOrbit(1000)} s`);
});

test('the sky carries the sun as a day does', () => {
  const noon = fromAngles({ azimuth_deg: 180, elevation_deg: 90 - 51 });
  // At an equinox the sun goes down in the west after six hours.
  const evening = toAngles(carriedBySky(noon, 51, 90));
  assert.ok(Math.abs(evening.azimuth_deg - 270) < 1e-9 && Math.abs(evening.elevation_deg) < 1e-9, JSON.stringify(evening));
  const round = carriedBySky(noon, 51, 360);
  assert.ok(angleBetween(round, noon) < 1e-9);
  // From the south the sun stands in the north at noon, and still goes down in the west.
  const south = toAngles(carriedBySky(fromAngles({ azimuth_deg: 0, elevation_deg: 60 }), -30, 90));
  assert.ok(Math.abs(south.azimuth_deg - 270) < 1e-9 && Math.abs(south.elevation_deg) < 1e-9, JSON.stringify(south));
});

test('a stick asks for nothing in the middle and for all at the rim', () => {
  assert.deepEqual(pushed(0, 0), { right: 0, up: 0 });
  assert.deepEqual(pushed(0.05, 0.05), { right: 0, up: 0 });
  assert.deepEqual(pushed(0, -3), { right: 0, up: 1 });
  const { right, up } = pushed(0.6, 0.8);
  assert.ok(Math.abs(right - 0.6) < 1e-12 && Math.abs(up + 0.8) < 1e-12);
});

test('lengths are written as people read them', () => {
  assert.deepEqual([0, 2, 12.345, 999, 1500, 42_195, -384_400_000].map(distance), ['0.00 m', '2.00 m', '12.3 m', '999 m', '1.50 km', '42.2 km', '-384400 km']);
});
