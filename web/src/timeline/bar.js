/** The timeline's bar: play, scrub, keyframes, length, speed, files. */
import { byId, h } from '../dom.js';
import { announce, toast } from '../toast.js';
import { spokenTime, timeText } from './axis.js';
import { EMPTY, indexAt, MOST_KEYFRAMES, parseTimeline, tidy, withKeyframe } from './document.js';
import { createTrack } from './track.js';

/** How far behind the last keyframe the next one is offered, of the axis. */
const NEXT_SHARE = 0.25;

/** @param {import('../store.js').Store} store @param {import('./player.js').Player} player */
export function createTimelineBar(store, player) {
  const bar = byId('timeline', HTMLElement);
  const toggle = byId('open-timeline', HTMLButtonElement);
  const button = (/** @type {string} */ id) => byId(`timeline-${id}`, HTMLButtonElement);
  const [play, add, remove, save, load, clear] = ['play', 'add', 'remove', 'save', 'load', 'clear'].map(button);
  const input = (/** @type {string} */ id) => byId(`timeline-${id}`, HTMLInputElement);
  const [scrub, length, loop, file] = ['scrub', 'length', 'loop', 'file'].map(input);
  const speed = byId('timeline-speed', HTMLSelectElement);
  const time = byId('timeline-time', HTMLOutputElement);
  const [hint, error] = [byId('timeline-hint', HTMLElement), byId('timeline-error', HTMLElement)];

  const edit = (/** @type {import('./document.js').Timeline} */ next) => {
    error.hidden = true;
    player.load(next);
    if (player.isShown()) player.seek(player.at());
    update();
  };
  const seek = (/** @type {number} */ at_s) => {
    player.seek(at_s);
    update();
  };
  const track = createTrack(player, edit, seek);

  const show = (/** @type {boolean} */ isShown) => {
    bar.hidden = !isShown;
    toggle.setAttribute('aria-expanded', String(isShown));
    if (!isShown) player.leave();
    update();
  };
  const playOrPause = () => {
    if (player.isPlaying()) player.pause();
    else if (player.timeline.keyframes.length === 0) return announce('The timeline has no keyframes yet.');
    else {
      if (bar.hidden) show(true);
      player.play();
    }
    announce(player.isPlaying() ? 'Playing' : `Paused at ${spokenTime(player.at())}`);
    update();
  };
  const keep = () => {
    // What is kept is what is seen.
    const seen = player.isShown() ? player.shownAt() : null;
    if (seen !== null) player.seek(seen);
    const { keyframes } = player.timeline;
    const isThere = indexAt(player.timeline, player.at()) >= 0;
    if (!isThere && keyframes.length >= MOST_KEYFRAMES) return toast(`A timeline takes ${MOST_KEYFRAMES} keyframes at most.`, { bad: true });
    // A new keyframe at the end of what there is leads on from there.
    const at_s = isThere ? keyframes[indexAt(player.timeline, player.at())].at_s : tidy(player.at());
    player.pause();
    edit(withKeyframe(player.timeline, at_s, store.scene));
    announce(`Keyframe at ${spokenTime(at_s)} ${isThere ? 'set' : 'added'}.`);
    const isLast = player.timeline.keyframes.at(-1)?.at_s === at_s;
    if (!isThere && isLast) player.leave();
    if (!isThere && isLast) player.point(at_s + player.length_s * NEXT_SHARE);
    update();
  };

  toggle.addEventListener('click', () => show(Boolean(bar.hidden)));
  bar.querySelector('[data-close]')?.addEventListener('click', () => {
    show(false);
    toggle.focus();
  });
  play.addEventListener('click', playOrPause);
  add.addEventListener('click', keep);
  remove.addEventListener('click', () => track.remove(indexAt(player.timeline, player.at())));
  scrub.addEventListener('input', () => {
    player.pause();
    if (player.timeline.keyframes.length > 0) seek(scrub.valueAsNumber);
    else player.point(scrub.valueAsNumber);
    update();
  });
  speed.addEventListener('change', () => player.setSpeed(Number(speed.value)));
  loop.addEventListener('change', () => player.setLoop(loop.checked));
  length.addEventListener('change', () => {
    if (length.validity.valid && length.value !== '') player.setLength(length.valueAsNumber);
    update();
  });
  clear.addEventListener('click', () => {
    const before = player.timeline;
    player.point(0);
    edit(EMPTY);
    toast('The timeline is empty.', { action: { name: 'Undo', act: () => edit(before) } });
  });
  save.addEventListener('click', () => {
    const url = URL.createObjectURL(new Blob([JSON.stringify(player.timeline, null, 2)], { type: 'application/json' }));
    h('a', { href: url, download: 'welkin-timeline.json' }).click();
    setTimeout(() => URL.revokeObjectURL(url), 60_000);
  });
  load.addEventListener('click', () => file.click());
  file.addEventListener('change', async () => {
    const [chosen] = file.files ?? [];
    file.value = '';
    if (!chosen) return;
    try {
      const timeline = parseTimeline(await chosen.text());
      edit(timeline);
      seek(timeline.keyframes[0].at_s);
      announce(`A timeline of ${timeline.keyframes.length} keyframes.`);
    } catch (cause) {
      complain(/** @type {Error} */ (cause).message);
    }
  });
  // Who changes the scene leaves the timeline; what was changed can become a keyframe.
  store.subscribe((_, cause) => {
    if (cause === 'played' || !player.isShown()) return;
    player.leave();
    update();
  });

  const complain = (/** @type {string} */ message) => {
    error.textContent = message.charAt(0).toUpperCase() + message.slice(1);
    error.hidden = false;
    if (bar.hidden) show(true);
  };

  function update() {
    const [at_s, count] = [player.at(), player.timeline.keyframes.length];
    bar.dataset.playing = String(player.isPlaying());
    play.setAttribute('aria-label', player.isPlaying() ? 'Pause' : 'Play');
    if (bar.hidden) return;
    const current = indexAt(player.timeline, at_s);
    for (const needing of [play, save, clear]) needing.disabled = count === 0;
    remove.disabled = current < 0;
    add.textContent = current < 0 ? 'Add keyframe' : 'Set keyframe';
    scrub.max = String(player.length_s);
    scrub.valueAsNumber = at_s;
    scrub.style.setProperty('--filled', `${(100 * at_s) / player.length_s}%`);
    scrub.setAttribute('aria-valuetext', spokenTime(at_s));
    if (document.activeElement !== length) length.valueAsNumber = player.length_s;
    time.value = `${timeText(Number(at_s.toFixed(1)))} s`;
    hint.textContent = hintFor(count);
    track.update();
  }
  const hintFor = (/** @type {number} */ count) => {
    if (count === 0) return 'Set up a sky and add it as the first keyframe; then change it, and add the next.';
    if (count === 1) return 'Change the sky, and add it as the second keyframe.';
    return player.isShown() ? '' : 'The sky is your own, not the timeline’s: scrub or play to see that again.';
  };

  return {
    playOrPause,
    update,
    /** What the server will not play. @param {string} message */
    refused(message) {
      player.leave();
      complain(message);
      update();
    },
  };
}

/** @typedef {ReturnType<typeof createTimelineBar>} TimelineBar */
