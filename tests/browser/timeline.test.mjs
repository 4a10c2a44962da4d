/** Timelines without a page: keyframes as patches, the player, the axis, and what goes over the socket. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { createSync } from '../../web/src/sync.js';
import { ticks, timeText } from '../../web/src/timeline/axis.js';
import { difference, EMPTY, indexAt, moved, parseTimeline, withKeyframe, withoutKeyframe } from '../../web/src/timeline/document.js';
import { createPlayer } from '../../web/src/timeline/player.js';

const SCENE = {
  time_s: 0, haze: null, sun: { position: { azimuth_deg: 180, elevation_deg: 35 }, disc: true },
  clouds: { coverage: 0.5, wind: { drift_m: [0, 0, 0], speed_m_s: 8 }, weather_map: { kind: 'procedural', extent_m: 6e4, seed: null } },
};

test('a patch says what differs, switches off with null, and replaces another kind', () => {
  const other = {
    ...SCENE, haze: { top_m: 1 }, sun: { ...SCENE.sun, position: { time: 'x' } },
    clouds: { ...SCENE.clouds, weather_map: { kind: 'asset', name: 'front' } },
  };
  assert.deepEqual(difference(SCENE, other), {
    haze: { top_m: 1 }, sun: { position: { azimuth_deg: null, elevation_deg: null, time: 'x' } },
    clouds: { weather_map: { kind: 'asset', name: 'front' } },
  });
  assert.deepEqual(difference(SCENE, { ...SCENE, clouds: null }), { clouds: null });
  assert.deepEqual(difference(SCENE, SCENE), {});
});

test('the first keyframe is the scene; the clock is left to run', () => {
  const first = withKeyframe(EMPTY, 0, SCENE);
  assert.deepEqual(first, { scene: SCENE, keyframes: [{ at_s: 0, patch: {} }] });
  const later = { ...SCENE, time_s: 7, clouds: { ...SCENE.clouds, coverage: 0.9, wind: { ...SCENE.clouds.wind, drift_m: [5, 5, 5] } } };
  const second = withKeyframe(first, 7, later);
  assert.deepEqual(second.keyframes[1], { at_s: 7, patch: { clouds: { coverage: 0.9 } } });
  assert.deepEqual(withKeyframe(second, 3, SCENE).keyframes.map((key) => key.at_s), [0, 3, 7]);
  assert.deepEqual(withKeyframe(second, 7.001, SCENE).keyframes[1], { at_s: 7.001, patch: {} }, 'in place of what was there');
  assert.equal(withKeyframe(EMPTY, 5, { ...SCENE, time_s: 12 }).scene.time_s, 7, 'at 5 s it is 12 s');
});

test('keyframes move past one another, and never to the same time', () => {
  const timeline = { scene: {}, keyframes: [0, 2, 4].map((at_s) => ({ at_s, patch: { a: at_s } })) };
  const past = moved(timeline, 0, 3);
  assert.deepEqual([past.index, past.timeline.keyframes.map((key) => key.patch.a)], [1, [2, 0, 4]]);
  assert.deepEqual(moved(timeline, 1, 4).timeline.keyframes.map((key) => key.at_s), [0, 4, 4.01]);
  assert.equal(moved(timeline, 2, -9).timeline.keyframes[1].at_s, 0.01, 'nothing is before the beginning');
  assert.deepEqual(withoutKeyframe(timeline, 1).keyframes.map((key) => key.at_s), [0, 4]);
  assert.equal(withoutKeyframe({ scene: SCENE, keyframes: [{ at_s: 0, patch: {} }] }, 0), EMPTY);
  assert.deepEqual([indexAt(timeline, 2.004), indexAt(timeline, 2.1)], [1, -1]);
});

test('a file is read, or it is said what is wrong with it', () => {
  const timeline = { scene: { time_s: 1 }, keyframes: [{ at_s: 0 }, { at_s: 2, patch: { time_s: 3 } }] };
  assert.deepEqual(parseTimeline(JSON.stringify(timeline)).keyframes, [{ at_s: 0, patch: {} }, { at_s: 2, patch: { time_s: 3 } }]);
  for (const [text, reason] of /** @type {const} */ ([
    ['{', /not JSON/], ['[]', /object/], ['{}', /keyframes/], ['{"keyframes": []}', /one keyframe/], ['{"scene": 1, "keyframes": [{"at_s": 1}]}', /scene/],
    ['{"keyframes": [{"at_s": 1}, {}]}', /keyframe 2/], ['{"keyframes": [{"at_s": 1, "patch": 3}]}', /patch of keyframe 1/],
  ])) assert.throws(() => parseTimeline(text), reason, text);
});

