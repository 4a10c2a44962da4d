/** The picture, and what hands do to it. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import {
  brightestSpot, cameraAngles, changing, colours, DESK, difference, markAt, numberAt, settled, sunAngles, useBrowser,
} from './page.mjs';

const open = useBrowser();
/** The ring is placed in fractions of a pixel; a pointer moves in whole ones. */
const FOLLOWS_PX = 2;
/** Between two pictures of one sky, JPEG and dither change colours by about one step of 255. */
const SEEN = 2;
const EAST_OF_SOUTH = '#sun.position.azimuth_deg=170&sun.position.elevation_deg=25';
const BEHIND = '#sun.position.azimuth_deg=350&sun.position.elevation_deg=25';

test('the page shows a picture, what rendered it and how long it took', () =>
  open(async (page) => {
    const grid = await colours(page);
    assert.ok(difference(grid, grid.map(() => grid[0])) > 10, 'the canvas is not of one colour');
    assert.equal(await page.title(), 'Welkin');
    const device = await (await fetch(new URL('v1/device', page.url()))).json();
    assert.equal(await page.locator('[data-hud="adapter"]').textContent(), device.adapter);
    assert.equal(await page.locator('[data-hud="state"]').textContent(), 'Final');
    await page.locator('[data-pass]').first().waitFor({ state: 'attached' });
    assert.match((await page.locator('[data-hud="time"]').textContent()) ?? '', /^[\d.]+ ms$/);
    assert.equal(await page.locator('[data-hud="size"]').textContent(), `${DESK.width} × ${DESK.height}`);
    await page.locator('#hud summary').click();
    assert.ok(await page.locator('[data-pass="sky"]').isVisible(), 'there is a time for each pass');
    assert.match((await page.locator('#sky').getAttribute('aria-label')) ?? '', /Sun 35 degrees above the horizon in the south/);
  }));

test('the sun follows the pointer, and the picture follows the sun', () =>
  open(
    async (page) => {
      const [before, from] = [await colours(page), await markAt(page)];
      // Grabbed beside its middle, it keeps its distance.
      await page.mouse.move(from.x + 7, from.y - 5);
      await page.mouse.down();
      await page.mouse.move(300, 200, { steps: 4 });
      await page.waitForTimeout(50);
      const held = await markAt(page);
      assert.ok(Math.hypot(held.x - 293, held.y - 205) < FOLLOWS_PX, `the ring stands at ${held.x}, ${held.y}`);
      await changing(page, () => page.mouse.move(200, 260, { steps: 4 }));
      await page.mouse.up();
      const after = await markAt(page);
      assert.ok(Math.hypot(after.x - 193, after.y - 265) < FOLLOWS_PX);
      assert.ok(difference(before, await colours(page)) > SEEN, 'the picture changed');
    },
    { hash: EAST_OF_SOUTH },
  ));

test('a sun grabbed from afar moves as far as the pointer', () =>
  open(
    async (page) => {
      const [from, look] = [await markAt(page), await cameraAngles(page)];
      await page.mouse.move(150, 200);
      await page.mouse.down();
      await changing(page, () => page.mouse.move(190, 230, { steps: 3 }));
      await page.mouse.up();
      const to = await markAt(page);
      assert.ok(Math.hypot(to.x - from.x - 40, to.y - from.y - 30) < FOLLOWS_PX);
      assert.deepEqual(await cameraAngles(page), look);
    },
    { hash: EAST_OF_SOUTH },
  ));

test('a sun behind the observer is shown by an arrow and moves with the hand', () =>
  open(
    async (page) => {
      assert.ok(await page.locator('#sun-arrow').isVisible());
      assert.ok(await page.locator('#sun-mark').isHidden());
      await page.mouse.move(300, 200);
      await page.mouse.down();
      await changing(page, () => page.mouse.move(300, 150, { steps: 3 }));
      await page.mouse.up();
      const { elevation } = await sunAngles(page);
      assert.ok(elevation > 27 && elevation < 33, `50 of 560 pixels are about 5 of 60 degrees; the sun stands at ${elevation}`);
    },
    { hash: BEHIND },
  ));

test('the dome moves the sun anywhere, below the horizon too', () =>
  open(async (page) => {
    const box = await page.locator('#dome svg').boundingBox();
    assert.ok(box);
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await changing(page, () => page.mouse.click(x + (box.width / 120) * 50, y));
    const { azimuth, elevation } = await sunAngles(page);
    assert.ok(Math.abs(azimuth - 90) < 2 && Math.abs(elevation + 10) < 2, `${azimuth}, ${elevation}`);
  }));

