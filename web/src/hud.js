/** The small print: state, time per pass, size, adapter, pictures a second while things move. */
import { byId, h } from './dom.js';
import { milliseconds } from './text.js';
import { announce } from './toast.js';

/** @typedef {'connecting' | 'preview' | 'final' | 'reconnecting'} State */

/** @type {Record<State, string>} */
const NAMES = { connecting: 'Connecting', preview: 'Refining', final: 'Final', reconnecting: 'Reconnecting' };
const RATE_WINDOW_MS = 1000;
/** A preview or two are not yet movement. */
const STILL = 3;

export function createHud() {
  const hud = byId('hud', HTMLDetailsElement);
  const slot = (/** @type {string} */ name) => /** @type {HTMLElement} */ (hud.querySelector(`[data-hud="${name}"]`));
  const [state, time, fps, size, adapter, passes] = ['state', 'time', 'fps', 'size', 'adapter', 'passes'].map(slot);
  /** @type {number[]} */
  let arrivals = [];
  const showRate = () => {
    const now = performance.now();
    arrivals = arrivals.filter((t) => now - t < RATE_WINDOW_MS);
    fps.textContent = arrivals.length > STILL ? `${arrivals.length} fps` : '';
  };
  setInterval(showRate, RATE_WINDOW_MS / 2);
  return {
    /** @param {State} next */
    setState(next) {
      const before = document.body.dataset.state;
      if (before === next) return;
      document.body.dataset.state = next;
      state.textContent = NAMES[next];
      if (next === 'reconnecting') announce('Connection lost. Reconnecting.');
      else if (before === 'reconnecting') announce('Connected again.');
    },
    /** @param {import('./protocol.js').FrameMessage} frame */
    frame({ pass, width, height }) {
      // Refinements are no movement.
      if (pass === 0) arrivals.push(performance.now());
      showRate();
      size.textContent = `${width} × ${height}`;
    },
    /** Passes whose results were kept are not among them. @param {{passes: {pass: string, ms: number}[], render_ms: number}} stats */
    times({ passes: times, render_ms }) {
      const kept = times.length === 0;
      time.textContent = kept ? 'kept' : milliseconds(render_ms);
      time.title = kept ? 'This picture had been rendered before' : 'From the order to the picture';
      if (kept) return passes.replaceChildren(h('dt', { class: 'note' }, 'Nothing was computed: this picture had been kept.'));
      const longest = Math.max(...times.map(({ ms }) => ms), 1);
      passes.replaceChildren(
        ...times.flatMap(({ pass, ms }) => [
          h('dt', {}, pass),
          h('meter', { min: 0, max: longest, value: ms, 'aria-hidden': 'true' }),
          h('dd', { 'data-pass': pass }, milliseconds(ms)),
        ]),
      );
    },
    /** Shows or hides the time of each pass. */
    toggle: () => (hud.open = !hud.open),
    /** @param {{adapter: string, driver: string, backend: string}} device */
    device(device) {
      adapter.textContent = device.adapter;
      adapter.title = `${device.adapter} · ${device.driver} · ${device.backend}`;
    },
  };
}

/** @typedef {ReturnType<typeof createHud>} Hud */
