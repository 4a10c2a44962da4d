/** A page of the client in Debian's Chromium, and what tests read from it. */
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { after, before } from 'node:test';
import { startServer } from './server.mjs';

/** @typedef {import('playwright-core').Page} Page */
/** @type {typeof import('playwright-core')} */
const { chromium } = createRequire(new URL('../../web/package.json', import.meta.url))('playwright-core');

const ARGUMENTS = [
  '--no-sandbox', '--headless=new', '--disable-gpu', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-sync', '--disable-quic',
];
/** A full picture takes seconds where two cores render in software. */
const PATIENCE_MS = 45_000;
export const DESK = { width: 900, height: 560 };
/** A desk's layout with few pixels: clouds are dear where two cores render in software. */
export const STRIP = { width: 740, height: 320 };
/** Clouds that are rendered in few steps, as part of an address. */
export const CHEAP = 'clouds.steps=16&clouds.light_steps=1&clouds.octaves=1';
export const PHONE = { width: 360, height: 740 };

/** What each page has sent over its live connection. @type {WeakMap<Page, any[]>} */
const messages = new WeakMap();
/** @param {Page} page @returns {any[]} */
export const sent = (page) => messages.get(page) ?? [];

/** The scene that the server was last sent whole, with the patches since. @param {Page} page */
export function sentScene(page) {
  const all = sent(page);
  const from = all.findLastIndex((message) => message.scene);
  return all.slice(from).reduce((scene, { patch }) => (patch ? merged(scene, patch) : scene), all[from].scene);
}

/** RFC 7396. @param {any} held @param {any} patch @returns {any} */
function merged(held, patch) {
  if (patch === null || typeof patch !== 'object' || Array.isArray(patch)) return patch;
  const entries = Object.entries({ ...held, ...patch }).filter(([key]) => patch[key] !== null);
  return Object.fromEntries(entries.map(([key, value]) => [key, key in patch ? merged(held?.[key], patch[key]) : value]));
}

/** One server and one browser for the tests of a file. @param {string[]} [more] Further arguments of the server */
export function useBrowser(more = []) {
  /** @type {import('playwright-core').Browser} */
  let browser;
  /** @type {Awaited<ReturnType<typeof startServer>>} */
  let server;
  before(async () => {
    server = await startServer(more);
    browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ARGUMENTS });
  });
  after(async () => {
    await browser?.close();
    await server?.end();
  });

  /**
   * Opens the page, runs a test on it, and demands that the page logged no error and asked no other host.
   * @param {(page: Page, server: Awaited<ReturnType<typeof startServer>>) => Promise<void>} act
   * @param {{viewport?: {width: number, height: number}, hash?: string, clear?: boolean, touch?: boolean, logs?: RegExp, proxied?: RegExp}} [options] `clear`: no clouds, unless `hash` speaks of them; `logs`: what Chromium itself will log; `proxied`: other addresses of the server
   */
  return async (act, { viewport = DESK, hash = '', clear = true, touch = false, logs, proxied } = {}) => {
    const context = await browser.newContext({ viewport, hasTouch: touch, permissions: ['clipboard-read', 'clipboard-write'] });
    const page = await context.newPage();
    page.setDefaultTimeout(PATIENCE_MS);
    /** @type {string[]} */
    const faults = [];
    page.on('pageerror', (error) => faults.push(error.message));
    page.on('console', (message) => {
      if (['error', 'warning'].includes(message.type()) && !logs?.test(message.text())) faults.push(message.text());
    });
    messages.set(page, []);
    page.on('websocket', (socket) => socket.on('framesent', ({ payload }) => sent(page).push(JSON.parse(String(payload)))));
    page.on('request', (request) => {
      const { origin, protocol } = new URL(request.url());
      if (protocol.startsWith('http') && `${origin}/` !== server.url && !proxied?.test(request.url())) faults.push(`a request to ${request.url()}`);
    });
    try {
      const isClear = clear && !hash.includes('clouds');
      await page.goto(server.url + hash + (isClear ? `${hash ? '&' : '#'}clouds=null` : ''));
      await settled(page);
      await act(page, server);
      assert.deepEqual(faults, []);
    } finally {
      await context.close();
    }
  };
}

