/** Jobs in the page, and the board of their queue. */
import assert from 'node:assert/strict';
import { createServer, request } from 'node:http';
import { test } from 'node:test';
import { useBrowser } from './page.mjs';

const open = useBrowser();

/** @param {string} url @param {object} document */
async function send(url, document) {
  const answer = await fetch(`${url}v1/jobs`, { method: 'POST', headers: { 'content-type': 'application/json' }, body: JSON.stringify(document) });
  assert.equal(answer.status, 202);
  return (await answer.json()).id;
}

const small = { width_px: 64, height_px: 36, quality: 'preview' };
const moving = (/** @type {number} */ elevation_deg) => ({ sun: { position: { azimuth_deg: 180, elevation_deg } } });
const lapse = {
  name: 'A short morning',
  frames: {
    kind: 'timeline', to_s: 10, count: 6, fps: 6, films: ['webm', 'gif'],
    timeline: { scene: { clouds: null }, keyframes: [{ at_s: 0, patch: moving(2) }, { at_s: 10, patch: moving(30) }] },
  },
  ...small,
};

test('a time-lapse is watched, its frames are seen, and its film plays', () =>
  open(async (page, server) => {
    const id = await send(server.url, lapse);
    await page.locator('#open-jobs').click();
    const job = page.locator(`[data-job="${id}"]`);
    await job.waitFor();
    assert.match((await job.locator('h3').textContent()) ?? '', /A short morning/);
    await page.locator(`[data-job="${id}"][data-state="done"]`).waitFor({ timeout: 120_000 });
    assert.match((await job.locator('.note').first().textContent()) ?? '', /6 of 6/);
    assert.ok(await job.locator('button').isHidden());
    await page.waitForFunction((of) => [...document.querySelectorAll(`[data-job="${of}"] img`)].filter((i) => /** @type {HTMLImageElement} */ (i).naturalWidth === 64).length === 4, id);
    const seconds = await job.locator('video').evaluate(async (/** @type {HTMLVideoElement} */ video) => {
      await video.play();
      await new Promise((resolve) => video.addEventListener('timeupdate', () => video.currentTime > 0.3 && resolve(null)));
      return [video.duration, video.videoWidth, video.videoHeight];
    });
    assert.ok(Math.abs(seconds[0] - 1) < 0.05, `${seconds[0]} s`);
    assert.deepEqual(seconds.slice(1), [64, 36]);
    for (const name of ['film.webm', 'film.gif', 'labels.jsonl']) assert.equal(await job.locator(`a[download="${name}"]`).count(), 1, name);
  }));

test('a job is stopped in the page', () =>
  open(async (page, server) => {
    const id = await send(server.url, { frames: { kind: 'random', count: 5000, scene: { clouds: null }, ranges: [{ field: '/sun/position/elevation_deg', from: 0, to: 60 }] }, ...small });
    await page.locator('#open-jobs').click();
    await page.locator(`[data-job="${id}"] button`).click();
    await page.locator(`[data-job="${id}"][data-state="cancelled"]`).waitFor();
  }));

/** A proxy that has a server under a prefix, which it takes off. @param {string} url @param {string} prefix */
async function behindPrefix(url, prefix) {
  const proxy = createServer((asked, answer) => {
    const path = asked.url ?? '';
    if (!path.startsWith(`${prefix}/`)) {
      answer.writeHead(404).end();
      return;
    }
    const passed = request(new URL(path.slice(prefix.length + 1), url), { method: asked.method, headers: asked.headers }, (told) => {
      answer.writeHead(told.statusCode ?? 500, told.headers);
      told.pipe(answer);
    });
    passed.on('error', () => answer.destroy());
    answer.on('close', () => passed.destroy());
    asked.pipe(passed);
  });
  await new Promise((resolve) => proxy.listen(0, '127.0.0.1', () => resolve(null)));
  const { port } = /** @type {import('node:net').AddressInfo} */ (proxy.address());
  const close = () => {
    proxy.close();
    proxy.closeAllConnections();
  };
  return { url: `http://127.0.0.1:${port}${prefix}/`, close };
}

/** @param {import('playwright-core').Page} page @param {string} url */
async function looksAtTheBoard(page, url) {
  const place = new URL('jobs', url).pathname;
  await page.goto(`${url}jobs`);
  await page.getByText('welkin', { exact: false }).first().waitFor();
  for (const view of ['tasks', 'workers', 'queues']) {
    const link = page.locator(`a[href="/${view}"]`).first();
    await link.click();
    await page.waitForFunction((at) => location.pathname === at, `${place}/${view}`);
  }
  await page.reload();
  await page.getByText('welkin', { exact: false }).first().waitFor();
  assert.equal(new URL(page.url()).pathname, `${place}/queues`);
}

test('the board under /jobs shows tasks and workers, behind a proxy too', () =>
  open(
    async (page, server) => {
      const id = await send(server.url, { frames: { kind: 'list', scenes: [{ clouds: null }] }, ...small });
      for (let state = ''; state !== 'done'; ) {
        state = (await (await fetch(`${server.url}v1/jobs/${id}`)).json()).state;
        await new Promise((resolve) => setTimeout(resolve, 200));
      }
      await looksAtTheBoard(page, server.url);
      const proxy = await behindPrefix(server.url, '/skies');
      try {
        await looksAtTheBoard(page, proxy.url);
      } finally {
        proxy.close();
      }
    },
    { logs: /./, proxied: /^http:\/\/127\.0\.0\.1:\d+\/skies\// },
  ));
