/** World direction to pixel and back, for each projection. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { edgePoint } from '../../web/src/mark.js';
import { angleBetween, fromAngles, toAngles } from '../../web/src/vector.js';
import { createView } from '../../web/src/view.js';
import { createRandom } from './random.mjs';

const WIDTH = 1200;
const HEIGHT = 800;
/** Rounding of f64 through a dozen operations, seen at 1200 pixels. */
const PIXEL = 1e-6;
/** The same as an angle, degrees; arcs near the zenith lose half the digits in `atan2`. */
const DEGREE = 1e-6;

/** @param {any} projection @param {any} [more] */
const camera = (projection, more = {}) => ({ direction: { azimuth_deg: 180, elevation_deg: 10 }, roll_deg: 0, projection, ...more });
const PERSPECTIVE = { kind: 'perspective', vertical_fov_deg: 60 };
const PROJECTIONS = [
  PERSPECTIVE,
  { kind: 'perspective', vertical_fov_deg: 150 },
  { kind: 'fisheye', fov_deg: 180, mapping: 'equidistant' },
  { kind: 'fisheye', fov_deg: 360, mapping: 'equisolid' },
  { kind: 'fisheye', fov_deg: 300, mapping: 'stereographic' },
  { kind: 'equirectangular' },
  { kind: 'cubemap' },
];

for (const projection of PROJECTIONS) {
  test(`${Object.values(projection).join(' ')}: pixel to direction to pixel`, () => {
    const random = createRandom(1);
    for (let i = 0; i < 500; i++) {
      const direction = { azimuth_deg: random.between(-360, 360), elevation_deg: random.between(-90, 90) };
      const view = createView(camera(projection, { direction, roll_deg: random.between(-180, 180) }), WIDTH, HEIGHT);
      // A fisheye shows its circle only.
      const [reach, turn] = [random.between(0, HEIGHT / 2 - 1), random.between(0, 2 * Math.PI)];
      const pixel =
        projection.kind === 'fisheye'
          ? { x: WIDTH / 2 + reach * Math.cos(turn), y: HEIGHT / 2 + reach * Math.sin(turn) }
          : { x: random.between(0, WIDTH), y: random.between(1, HEIGHT - 1) };
      const back = view.project(view.unproject(pixel));
      assert.ok(back, `pixel ${pixel.x}, ${pixel.y} has a direction that falls on no pixel`);
      assert.ok(Math.hypot(back.x - pixel.x, back.y - pixel.y) < PIXEL * 10, `${JSON.stringify(pixel)} came back as ${JSON.stringify(back)}`);
    }
  });
}

test('the camera looks at the middle, up is up and right is right', () => {
  const view = createView(camera(PERSPECTIVE), WIDTH, HEIGHT);
  const middle = view.project(fromAngles({ azimuth_deg: 180, elevation_deg: 10 }));
  assert.ok(middle && Math.hypot(middle.x - WIDTH / 2, middle.y - HEIGHT / 2) < PIXEL);
  const above = view.project(fromAngles({ azimuth_deg: 180, elevation_deg: 20 }));
  const west = view.project(fromAngles({ azimuth_deg: 190, elevation_deg: 10 }));
  assert.ok(above && above.y < HEIGHT / 2);
  assert.ok(west && west.x > WIDTH / 2, 'looking south, west is at the right');
});

test('half the field of view reaches the edge', () => {
  const view = createView(camera(PERSPECTIVE), WIDTH, HEIGHT);
  const top = view.unproject({ x: WIDTH / 2, y: 0 });
  assert.ok(Math.abs(angleBetween(top, fromAngles({ azimuth_deg: 180, elevation_deg: 10 })) - 30) < DEGREE);
  const round = createView(camera({ kind: 'fisheye', fov_deg: 180, mapping: 'equidistant' }), WIDTH, HEIGHT);
  const rim = round.unproject({ x: WIDTH / 2, y: HEIGHT / 4 });
  assert.ok(Math.abs(angleBetween(rim, fromAngles({ azimuth_deg: 180, elevation_deg: 10 })) - 45) < DEGREE, 'equidistant: half the radius is half the angle');
});

test('roll turns the picture clockwise', () => {
  const view = createView(camera(PERSPECTIVE, { roll_deg: 90 }), WIDTH, HEIGHT);
  const above = view.project(fromAngles({ azimuth_deg: 180, elevation_deg: 20 }));
  assert.ok(above && above.x > WIDTH / 2 && Math.abs(above.y - HEIGHT / 2) < PIXEL, 'what was above is at the right');
});

test('what lies behind a perspective camera is nowhere, and a bearing leads there', () => {
  const view = createView(camera(PERSPECTIVE), WIDTH, HEIGHT);
  assert.equal(view.project(fromAngles({ azimuth_deg: 0, elevation_deg: 0 })), null);
  const east = view.bearing(fromAngles({ azimuth_deg: 80, elevation_deg: 0 }));
  assert.ok(east.x < -0.9, 'looking south, east is at the left');
});

test('equirectangular: left edge west, centre east, zenith on top', () => {
  const view = createView(camera({ kind: 'equirectangular' }), 360, 180);
  const at = (/** @type {number} */ az, /** @type {number} */ el) => view.project(fromAngles({ azimuth_deg: az, elevation_deg: el }));
  assert.ok(Math.abs((at(90, 0)?.x ?? 0) - 180) < PIXEL && Math.abs((at(90, 0)?.y ?? 0) - 90) < PIXEL);
  assert.ok((at(271, 0)?.x ?? 9) < 2, 'just past west is at the left edge');
  assert.ok(Math.abs((at(0, 89)?.y ?? 0) - 1) < PIXEL);
});

test('angles and vectors', () => {
  const random = createRandom(2);
  for (let i = 0; i < 500; i++) {
    const angles = { azimuth_deg: random.between(0, 360), elevation_deg: random.between(-89.9, 89.9) };
    const back = toAngles(fromAngles(angles));
    assert.ok(Math.abs(back.azimuth_deg - angles.azimuth_deg) < DEGREE && Math.abs(back.elevation_deg - angles.elevation_deg) < DEGREE);
  }
});

test('the arrow stands on the edge of a box', () => {
  const box = { x: 100, y: 50, width: 400, height: 200 };
  assert.deepEqual(edgePoint(box, { x: 1, y: 0 }, 20), { x: 480, y: 150 });
  assert.deepEqual(edgePoint(box, { x: 0, y: -1 }, 20), { x: 300, y: 70 });
});