/** Waits until nothing finer will come. @param {Page} page */
export const settled = (page) => page.waitForSelector('body[data-state="final"]');

/** Does something that changes the picture, and waits for its final form. @param {Page} page @param {() => Promise<unknown>} act */
export async function changing(page, act) {
  const seq = await page.locator('#sky').getAttribute('data-seq');
  await act();
  await page.waitForFunction((old) => {
    const sky = document.getElementById('sky');
    return sky?.dataset.seq !== old && document.body.dataset.state === 'final';
  }, seq);
}

/** Does something that the server is told, and waits until it is. @param {Page} page @param {() => Promise<unknown>} act */
export async function telling(page, act) {
  const count = sent(page).length;
  await act();
  for (const end = Date.now() + PATIENCE_MS; sent(page).length === count; await page.waitForTimeout(20)) {
    assert.ok(Date.now() < end, 'nothing was sent');
  }
}

/** The middle of the sun's ring, CSS pixels. @param {Page} page */
export async function markAt(page) {
  const box = await page.locator('#sun-mark').boundingBox();
  assert.ok(box, 'the ring is shown');
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

/** What a number of the scene is, as the panel shows it. @param {Page} page @param {string} pointer */
export const numberAt = async (page, pointer) => Number(await page.locator(`[data-pointer="${pointer}"] input[type="number"]`).first().inputValue());

/** @param {Page} page */
export const sunAngles = async (page) => ({
  azimuth: await numberAt(page, '/sun/position/azimuth_deg'),
  elevation: await numberAt(page, '/sun/position/elevation_deg'),
});

/** @param {Page} page */
export const cameraAngles = async (page) => ({
  azimuth: await numberAt(page, '/camera/direction/azimuth_deg'),
  elevation: await numberAt(page, '/camera/direction/elevation_deg'),
});

/** Colours on a coarse grid of the canvas. @param {Page} page @returns {Promise<number[]>} */
export const colours = (page) =>
  page.evaluate(() => {
    const canvas = /** @type {HTMLCanvasElement} */ (document.getElementById('sky'));
    const copy = /** @type {OffscreenCanvasRenderingContext2D} */ (new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', { willReadFrequently: true }));
    copy.drawImage(canvas, 0, 0);
    const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
    const grid = [];
    for (let y = 8; y < canvas.height; y += 16) {
      for (let x = 8; x < canvas.width; x += 16) grid.push(...data.slice((y * canvas.width + x) * 4, (y * canvas.width + x) * 4 + 3));
    }
    return grid;
  });

/** Root mean square difference of two grids, of 255. @param {number[]} a @param {number[]} b */
export const difference = (a, b) => Math.sqrt(a.reduce((sum, v, i) => sum + (v - b[i]) ** 2, 0) / a.length);

/** The middle of what is as bright as the brightest spot on the canvas, CSS pixels. @param {Page} page */
export const brightestSpot = (page) =>
  page.evaluate(() => {
    const canvas = /** @type {HTMLCanvasElement} */ (document.getElementById('sky'));
    const copy = /** @type {OffscreenCanvasRenderingContext2D} */ (new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', { willReadFrequently: true }));
    copy.drawImage(canvas, 0, 0);
    const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
    const light = (/** @type {number} */ i) => data[4 * i] + data[4 * i + 1] + data[4 * i + 2];
    let most = 0;
    for (let i = 0; i < data.length / 4; i++) most = Math.max(most, light(i));
    let [x, y, count] = [0, 0, 0];
    for (let i = 0; i < data.length / 4; i++) {
      if (light(i) < most - 6) continue;
      [x, y, count] = [x + (i % canvas.width), y + Math.floor(i / canvas.width), count + 1];
    }
    const scale = canvas.clientWidth / canvas.width;
    return { x: (x / count + 0.5) * scale, y: (y / count + 0.5) * scale, count };
  });