/** @param {number[]} times */
function playerOf(times) {
  const clock = { ms: 0 };
  const player = createPlayer(() => clock.ms);
  player.load({ scene: {}, keyframes: times.map((at_s) => ({ at_s, patch: {} })) });
  return { clock, player, after: (/** @type {number} */ ms) => ((clock.ms += ms), player.moment()?.at_s) };
}

test('playing goes on with the clock, at its speed, round and round', () => {
  const { player, after } = playerOf([0, 4, 10]);
  assert.equal(after(500), undefined, 'the page’s own scene at first');
  player.play();
  assert.equal(after(2000), 2);
  player.setSpeed(2);
  assert.equal(after(1500), 5);
  assert.equal(after(3000), 1, 'looped at the last keyframe');
  player.pause();
  assert.equal(after(9000), 1);
  player.setLoop(false);
  player.play();
  assert.equal(after(60_000), 10);
  assert.equal(player.isPlaying(), false);
  player.play();
  assert.equal(after(500), 1, 'from the beginning again');
  player.leave();
  assert.equal(after(1), undefined);
});

test('one keyframe is played for the whole axis; without any there is nothing to play', () => {
  const { player, after } = playerOf([0]);
  player.play();
  assert.equal(after(15_000), 15);
  player.load(EMPTY);
  assert.equal(after(1), undefined);
  player.play();
  assert.equal(player.isPlaying(), false);
});

test('a moment is shown where one seeks it; the axis is as long as its keyframes', () => {
  const { player, after } = playerOf([0, 35]);
  assert.equal(player.length_s, 35);
  player.seek(99);
  assert.equal(after(0), 35);
  player.setLength(10);
  assert.equal(player.length_s, 35);
});

test('ticks are as many as fit, at times that people count in', () => {
  assert.deepEqual(ticks(20, 12), { step: 2, times: [0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20] });
  assert.deepEqual([ticks(20, 4).step, ticks(86_400, 12).step, ticks(600, 10).step, ticks(1e6, 4).step], [5, 7200, 60, 259_200]);
  assert.deepEqual([0, 7.5, 67.5, 7200, 3661.25, 59.999].map(timeText), ['0', '7.5', '1:07.5', '2:00:00', '1:01:01.25', '1:00']);
});

test('a timeline is sent once, then its moments; leaving it tells the whole scene', () => {
  /** @type {any[]} */
  const sent = [];
  const timeline = { scene: {}, keyframes: [] };
  /** @type {any} */
  let moment = null;
  const sync = createSync((message) => sent.push(message), () => ({ a: 1 }), () => moment);
  sync.flush();
  moment = { timeline, at_s: 1 };
  sync.flush();
  assert.equal(sync.flush(), false);
  moment = { timeline, at_s: 2 };
  sync.flush();
  moment = { timeline: { ...timeline }, at_s: 2 };
  sync.flush();
  moment = null;
  sync.flush();
  moment = { timeline, at_s: 2 };
  sync.forget();
  sync.flush();
  assert.deepEqual(sent.map(({ seq, ...rest }) => rest), [
    { scene: { a: 1 } }, { timeline, at_s: 1 }, { at_s: 2 }, { timeline, at_s: 2 }, { scene: { a: 1 } }, { timeline, at_s: 2 },
  ]);
});
