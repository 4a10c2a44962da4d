/** Walking and flying with keys, mouse and thumbs. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { cameraAngles, changing, colours, difference, PHONE, sent, sentScene, settled, sunAngles, telling, useBrowser } from './page.mjs';

/** @typedef {import('playwright-core').Page} Page */

const open = useBrowser();
/** Pictures are dear in software. */
const SMALL = { viewport: { width: 740, height: 320 } };
/** Two cores may leave the page waiting; what is held is held for longer then. */
const HELD_MS = 400;
const SEEN = 2;

const camera = (/** @type {Page} */ page) => sentScene(page).camera;
/** @param {Page} page @param {string} key */
async function hold(page, key, ms = HELD_MS) {
  await telling(page, async () => {
    await page.keyboard.down(key);
    await page.waitForTimeout(ms);
    await page.keyboard.up(key);
  });
  await rested(page);
}

/** Waits until nothing is sent any more. @param {Page} page */
async function rested(page) {
  for (let count = -1; count !== sent(page).length; await page.waitForTimeout(250)) count = sent(page).length;
}

test('W, S, A and D walk, level whatever one looks at', () =>
  open(async (page) => {
    const start = camera(page).position_m;
    /** @type {[string, (step: number[]) => boolean][]} */
    const ways = [
      ['w', ([x, y]) => y < -0.2 && Math.abs(x) < 0.01],
      ['s', ([x, y]) => y > 0.2 && Math.abs(x) < 0.01],
      ['a', ([x, y]) => x > 0.2 && Math.abs(y) < 0.01],
      ['d', ([x, y]) => x < -0.2 && Math.abs(y) < 0.01],
    ];
    for (const [key, isRight] of ways) {
      const from = camera(page).position_m;
      await hold(page, key);
      const step = camera(page).position_m.map((/** @type {number} */ v, /** @type {number} */ i) => v - from[i]);
      assert.ok(isRight(step), `looking south, ${key} went ${step}`);
      assert.ok(Math.abs(step[2]) < 0.01);
    }
    assert.ok(Math.abs(camera(page).position_m[2] - start[2]) < 0.01);
    assert.deepEqual(camera(page).direction, { azimuth_deg: 180, elevation_deg: 10 });
  }, SMALL));

test('motion follows the clock in small steps, and all of them go out as patches', () =>
  open(async (page) => {
    const before = sent(page).length;
    await page.keyboard.down('w');
    await page.waitForTimeout(1500);
    const middle = camera(page).position_m[1];
    const from = performance.now();
    await page.waitForTimeout(1500);
    const [gone, seconds] = [camera(page).position_m[1] - middle, (performance.now() - from) / 1000];
    await page.keyboard.up('w');
    // A walk is 1.5 m/s; the two clocks read a busy machine some frames apart.
    assert.ok(Math.abs(-gone / seconds - 1.5) < 0.4, `${gone} m in ${seconds} s`);
    const patches = sent(page).slice(before);
    assert.ok(patches.length > 10 && patches.every(({ patch }) => patch?.camera), `${patches.length} patches`);
    await rested(page);
    await settled(page);
  }, SMALL));

test('Space rises, faster the higher; Ctrl and C come down; nothing goes below the ground', () =>
  open(async (page) => {
    const before = await colours(page);
    await hold(page, 'Space', 3000);
    const high = camera(page).position_m[2];
    assert.ok(high > 4.5, `${high} m`);
    await page.keyboard.press('z');
    await changing(page, () => hold(page, 'Space', 1500));
    assert.ok(camera(page).position_m[2] > 10 * high, 'turbo, and more speed up there');
    assert.ok(difference(before, await colours(page)) > SEEN, 'the picture shows it');
    const top = camera(page).position_m[2];
    await hold(page, 'Control');
    const lower = camera(page).position_m[2];
    assert.ok(lower < top);
    await hold(page, 'c', 3000);
    assert.ok(Math.abs(camera(page).position_m[2] - 0.1) < 1e-3, `${camera(page).position_m}`);
    await settled(page);
    assert.equal(await page.locator('.toast.bad').count(), 0);
  }, SMALL));

