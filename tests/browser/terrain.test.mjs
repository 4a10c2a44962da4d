/** Terrain: choosing it, and walking on it. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { groundProbe, heightOn } from '../../web/src/fly/ground.js';
import { sent, sentScene, settled, telling, useBrowser } from './page.mjs';

const open = useBrowser();
const SMALL = { viewport: { width: 740, height: 320 } };

const RADIUS = 6_360_000;

/** Where rays from a probe meet a slope of 1 in 2 that rises towards the south from the plane of home. @param {any} request */
const slope = ({ scene, directions }) =>
  directions.map((/** @type {number[]} */ [, north, up]) => {
    const [, y, z] = scene.camera.position_m;
    return Math.min(-z / up, (z + y / 2) / -(up + north / 2));
  });

test('the ground about a place is looked for from above, without air', () => {
  const pose = { position_m: /** @type {[number, number, number]} */ ([20, -300, 200]), heading: /** @type {[number, number, number]} */ ([0, -1, 0]), pitch_deg: 0, roll_deg: 0 };
  const { request, patch } = groundProbe({ planet: { radius_m: RADIUS }, terrain: { kind: 'heightfield' }, clouds: {} }, pose, 40);
  assert.equal(request.scene.clouds, null);
  assert.ok(Math.abs(request.scene.camera.position_m[2] - 45_000) < 2, 'from above');
  const known = patch(slope(request));
  for (const [x, y] of [[20, -300], [0, -320], [45, -285], [31, -337]]) {
    // The plane leaves the sphere by a centimetre within this distance.
    const height = heightOn(known, [x, y, 150]);
    assert.ok(Math.abs(height + y / 2) < 0.05, `${height} m at ${[x, y]}`);
  }
  assert.ok(Math.abs(heightOn(known, [20, -900, 150]) - 170) < 0.2, 'beyond the edge as at the edge');
});

test('mountains from a seed, others, and none', () =>
  open(async (page) => {
    await page.getByRole('button', { name: 'Mountains and models' }).click();
    const choice = page.getByLabel('On the ground');
    await telling(page, () => choice.selectOption('mountains'));
    const terrain = () => sentScene(page).terrain;
    assert.equal(terrain().kind, 'heightfield');
    assert.equal(terrain().mountains.seed, 1);
    await telling(page, () => page.getByRole('button', { name: 'Others' }).click());
    const { seed } = terrain().mountains;
    assert.ok(seed > 1, `${seed}`);
    await page.locator('section[data-pointer="/terrain"] .fold').first().click();
    await page.locator('section[data-pointer="/terrain/mountains"] .fold').click();
    const erosion = page.locator('[data-pointer="/terrain/mountains/erosion"] input[type="number"]');
    await telling(page, () => erosion.fill('0.8'));
    assert.deepEqual([terrain().mountains.seed, terrain().mountains.erosion], [seed, 0.8]);
    // Of the sizes of a shadow map the slider meets the powers of two alone.
    await telling(page, () => page.locator('[data-pointer="/terrain/shadow/size_px"] input[type="range"]').fill('700'));
    assert.equal(terrain().shadow.size_px, 4096);
    await settled(page);
    await telling(page, () => choice.selectOption(''));
    assert.equal(terrain(), null);
    const turnOn = page.locator('section[data-pointer="/terrain"] .switch').first();
    await telling(page, () => turnOn.check());
    assert.equal(terrain().mountains.seed, 1, 'the switch begins with mountains whose seed is seen');
    await settled(page);
  }, SMALL));

test('who walks is carried by the ground, who flies is kept out of it', () =>
  open(
    async (page) => {
      // A slope of 1 in 2 towards the south, in the place of the server's own terrain.
      let asked = 0;
      await page.route('**/v1/probe', async (route) => {
        asked += 1;
        await route.fulfill({ json: { distance_m: slope(route.request().postDataJSON()) } });
      });
      const position = () => sentScene(page).camera.position_m;
      const rested = async () => {
        for (let count = -1; count !== sent(page).length; await page.waitForTimeout(300)) count = sent(page).length;
      };
      await page.locator('#sky').focus();
      await page.keyboard.press('z');
      await page.keyboard.down('w');
      await page.waitForTimeout(1500);
      await page.keyboard.up('w');
      await rested();
      const [, y, z] = position();
      assert.ok(y < -5, `walked to ${y}`);
      // Within the tenth of a second that the feet take.
      assert.ok(Math.abs(z - 2 + y / 2) < 0.3, `at ${y} the eyes are ${z} m up`);
      assert.ok(asked >= 1 && asked < 8, `asked ${asked} times`);
      await page.keyboard.press('z');
      await page.keyboard.down('c');
      await page.waitForTimeout(2500);
      await page.keyboard.up('c');
      await rested();
      assert.ok(position()[2] > -y / 2 - 0.3, `down to ${position()}`);
      const count = asked;
      await page.waitForTimeout(500);
      assert.equal(asked, count, 'who rests asks nothing');
    },
    { ...SMALL, hash: '#terrain.kind=heightfield' },
  ));
