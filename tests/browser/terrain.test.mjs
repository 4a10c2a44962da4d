/** Terrain: choosing it, and walking on it. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { groundProbe } from '../../web/src/fly/ground.js';
import { sent, sentScene, settled, telling, useBrowser } from './page.mjs';

const open = useBrowser();
const SMALL = { viewport: { width: 740, height: 320 } };

test('the ground is looked for from above, straight down, without air', () => {
  const radius_m = 6_360_000;
  const position = /** @type {[number, number, number]} */ ([radius_m + 100, 0, -radius_m]);
  const { scene, directions } = groundProbe({ planet: { radius_m }, terrain: { kind: 'heightfield' }, clouds: {} }, position);
  assert.deepEqual(directions, [[-1, 0, 0]]);
  // Rounding of f64 at the size of the planet.
  assert.ok(Math.abs(scene.camera.position_m[0] - radius_m - 45_000) < 1e-6);
  assert.equal(scene.clouds, null);
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
  }, { ...SMALL, logs: /404/ }));

test('who walks is carried by the ground, who flies is kept out of it', () =>
  open(
    async (page) => {
      // A slope of 1 in 2 towards the south, in the place of the server's own terrain.
      let asked = 0;
      await page.route('**/v1/probe', async (route) => {
        const { scene } = route.request().postDataJSON();
        asked += 1;
        const [, y] = scene.camera.position_m;
        await route.fulfill({ json: { distance_m: [45_000 - Math.max(-y / 2, 0)] } });
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
      // Asked again after 0.3 m of the way or 2 % of the height: 15 cm and a few.
      assert.ok(Math.abs(z - 2 + y / 2) < 0.3, `at ${y} the eyes are ${z} m up`);
      assert.ok(asked > 3);
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
