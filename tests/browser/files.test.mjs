/** What the page hands over, and how it lives through a lost connection. */
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { mkdtemp, readFile, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { promisify } from 'node:util';
import { changing, colours, difference, settled, sunAngles, useBrowser } from './page.mjs';

const open = useBrowser();
const PNG = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
const EXR = Buffer.from([0x76, 0x2f, 0x31, 0x01]);

/** @param {import('./page.mjs').Page} page @param {'png' | 'exr'} format */
async function save(page, format) {
  const [download] = await Promise.all([page.waitForEvent('download'), page.locator(`[data-save="${format}"]`).click()]);
  assert.equal(download.suggestedFilename(), `welkin.${format}`);
  return readFile(await download.path());
}

test('a picture is saved as PNG and as EXR in the size asked for', () =>
  open(async (page) => {
    await page.locator('#open-save').click();
    await page.locator('#save [name="width"]').fill('320');
    await page.locator('#save [name="height"]').fill('160');
    const png = await save(page, 'png');
    assert.deepEqual(png.subarray(0, 8), PNG);
    assert.deepEqual([png.readUInt32BE(16), png.readUInt32BE(20)], [320, 160]);
    assert.deepEqual((await save(page, 'exr')).subarray(0, 4), EXR);
    await page.keyboard.press('Escape');
    assert.ok(await page.locator('#save').isHidden());
  }));

test('a picture that cannot be had says why', () =>
  open(
    async (page) => {
      const body = JSON.stringify({ title: 'Not available now', detail: 'all places are taken; try again in 5 s' });
      await page.route('**/v1/frames', (route) => route.fulfill({ status: 503, contentType: 'application/problem+json', body }));
      await page.locator('#open-save').click();
      await page.locator('[data-save="png"]').click();
      await page.locator('#save .error').waitFor();
      assert.match((await page.locator('#save .error').textContent()) ?? '', /all places are taken/);
      assert.ok(await page.locator('[data-save="png"]').isEnabled());
    },
    { logs: /status of 503/ },
  ));

test('the copied command works as it stands', () =>
  open(async (page) => {
    await changing(page, () => page.locator('[data-preset="golden-hour"]').click());
    await page.locator('#open-share').click();
    await page.locator('[data-copy="curl"]').click();
    await page.locator('.toast').waitFor();
    const command = await page.evaluate(() => navigator.clipboard.readText());
    const folder = await mkdtemp(join(tmpdir(), 'welkin-'));
    try {
      await promisify(execFile)('sh', ['-c', command], { cwd: folder });
      const png = await readFile(join(folder, 'welkin.png'));
      assert.deepEqual(png.subarray(0, 8), PNG);
      assert.equal(png.readUInt32BE(16), 900);
    } finally {
      await rm(folder, { recursive: true });
    }
  }));

test('the copied scene is one that the server takes, and the link leads back', () =>
  open(async (page) => {
    await changing(page, () => page.keyboard.press('ArrowRight'));
    const copied = async (/** @type {string} */ what) => {
      await page.locator('#open-share').click();
      await page.locator(`[data-copy="${what}"]`).click();
      await page.locator('.toast', { hasText: 'copied' }).last().waitFor();
      return page.evaluate(() => navigator.clipboard.readText());
    };
    const scene = JSON.parse(await copied('scene'));
    assert.equal(scene.sun.position.azimuth_deg, 181);
    const answer = await fetch(new URL('v1/frames', page.url()), {
      method: 'POST', headers: { 'content-type': 'application/json' }, body: JSON.stringify({ scene, width_px: 32, height_px: 32 }),
    });
    assert.equal(answer.status, 200);
    assert.match(await copied('link'), /[#&]sun\.position\.azimuth_deg=181/);
  }));

test('a lost connection is said and comes back with the scene as it is by then', () =>
  open(
    async (page, server) => {
      const before = await colours(page);
      await server.stop('SIGKILL');
      await page.waitForSelector('body[data-state="reconnecting"]');
      assert.equal(await page.locator('[data-hud="state"]').textContent(), 'Reconnecting');
      assert.match((await page.locator('#announcer').textContent()) ?? '', /Reconnecting/);
      assert.ok(difference(before, await colours(page)) === 0, 'the last picture stays');
      for (let i = 0; i < 30; i++) await page.keyboard.press('ArrowDown');
      await server.start();
      await settled(page);
      assert.deepEqual(await sunAngles(page), { azimuth: 180, elevation: 5 });
      assert.ok(difference(before, await colours(page)) > 2, 'the server shows the sun where it was put meanwhile');
      assert.match((await page.locator('#announcer').textContent()) ?? '', /Connected again/);
    },
    { logs: /WebSocket connection|ERR_CONNECTION/ },
  ));
