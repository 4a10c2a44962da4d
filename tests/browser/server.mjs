/** Starts the real program on a free port, and stops it. */
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { mkdtemp, rm } from 'node:fs/promises';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const PROGRAM = process.env.WELKIN_BIN ?? fileURLToPath(new URL('../../target/release/welkin', import.meta.url));
/** The first start on a machine compiles all shaders in software. */
const START_MS = 60_000;

async function freePort() {
  const probe = createServer().listen(0, '127.0.0.1');
  await once(probe, 'listening');
  const { port } = /** @type {import('node:net').AddressInfo} */ (probe.address());
  probe.close();
  await once(probe, 'close');
  return port;
}

/** @param {string} url */
async function isReady(url) {
  try {
    return (await fetch(`${url}readyz`)).ok;
  } catch {
    return false;
  }
}

/** @param {string[]} [more] Further arguments */
export async function startServer(more = []) {
  const port = await freePort();
  const assets = await mkdtemp(join(tmpdir(), 'welkin-assets-'));
  const url = `http://127.0.0.1:${port}/`;
  /** @type {import('node:child_process').ChildProcess} */
  let child;
  let log = '';
  const start = async () => {
    child = spawn(PROGRAM, ['serve', '--listen', `127.0.0.1:${port}`, '--assets', assets, '--queue', `sqlite:${join(assets, 'jobs.db')}`, '--store', `file:${join(assets, 'results')}`, ...more], { stdio: ['ignore', 'pipe', 'pipe'] });
    child.on('error', (error) => (log += error.message));
    for (const stream of [child.stdout, child.stderr]) stream?.on('data', (data) => (log += data));
    for (const end = Date.now() + START_MS; !(await isReady(url)); await new Promise((r) => setTimeout(r, 100))) {
      if (child.exitCode === null && Date.now() < end) continue;
      child.kill('SIGKILL');
      throw new Error(`${PROGRAM} does not serve:\n${log}`);
    }
  };
  /** @param {NodeJS.Signals} signal */
  const stop = async (signal = 'SIGTERM') => {
    if (child.exitCode !== null || child.signalCode !== null) return;
    child.kill(signal);
    await once(child, 'exit');
  };
  await start();
  const end = async () => {
    await stop();
    await rm(assets, { recursive: true });
  };
  return { url, start, stop, end };
}