test('looking around leaves the sun: with the ground, the other button, or Shift', () =>
  open(async (page) => {
    const sun = await sunAngles(page);
    /** @type {[number, () => Promise<void>, () => Promise<void>][]} */
    const ways = [
      [DESK.height - 60, () => page.mouse.down(), () => page.mouse.up()],
      [150, () => page.mouse.down({ button: 'right' }), () => page.mouse.up({ button: 'right' })],
      [150, async () => { await page.keyboard.down('Shift'); await page.mouse.down(); }, async () => { await page.mouse.up(); await page.keyboard.up('Shift'); }],
    ];
    for (const [y, press, release] of ways) {
      const [look, before] = [await cameraAngles(page), await colours(page)];
      await page.mouse.move(400, y);
      await press();
      await changing(page, () => page.mouse.move(320, y + 30, { steps: 3 }));
      await release();
      const now = await cameraAngles(page);
      assert.ok(now.azimuth > look.azimuth + 5 && now.elevation > look.elevation + 2, 'the picture follows the hand');
      assert.deepEqual(await sunAngles(page), sun);
      assert.ok(difference(before, await colours(page)) > SEEN);
    }
  }));

test('the wheel zooms', () =>
  open(async (page) => {
    await page.mouse.move(300, 200);
    await changing(page, () => page.mouse.wheel(0, -300));
    const fov = await numberAt(page, '/camera/projection/vertical_fov_deg');
    assert.ok(fov > 30 && fov < 45, `60 degrees became ${fov}`);
  }));

test('keys move the sun and zoom', () =>
  open(async (page) => {
    await changing(page, () => page.keyboard.press('ArrowRight'));
    await changing(page, () => page.keyboard.press('ArrowUp'));
    assert.deepEqual(await sunAngles(page), { azimuth: 181, elevation: 36 });
    await changing(page, () => page.keyboard.press('Shift+ArrowLeft'));
    assert.deepEqual(await sunAngles(page), { azimuth: 180.9, elevation: 36 });
    await changing(page, () => page.keyboard.press('PageUp'));
    const fov = await numberAt(page, '/camera/projection/vertical_fov_deg');
    assert.ok(fov < 60);
    await changing(page, () => page.keyboard.press('PageDown'));
    assert.ok((await numberAt(page, '/camera/projection/vertical_fov_deg')) > fov);
  }));

test('one finger drags the sun, two look and pinch', () =>
  open(
    async (page) => {
      const touch = await page.context().newCDPSession(page);
      /** @param {'touchStart' | 'touchMove' | 'touchEnd'} type @param {...[number, number]} points */
      const send = (type, ...points) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
      const from = await markAt(page);
      await send('touchStart', [from.x, from.y]);
      await changing(page, () => send('touchMove', [from.x - 60, from.y + 40]));
      await send('touchEnd');
      const to = await markAt(page);
      assert.ok(Math.hypot(to.x - from.x + 60, to.y - from.y - 40) < FOLLOWS_PX);
      const [sun, look] = [await sunAngles(page), await cameraAngles(page)];
      await send('touchStart', [250, 200], [350, 200]);
      await changing(page, () => send('touchMove', [200, 220], [400, 220]));
      await send('touchEnd');
      assert.ok((await numberAt(page, '/camera/projection/vertical_fov_deg')) < 40, 'fingers twice as far apart halve the field of view');
      assert.ok((await cameraAngles(page)).elevation > look.elevation);
      assert.deepEqual(await sunAngles(page), sun);
    },
    { hash: EAST_OF_SOUTH, touch: true },
  ));

/** The ring must stand on the sun that the server drew: both sides compute the projection. */
const CAMERAS = {
  perspective: '',
  'perspective with roll': '&camera.roll_deg=30',
  fisheye: '&camera.projection.kind=fisheye&camera.projection.fov_deg=180&camera.projection.mapping=equisolid&camera.direction.elevation_deg=60&camera.direction.azimuth_deg=180',
  'fisheye at the zenith': '&camera.projection.kind=fisheye&camera.direction.elevation_deg=90&camera.direction.azimuth_deg=150',
  equirectangular: '&camera.projection.kind=equirectangular',
  cubemap: '&camera.projection.kind=cubemap',
};
for (const [name, camera] of Object.entries(CAMERAS)) {
  test(`the ring stands on the sun: ${name}`, () =>
    open(
      async (page) => {
        const [ring, sun] = [await markAt(page), await brightestSpot(page)];
        // The disc is 2 degrees wide so that it covers pixels in every projection; its glow adds a pixel or two.
        assert.ok(Math.hypot(ring.x - sun.x, ring.y - sun.y) < 4, `ring at ${ring.x}, ${ring.y}; sun at ${sun.x}, ${sun.y}`);
      },
      { hash: `#sun.position.azimuth_deg=165&sun.position.elevation_deg=28&sun.angular_diameter_deg=2&display.exposure.kind=ev&display.exposure.ev=18${camera}` },
    ));
}

test('resizing keeps a picture and asks for one of the new size', () =>
  open(async (page) => {
    await changing(page, () => page.setViewportSize({ width: 800, height: 600 }));
    assert.equal(await page.locator('[data-hud="size"]').textContent(), '800 × 600');
    const grid = await colours(page);
    assert.ok(difference(grid, grid.map(() => grid[0])) > 10);
    await settled(page);
  }));
