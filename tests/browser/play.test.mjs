/** The timeline in the page: keyframes from the sky, scrubbing, playing, files. */
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { test } from 'node:test';
import { changing, colours, difference, numberAt, sent, sunAngles, useBrowser } from './page.mjs';

const open = useBrowser();
/** A part of the picture's change that JPEG and dither do not make, of 255. */
const SEEN = 2;
/** @typedef {import('./page.mjs').Page} Page */
/** @param {Page} page */
const handles = (page) => page.locator('.keyframe');
/** @param {Page} page */
const times = (page) => handles(page).evaluateAll((all) => all.map((e) => Number(e.getAttribute('aria-valuenow'))));
/** @param {Page} page @param {number} at_s */
const scrub = (page, at_s) =>
  page.locator('#timeline-scrub').evaluate((e, value) => {
    /** @type {HTMLInputElement} */ (e).valueAsNumber = value;
    e.dispatchEvent(new Event('input', { bubbles: true }));
  }, at_s);
/** @param {Page} page @param {string} name @param {string} text */
const load = (page, name, text) => page.locator('#timeline-file').setInputFiles({ name, mimeType: 'application/json', buffer: Buffer.from(text) });

/** Noon at 0 s, a low sun and thick air at 5 s. @param {Page} page */
async function twoKeyframes(page) {
  await page.locator('#open-timeline').click();
  await page.locator('#timeline-add').click();
  await changing(page, () => page.locator('[data-pointer="/sun/position/elevation_deg"] input[type="number"]').fill('5'));
  await page.locator('#timeline-add').click();
}

test('keyframes come from the sky, and between them it changes', () =>
  open(async (page) => {
    const noon = await colours(page);
    await page.locator('#open-timeline').click();
    assert.match((await page.locator('#timeline-hint').textContent()) ?? '', /first keyframe/);
    assert.ok(await page.locator('#timeline-play').isDisabled());
    await page.locator('#open-timeline').click();
    await twoKeyframes(page);
    const low = await colours(page);
    assert.deepEqual(await times(page), [0, 5]);
    await changing(page, () => scrub(page, 2.5));
    const { elevation } = await sunAngles(page);
    assert.ok(Math.abs(elevation - 20) < 1e-6, `half-way, ${elevation}`);
    assert.equal(await numberAt(page, '/time_s'), 2.5, 'the clock runs');
    const middle = await colours(page);
    assert.ok(difference(noon, middle) > SEEN && difference(low, middle) > SEEN);
    const { timeline } = sent(page).find((message) => message.timeline);
    assert.deepEqual(timeline.keyframes, [{ at_s: 0, patch: {} }, { at_s: 5, patch: { sun: { position: { elevation_deg: 5 } } } }]);
    await changing(page, () => scrub(page, 1));
    assert.deepEqual(Object.keys(sent(page).at(-1)).sort(), ['at_s', 'seq'], 'the timeline is sent once');
    await changing(page, () => handles(page).nth(1).click());
    assert.ok(difference(low, await colours(page)) < SEEN, 'the keyframe itself');
  }));

test('it is played, followed by the page, paused, and left by whoever changes the sky', () =>
  open(async (page) => {
    await twoKeyframes(page);
    await page.locator('#timeline-speed').selectOption('0.5');
    await page.locator('#timeline-play').click();
    assert.equal(await page.locator('#timeline-play').getAttribute('aria-label'), 'Pause');
    /** @type {number[]} */
    const seen = [];
    for (let i = 0; i < 6; i++) {
      await page.waitForTimeout(300);
      seen.push((await sunAngles(page)).elevation);
    }
    assert.ok(seen[5] < seen[0] && new Set(seen).size >= 4, `the sun goes down: ${seen}`);
    await page.locator('#sky').focus();
    await page.keyboard.press('k');
    assert.equal(await page.locator('#timeline-play').getAttribute('aria-label'), 'Play');
    await page.waitForSelector('body[data-state="final"]');
    const asked = sent(page).length;
    await page.waitForTimeout(500);
    assert.equal(sent(page).length, asked, 'at rest nothing is asked for');
    const { azimuth, elevation } = await sunAngles(page);
    await changing(page, () => page.keyboard.press('ArrowRight'));
    assert.equal((await sunAngles(page)).azimuth, azimuth + 1);
    assert.ok(Math.abs((await sunAngles(page)).elevation - elevation) < 1e-3, 'from where the timeline was');
    assert.match((await page.locator('#timeline-hint').textContent()) ?? '', /your own/);
    const last = sent(page).at(-1);
    assert.ok(last.scene && !('at_s' in last), 'the scene is told whole');
    await page.locator('#timeline-add').click();
    assert.equal((await times(page)).length, 3);
  }));

