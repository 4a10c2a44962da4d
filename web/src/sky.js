/** The frame loop: pictures and figures come in, changes of the scene go out, the page follows. */
import { complete } from './document.js';
import { connectLive } from './live.js';
import { getAt, setAt } from './pointer.js';
import { decodeFrame, isFinal, parseFrame } from './protocol.js';
import { createSync } from './sync.js';
import { compass, percent } from './text.js';

/** A page that was hidden does not make up for it. */
const LONGEST_STEP_MS = 250;
/** From this status on the scene is not to blame. */
const SERVER_FAULT = 500;
/** Pointers of what is wrong with a timeline or its moment. */
const OF_TIMELINE = /^\/(timeline|at_s)/;

/**
 * @param {object} parts
 * @param {import('./store.js').Store} parts.store
 * @param {import('./stage.js').Stage} parts.stage
 * @param {import('./sun.js').Sun} parts.sun
 * @param {import('./moon.js').Moon} parts.moon
 * @param {import('./hud.js').Hud} parts.hud
 * @param {import('./timeline/player.js').Player} parts.player
 * @param {(message: string) => void} parts.stopped Says why the server does not play the timeline
 * @param {(pointer: string, message: string) => void} parts.refused Shows why the server refused a scene
 */
export function createSky({ store, stage, sun, moon, hud, player, stopped, refused }) {
  const canvas = /** @type {HTMLCanvasElement} */ (document.getElementById('sky'));
  let changed = true;
  /** @type {number | null} */
  let exposure = null;
  let newest = 0;
  let shown = 0;

  const onFrame = async (/** @type {ArrayBuffer} */ buffer) => {
    const frame = parseFrame(buffer);
    const order = ++newest;
    sync.confirm(frame.seq);
    const picture = await decodeFrame(frame);
    if (order < shown) return picture.close();
    shown = order;
    stage.show(picture);
    hud.frame(frame);
    hud.setState(isFinal(frame) && frame.seq >= sync.seq ? 'final' : 'preview');
    Object.assign(canvas.dataset, { frames: order, seq: frame.seq, pass: frame.pass });
  };

  /** The field that was refused goes back to what the server last drew, and the rest of the scene stays. */
  const onError = (/** @type {number | null} */ seq, /** @type {any} */ problem) => {
    const pointer = (problem.pointer ?? '').replace(/^\/scene/, '');
    const message = (problem.detail ?? problem.title).replaceAll('`', '');
    if (OF_TIMELINE.test(pointer) || (player.isShown() && problem.status < SERVER_FAULT)) {
      if (seq !== null) sync.refuse(seq);
      return stopped(message);
    }
    const isOurs = seq !== null && problem.status < SERVER_FAULT && sync.refuse(seq);
    if (isOurs) {
      const good = sync.accepted && getAt(sync.accepted, pointer);
      if (!sync.accepted) store.load({}, 'refused');
      else store.replace(good === undefined ? sync.accepted : setAt(store.scene, pointer, good), 'refused');
    }
    refused(pointer, message);
  };
  /** The page follows the timeline. */
  const onMoment = (/** @type {number} */ at_s, /** @type {any} */ document) => {
    const scene = complete(store.root, document);
    player.showed(at_s);
    sync.showed(scene);
    store.replace(scene, 'played');
  };

  const onText = (/** @type {any} */ { seq, stats, error }) => {
    if (error) onError(seq, error);
    if (!stats) return;
    hud.times(stats);
    sun.report(stats.sun);
    moon.report(stats.moon);
    exposure = stats.ev100;
    if (stats.scene && player.isShown()) onMoment(stats.at_s, stats.scene);
    changed = true;
  };

  const live = connectLive(new URL('v1/live', document.baseURI.replace(/^http/, 'ws')).href, {
    opened() {
      sync.forget();
      hud.setState('preview');
    },
    lost: () => hud.setState('reconnecting'),
    text: onText,
    binary: onFrame,
  });
  const sync = createSync(live.send, () => store.scene, player.moment);
  store.subscribe(() => (changed = true));
  window.addEventListener('resize', () => (changed = true));

  const describe = () => {
    const [angles, place] = [sun.angles(), moon.place()];
    if (!angles) return;
    const where = (/** @type {import('./vector.js').Angles} */ { azimuth_deg, elevation_deg }) => {
      const height = `${Math.abs(elevation_deg).toFixed(0)} degrees ${elevation_deg < 0 ? 'below' : 'above'} the horizon`;
      return `${height} in the ${compass(azimuth_deg)}, azimuth ${azimuth_deg.toFixed(0)} degrees.`;
    };
    const lit = place?.illuminated_fraction;
    const ofMoon = place && lit !== undefined ? ` Moon ${percent(lit)} lit, ${where(place)}` : '';
    canvas.setAttribute('aria-label', `The sky. Sun ${where(angles)}${ofMoon}`);
  };

  return {
    exposure: () => exposure,
    /**
     * @param {{update: () => void}[]} followers What shows the scene
     * @param {(seconds: number) => void} step What changes it as time goes by
     */
    run(followers, step) {
      let last = performance.now();
      const tick = () => {
        const now = performance.now();
        step(Math.min(now - last, LONGEST_STEP_MS) / 1000);
        last = now;
        if (changed || player.isPlaying()) {
          changed = false;
          stage.setProjection(store.scene.camera.projection.kind);
          stage.resize();
          sync.want({ ...stage.size(), format: 'jpeg', quality: 'final' });
          for (const follower of followers) follower.update();
          describe();
        }
        if (live.isOpen() && sync.flush()) hud.setState('preview');
        requestAnimationFrame(tick);
      };
      tick();
    },
  };
}