test('in the air W flies where one looks, and lands on its feet', () =>
  open(
    async (page) => {
      await hold(page, 'w');
      const [x, y, z] = camera(page).position_m;
      assert.ok(x > 5 && Math.abs(y) < 1e-3 && Math.abs((z - 500) / x + Math.tan(Math.PI / 6)) < 0.01, `${[x, y, z]}`);
      await page.keyboard.down('Shift');
      await hold(page, 'W', 2500);
      await page.keyboard.up('Shift');
      assert.ok(camera(page).position_m[2] > 1 && camera(page).position_m[2] < 3.5, `${camera(page).position_m}`);
    },
    { ...SMALL, hash: '#camera.position_m=[0,0,500]&camera.direction.azimuth_deg=90&camera.direction.elevation_deg=-30' },
  ));

test('Q, E, R and F turn the head, and the zenith is the end', () =>
  open(async (page) => {
    /** @type {[string, 'azimuth' | 'elevation', number][]} */
    const ways = [['q', 'azimuth', -1], ['e', 'azimuth', 1], ['f', 'elevation', -1], ['r', 'elevation', 1]];
    for (const [key, angle, sign] of ways) {
      const from = await cameraAngles(page);
      await hold(page, key);
      const to = await cameraAngles(page);
      assert.ok(sign * (to[angle] - from[angle]) > 5, `${key}: ${from[angle]} to ${to[angle]}`);
    }
    await hold(page, 'r', 3000);
    assert.equal((await cameraAngles(page)).elevation, 90);
    assert.deepEqual(camera(page).position_m, [0, 0, 2]);
  }, SMALL));

test('far from home the horizon stays level', () =>
  open(
    async (page) => {
      // A sixth of the way round, east is down by 60 degrees: what looks north and stands upright there has this roll.
      await page.keyboard.press('p');
      const looking = page.locator('[data-position="looking"]');
      assert.equal(await looking.textContent(), '0.0° 0.0°');
      await hold(page, 'r', 300);
      const pitch = (await looking.textContent())?.split(' ')[1];
      const { azimuth_deg } = camera(page).direction;
      assert.ok(azimuth_deg > 5 && azimuth_deg < 60, `up there is east here: ${azimuth_deg}`);
      await hold(page, 'e');
      await hold(page, 's');
      const [heading, after] = (await looking.textContent())?.split(' ') ?? [];
      assert.equal(after, pitch);
      assert.ok(parseFloat(heading) > 5);
      const [x, y, z] = camera(page).position_m;
      assert.ok(Math.abs(Math.hypot(x, y, z + 6_360_000) - 6_360_002) < 0.01, 'and walks on the ground');
      assert.ok(Math.abs(camera(page).roll_deg - 60) > 0.5, 'the roll has followed');
    },
    { ...SMALL, hash: `#camera.position_m=[${6_360_002 * Math.sin(Math.PI / 3)},0,-3179999]&camera.direction.azimuth_deg=0&camera.direction.elevation_deg=0&camera.roll_deg=60` },
  ));

test('the speed keys, turbo and the position', () =>
  open(async (page) => {
    const speed = page.locator('[data-position="speed"]');
    assert.ok(await speed.isHidden());
    await page.keyboard.press('p');
    assert.equal(await speed.textContent(), '1.50 m/s, ×1');
    assert.equal(await page.locator('[data-position="height"]').textContent(), '2.00 m');
    assert.equal(await page.locator('[data-position="place"]').textContent(), '0.00 m  0.00 m  2.00 m');
    for (const [key, expected] of [['+', '1.88 m/s, ×1.25'], ['-', '1.50 m/s, ×1'], ['*', '150 m/s, ×100'], ['z', '1.50 km/s, ×100, turbo'], ['/', '15.0 m/s, ×1, turbo'], ['z', '1.50 m/s, ×1']]) {
      await page.keyboard.press(key);
      assert.equal(await speed.textContent(), expected, key);
    }
    await page.keyboard.press('*');
    await hold(page, 'w');
    const [, y] = camera(page).position_m;
    assert.ok(y < -20, `a hundred times as fast: ${y} m`);
    assert.match((await page.locator('[data-position="place"]').textContent()) ?? '', /^0\.00 m {2}-/);
    await page.keyboard.press('p');
    assert.ok(await speed.isHidden());
    await page.keyboard.press('+');
    assert.ok(await speed.isVisible(), 'a change of speed is shown');
    await speed.waitFor({ state: 'hidden' });
  }, SMALL));