test('without a loop it ends at the last keyframe', () =>
  open(async (page) => {
    await twoKeyframes(page);
    await page.locator('#timeline-loop').uncheck();
    await page.locator('#timeline-speed').selectOption('10');
    await page.locator('#timeline-play').click();
    await page.waitForFunction(() => document.getElementById('timeline-time')?.textContent === '5 s');
    await page.waitForSelector('#timeline-play[aria-label="Play"]');
    // The last picture of the way may be final before that of its end is asked for.
    for (let i = 0; i < 100 && (await sunAngles(page)).elevation !== 5; i++) await page.waitForTimeout(50);
    assert.equal((await sunAngles(page)).elevation, 5);
  }));

test('keyframes are dragged past one another, moved by keys, set anew and deleted', () =>
  open(async (page) => {
    await twoKeyframes(page);
    const axis = await page.locator('#timeline-keys').boundingBox();
    const first = await handles(page).first().boundingBox();
    assert.ok(axis && first);
    await page.mouse.move(first.x + first.width / 2, first.y + first.height / 2);
    await page.mouse.down();
    await page.mouse.move(axis.x + axis.width * 0.5, first.y, { steps: 8 });
    await page.mouse.up();
    const [noon, low] = (await times(page)).toReversed();
    assert.ok(Math.abs(noon - 10) < 0.2 && low === 5, `${noon} ${low}`);
    await changing(page, () => scrub(page, low));
    assert.equal((await sunAngles(page)).elevation, 5, 'the low sun is now first');
    await handles(page).first().focus();
    await changing(page, () => page.keyboard.press('ArrowLeft'));
    assert.deepEqual((await times(page))[0], 4.6);
    await changing(page, () => handles(page).first().press('Enter'));
    assert.equal(await page.locator('#timeline-add').textContent(), 'Set keyframe');
    await changing(page, () => page.locator('[data-pointer="/sun/position/elevation_deg"] input[type="number"]').fill('12'));
    await page.locator('#timeline-add').click();
    await changing(page, () => scrub(page, 0));
    assert.equal((await sunAngles(page)).elevation, 12);
    await handles(page).nth(1).focus();
    await page.keyboard.press('Delete');
    assert.deepEqual(await times(page), [4.6]);
    assert.equal(sent(page).at(-1).patch, undefined);
    await page.locator('#timeline-clear').click();
    assert.deepEqual(await times(page), []);
    await page.locator('.toast button', { hasText: 'Undo' }).click();
    assert.deepEqual(await times(page), [4.6]);
  }));

test('a timeline is handed over as a file and taken back', () =>
  open(async (page) => {
    await twoKeyframes(page);
    const [download] = await Promise.all([page.waitForEvent('download'), page.locator('#timeline-save').click()]);
    assert.equal(download.suggestedFilename(), 'welkin-timeline.json');
    const text = await readFile(await download.path(), 'utf8');
    const answer = await fetch(new URL('v1/frames', page.url()), {
      method: 'POST', headers: { 'content-type': 'application/json' },
      body: JSON.stringify({ timeline: JSON.parse(text), at_s: 2.5, width_px: 32, height_px: 32 }),
    });
    assert.equal(answer.status, 200, 'as it stands, the server renders it');
    assert.match(answer.headers.get('welkin-sun') ?? '', /elevation_deg=20\.0/);
    await page.locator('#timeline-clear').click();
    await changing(page, () => load(page, 'evening.json', text));
    assert.deepEqual(await times(page), [0, 5]);
    assert.equal((await sunAngles(page)).elevation, 35);
    await changing(page, () => scrub(page, 5));
    assert.equal((await sunAngles(page)).elevation, 5);
  }));

test('a file that is no timeline is refused by the page, one that is no scene by the server', () =>
  open(async (page) => {
    await page.locator('#open-timeline').click();
    const error = page.locator('#timeline-error');
    await load(page, 'a.json', '{"keyframes": [');
    await error.waitFor({ state: 'visible' });
    assert.match((await error.textContent()) ?? '', /not JSON/);
    const before = await colours(page);
    await load(page, 'b.json', JSON.stringify({ keyframes: [{ at_s: 0, patch: { sun: { dics: true } } }] }));
    await page.locator('#timeline-error', { hasText: 'dics' }).waitFor({ state: 'visible' });
    await page.waitForSelector('body[data-state="final"]');
    assert.ok(difference(before, await colours(page)) < SEEN, 'the sky stays');
    await changing(page, () => page.locator('#sky').press('ArrowLeft'));
    assert.equal((await sunAngles(page)).azimuth, 179);
  }));

test('a playing timeline survives the loss of the connection', () =>
  open(
    async (page, server) => {
      await twoKeyframes(page);
      await page.locator('#timeline-play').click();
      await server.stop('SIGKILL');
      await page.waitForSelector('body[data-state="reconnecting"]');
      await server.start();
      await page.waitForFunction(() => document.body.dataset.state === 'preview');
      const { elevation } = await sunAngles(page);
      await page.waitForFunction((old) => Number(/** @type {HTMLInputElement} */ (document.querySelector('[data-pointer="/sun/position/elevation_deg"] input[type="number"]')).value) !== old, elevation);
    },
    { logs: /WebSocket connection|ERR_CONNECTION/ },
  ));
