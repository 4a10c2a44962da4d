/** Patches, pointers, and what is sent when. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { equal, isObject, mergePatch } from '../../web/src/json.js';
import { getAt, setAt } from '../../web/src/pointer.js';
import { createSync } from '../../web/src/sync.js';
import { createRandom } from './random.mjs';

/** RFC 7396, section 2. @param {any} target @param {any} patch @returns {any} */
function apply(target, patch) {
  if (!isObject(patch)) return patch;
  const result = isObject(target) ? { ...target } : {};
  for (const [key, value] of Object.entries(patch)) {
    if (value === null) delete result[key];
    else result[key] = apply(result[key], value);
  }
  return result;
}

const clone = (/** @type {any} */ v) => JSON.parse(JSON.stringify(v));

test('a patch holds the change and no more', () => {
  assert.deepEqual(mergePatch({ a: { b: 1, c: 2 }, d: [1] }, { a: { b: 1, c: 3 }, d: [1] }), { a: { c: 3 } });
  assert.deepEqual(mergePatch({ k: { kind: 'x', u: 1 } }, { k: { kind: 'y', v: 2 } }), { k: { u: null, kind: 'y', v: 2 } });
  assert.deepEqual(mergePatch({ p: [1, 2, 3] }, { p: [1, 2, 4] }), { p: [1, 2, 4] });
  assert.deepEqual(mergePatch({ a: null }, { a: { b: 1 } }), { a: { b: 1 } });
});

test('null cannot be patched in', () => {
  assert.equal(mergePatch({ a: { b: 1 } }, { a: null }), null);
  assert.equal(mergePatch({ a: null }, { a: { b: null } }), null);
  assert.equal(mergePatch({ a: { b: { c: 1 } } }, { a: { b: { c: null } } }), null);
});

test('any patch leads to what it was made for', () => {
  const random = createRandom(3);
  /** @param {number} depth @returns {any} */
  const value = (depth) => {
    const pick = random.unit();
    if (depth === 0 || pick < 0.3) return pick < 0.05 ? null : Math.round(random.between(0, 3));
    if (pick < 0.4) return [1, null, { a: 1 }].slice(0, Math.round(random.between(0, 3)));
    return Object.fromEntries(['a', 'b', 'c'].filter(() => random.unit() < 0.7).map((key) => [key, value(depth - 1)]));
  };
  let possible = 0;
  for (let i = 0; i < 3000; i++) {
    const [from, to] = [{ x: value(3) }, { x: value(3) }];
    const patch = mergePatch(from, to);
    if (patch === null) continue;
    possible += 1;
    assert.deepEqual(apply(clone(from), patch), to);
  }
  assert.ok(possible > 1000, `only ${possible} of 3000 pairs had a patch`);
});

test('pointers reach into objects and lists, and escape', () => {
  const scene = { 'a/b': [{ 'c~d': 1 }] };
  assert.equal(getAt(scene, '/a~1b/0/c~0d'), 1);
  assert.deepEqual(setAt(scene, '/a~1b/0/c~0d', 2), { 'a/b': [{ 'c~d': 2 }] });
  assert.deepEqual(scene, { 'a/b': [{ 'c~d': 1 }] }, 'the old value stays');
  assert.equal(getAt(scene, '/toString'), undefined);
  assert.ok(equal([1, { a: [null] }], [1, { a: [null] }]) && !equal({ a: 1 }, { a: 1, b: 2 }) && !equal([], {}));
});

function harness() {
  const state = { scene: /** @type {any} */ ({ a: 1, b: 1 }), sent: /** @type {any[]} */ ([]) };
  return { state, sync: createSync((message) => state.sent.push(message), () => state.scene) };
}

test('first the scene and the output, then patches, then silence', () => {
  const { state, sync } = harness();
  sync.want({ width_px: 10 });
  assert.equal(sync.flush(), true);
  assert.equal(sync.flush(), false);
  state.scene = { a: 2, b: 1 };
  state.scene = { a: 3, b: 1 };
  sync.flush();
  sync.want({ width_px: 20 });
  sync.flush();
  assert.deepEqual(state.sent, [
    { seq: 1, scene: { a: 1, b: 1 }, output: { width_px: 10 } },
    { seq: 2, patch: { a: 3 } },
    { seq: 3, output: { width_px: 20 } },
  ]);
});

test('a new connection is told everything', () => {
  const { state, sync } = harness();
  sync.flush();
  sync.forget();
  sync.flush();
  assert.deepEqual(state.sent.map((m) => m.scene), [{ a: 1, b: 1 }, { a: 1, b: 1 }]);
});

test('after a refusal the whole scene goes out, but never the refused one again', () => {
  const { state, sync } = harness();
  sync.flush();
  sync.confirm(1);
  state.scene = { a: -5, b: 1 };
  sync.flush();
  assert.deepEqual(sync.refuse(2), { a: -5, b: 1 });
  assert.equal(sync.flush(), false, 'the same scene would be refused again');
  assert.deepEqual(sync.accepted, { a: 1, b: 1 });
  state.scene = sync.accepted;
  sync.flush();
  assert.deepEqual(state.sent.at(-1), { seq: 3, scene: { a: 1, b: 1 } });
});