test('T holds the camera still and lets it go', () =>
  open(async (page) => {
    await page.keyboard.press('t');
    const count = sent(page).length;
    await page.keyboard.down('w');
    await page.waitForTimeout(500);
    await page.keyboard.up('w');
    assert.equal(sent(page).length, count);
    await page.keyboard.press('t');
    await hold(page, 'w');
    assert.ok(camera(page).position_m[1] < -0.2);
  }, SMALL));

test('M moves the sun along its day until M', () =>
  open(async (page) => {
    await telling(page, () => page.keyboard.press('m'));
    await page.waitForTimeout(1500);
    await page.keyboard.press('m');
    await rested(page);
    const { azimuth, elevation } = await sunAngles(page);
    // From the south: a degree a second about the pole, westwards and down.
    assert.ok(azimuth > 180.5 && azimuth < 190 && elevation < 35 && elevation > 34, `${azimuth}, ${elevation}`);
    const time = () => Date.parse(sentScene(page).sun.position.time);
    // The switch sets noon: what it sends has to be gone before the slider's earlier hour is waited for.
    await telling(page, () => page.locator('#time-place .switch').click());
    await rested(page);
    const noon = time();
    await telling(page, () => page.locator('#day').fill('600'));
    await rested(page);
    const from = time();
    assert.ok(from < noon, 'ten by the sun');
    await telling(page, () => page.locator('#sky').focus().then(() => page.keyboard.press('m')));
    await page.waitForTimeout(1500);
    await page.keyboard.press('m');
    await rested(page);
    assert.ok(time() > from + 120_000, 'where a time sets the sun, the time moves');
    await settled(page);
  }, SMALL));

test('keys that are typed into fields, held with Ctrl or lost with the focus do not move the camera', () =>
  open(async (page) => {
    await page.locator('#sky').focus();
    const extent = page.locator('[data-pointer="/sun/position/azimuth_deg"] input[type="number"]');
    await extent.focus();
    const before = camera(page);
    for (const key of ['w', 'd', 'q', ' ']) {
      await page.keyboard.down(key);
      await page.waitForTimeout(100);
      await page.keyboard.up(key);
    }
    await page.locator('#sky').focus();
    await page.keyboard.press('Control+a');
    await rested(page);
    const { position_m, direction } = camera(page);
    assert.deepEqual([position_m[0], position_m[1], direction], [before.position_m[0], before.position_m[1], before.direction]);
    // A dialog takes the keys, and what was held is let go.
    await page.keyboard.down('w');
    await page.keyboard.press('h');
    await page.locator('#help').waitFor({ state: 'visible' });
    await rested(page);
    await page.keyboard.up('w');
    await page.keyboard.press('h');
    await page.locator('#help').waitFor({ state: 'hidden' });
    const count = sent(page).length;
    await page.waitForTimeout(300);
    assert.equal(sent(page).length, count);
  }, SMALL));

test('Ctrl while flying does not let a closing key by, and alone it does', () =>
  open(async (page) => {
    const isHeld = () => page.evaluate(() => !window.dispatchEvent(new Event('beforeunload', { cancelable: true })));
    await page.keyboard.down('Control');
    assert.equal(await isHeld(), false);
    await page.keyboard.down('w');
    assert.equal(await isHeld(), false, 'Ctrl first is the browser’s');
    await page.keyboard.up('w');
    await page.keyboard.up('Control');
    await page.keyboard.down('w');
    await page.keyboard.down('Control');
    assert.ok(await isHeld());
    await page.keyboard.up('Control');
    await page.keyboard.up('w');
    await rested(page);
    assert.equal(await isHeld(), false);
    await settled(page);
  }, SMALL));

test('the help names every key of the camera', () =>
  open(async (page) => {
    await page.keyboard.press('h');
    const text = (await page.locator('#help .keys').textContent()) ?? '';
    for (const key of ['W A S D', 'Space, Ctrl or C', 'Q E R F', 'Shift, Z', '+ − * /', 'O', 'P', 'T', 'M']) assert.ok(text.includes(key), key);
    const box = await page.locator('#help').boundingBox();
    assert.ok(box && box.y >= 0 && box.y + box.height <= SMALL.viewport.height, 'it stays in the window and scrolls');
  }, SMALL));

