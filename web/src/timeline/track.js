/** The time axis with its keyframes: they are dragged, or moved by keys. */
import { byId, h } from '../dom.js';
import { clamp } from '../vector.js';
import { spokenTime, ticks, timeText } from './axis.js';
import { indexAt, moved, withoutKeyframe } from './document.js';

const PX_PER_TICK = 64;
/** A press that moves less than this is a click, CSS pixels. */
const STILL_PX = 3;
/** What the keys move a keyframe by, of the axis; with Shift a tenth. */
const KEY_SHARE = 0.02;

/**
 * @param {import('./player.js').Player} player
 * @param {(timeline: import('./document.js').Timeline) => void} edit @param {(at_s: number) => void} seek
 */
export function createTrack(player, edit, seek) {
  const [axis, keys] = [byId('timeline-axis', HTMLElement), byId('timeline-keys', HTMLElement)];
  /** @type {HTMLButtonElement[]} */
  let handles = [];
  /** The keyframe under the hand. */
  let held = -1;
  let shownAxis = '';

  const move = (/** @type {number} */ index, /** @type {number} */ at_s) => {
    const next = moved(player.timeline, index, clamp(at_s, 0, player.length_s));
    edit(next.timeline);
    return next.index;
  };
  const timeAt = (/** @type {MouseEvent} */ event) => {
    const { left, width } = keys.getBoundingClientRect();
    return ((event.clientX - left) / width) * player.length_s;
  };
  const remove = (/** @type {number} */ index) => {
    edit(withoutKeyframe(player.timeline, index));
    update();
    (handles[Math.min(index, handles.length - 1)] ?? byId('timeline-add', HTMLButtonElement)).focus();
  };

  const createHandle = (/** @type {number} */ i) => {
    const handle = h('button', { type: 'button', class: 'keyframe', role: 'slider', 'aria-valuemin': 0 });
    let startPx = 0;
    let isMoving = false;
    handle.addEventListener('pointerdown', (event) => {
      if (event.button !== 0) return;
      handle.setPointerCapture(event.pointerId);
      [held, startPx, isMoving] = [i, event.clientX, false];
    });
    handle.addEventListener('pointermove', (event) => {
      if (held < 0 || !handle.hasPointerCapture(event.pointerId)) return;
      isMoving ||= Math.abs(event.clientX - startPx) > STILL_PX;
      if (isMoving) held = move(held, timeAt(event));
    });
    const end = () => (held = -1);
    handle.addEventListener('pointerup', end);
    handle.addEventListener('pointercancel', end);
    handle.addEventListener('click', () => {
      if (!isMoving) seek(player.timeline.keyframes[i].at_s);
      isMoving = false;
    });
    handle.addEventListener('keydown', (event) => {
      const step = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
      if (step) {
        const next = move(i, player.timeline.keyframes[i].at_s + step * player.length_s * KEY_SHARE * (event.shiftKey ? 0.1 : 1));
        update();
        handles[next].focus();
      } else if (event.key === 'Delete' || event.key === 'Backspace') remove(i);
      else return;
      event.preventDefault();
      event.stopPropagation();
    });
    return handle;
  };

  const showAxis = () => {
    const { times } = ticks(player.length_s, Math.max(axis.clientWidth / PX_PER_TICK, 1));
    const text = times.join();
    if (text === shownAxis) return;
    shownAxis = text;
    axis.replaceChildren(
      ...times.map((at_s) => {
        const tick = h('span', {}, timeText(at_s));
        tick.style.left = `${(100 * at_s) / player.length_s}%`;
        return tick;
      }),
    );
  };

  function update() {
    const { keyframes } = player.timeline;
    if (handles.length !== keyframes.length) {
      handles = keyframes.map((_, i) => createHandle(i));
      keys.replaceChildren(...handles);
    }
    const current = indexAt(player.timeline, player.at());
    keyframes.forEach(({ at_s }, i) => {
      const handle = handles[i];
      handle.style.left = `${clamp(at_s / player.length_s, 0, 1) * 100}%`;
      const attributes = { 'aria-label': `Keyframe ${i + 1}`, 'aria-valuemax': player.length_s, 'aria-valuenow': at_s, 'aria-valuetext': spokenTime(at_s), 'aria-current': i === current, title: `${timeText(at_s)} s` };
      for (const [name, value] of Object.entries(attributes)) handle.setAttribute(name, String(value));
    });
    showAxis();
  }
  return { update, remove };
}