test('the mouse looks around while it is locked: by the button, O and a double click', () =>
  open(async (page) => {
    const isLocked = () => page.evaluate(() => document.pointerLockElement?.id === 'sky');
    /** @type {[string, () => Promise<void>][]} */
    const ways = [
      ['button', () => page.locator('#fly').click()],
      ['O', () => page.keyboard.press('o')],
      ['double click', () => page.mouse.dblclick(200, 200)],
    ];
    for (const [name, lock] of ways) {
      const sun = await sunAngles(page);
      await lock();
      await page.locator('#lock-hint').waitFor({ state: 'visible' });
      assert.ok(await isLocked(), name);
      assert.equal(await page.locator('#fly').getAttribute('aria-pressed'), 'true');
      await telling(page, () => page.mouse.move(300, 200));
      await rested(page);
      const from = await cameraAngles(page);
      await telling(page, () => page.mouse.move(360, 170, { steps: 3 }));
      await rested(page);
      const to = await cameraAngles(page);
      assert.ok(to.azimuth > from.azimuth && to.elevation > from.elevation, `${name}: right and up from ${JSON.stringify(from)} is ${JSON.stringify(to)}`);
      await page.mouse.down();
      await page.mouse.move(300, 170, { steps: 2 });
      await page.mouse.up();
      assert.deepEqual(await sunAngles(page), sun, 'the sun is not grabbed');
      await page.keyboard.down('w');
      await page.keyboard.down('Control');
      await page.keyboard.up('Control');
      await page.keyboard.up('w');
      await page.keyboard.press('o');
      await page.locator('#lock-hint').waitFor({ state: 'hidden' });
      assert.equal(await isLocked(), false);
      assert.equal(await page.locator('#fly').getAttribute('aria-pressed'), 'false');
      // Chromium gives the mouse away again after a while only.
      await page.waitForTimeout(1400);
    }
  }, SMALL));

test('two thumbs walk, look and rise', () =>
  open(
    async (page) => {
      const touch = await page.context().newCDPSession(page);
      /** @param {'touchStart' | 'touchMove' | 'touchEnd'} type @param {...[number, number]} points */
      const send = (type, ...points) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
      const middle = async (/** @type {string} */ selector) => {
        const box = await page.locator(selector).boundingBox();
        assert.ok(box, selector);
        return /** @type {[number, number]} */ ([box.x + box.width / 2, box.y + box.height / 2]);
      };
      await page.locator('#fly').tap();
      await page.locator('#pads').waitFor({ state: 'visible' });
      const [[x, y], [u, v]] = [await middle('[data-stick="move"]'), await middle('[data-stick="look"]')];
      const sun = await sunAngles(page);
      await send('touchStart', [x, y], [u, v]);
      await send('touchMove', [x, y - 45], [u + 45, v]);
      await page.waitForTimeout(800);
      await send('touchEnd');
      await rested(page);
      const { position_m, direction } = camera(page);
      assert.ok(position_m[1] < -0.2 && direction.azimuth_deg > 190 && direction.azimuth_deg < 300, JSON.stringify(camera(page)));
      assert.deepEqual(await sunAngles(page), sun);
      await telling(page, async () => send('touchStart', await middle('[data-rise="1"]')));
      await page.waitForTimeout(600);
      await send('touchEnd');
      await rested(page);
      assert.ok(camera(page).position_m[2] > 2.3);
      for (const name of ['turbo', 'sun', 'position']) {
        const button = page.locator(`[data-fly="${name}"]`);
        await button.tap();
        assert.equal(await button.getAttribute('aria-pressed'), 'true', name);
      }
      assert.match((await page.locator('[data-position="speed"]').textContent()) ?? '', /turbo/);
      await page.locator('[data-fly="sun"]').tap();
      const outside = await page.evaluate(() => [...document.querySelectorAll('#pads *, #position *')].filter((e) => e.getBoundingClientRect().right > window.innerWidth || e.getBoundingClientRect().left < 0).length);
      assert.equal(outside, 0);
      await page.locator('#fly').tap();
      await page.locator('#pads').waitFor({ state: 'hidden' });
    },
    { viewport: PHONE, touch: true },
  ));
