/** The schema's tree, documents in full and in short, and their form in an address. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { complete, initialVariant, minimal } from '../../web/src/document.js';
import { fromHash, toHash } from '../../web/src/hash.js';
import { variantNode, variantOf } from '../../web/src/schema.js';
import { root } from './fixture.mjs';

const node = (/** @type {string} */ key) => {
  const found = root.properties?.find((p) => p.key === key)?.node;
  assert.ok(found, key);
  return found;
};
const DEFAULT = {
  time_s: 0,
  sun: { position: { azimuth_deg: 180, elevation_deg: 35 }, disc: true },
  air: { height_m: 100, ozone: { centre_m: 25 }, colour: [1, 2, 3], method: 'lut' },
  fog: null,
  lens: { kind: 'narrow', fov_deg: 60 },
  mist: 4e-6,
  steps: null,
  lamps: [],
};
const SHORT_DOCUMENTS = [
  {},
  { sun: { position: { azimuth_deg: 200.5, elevation_deg: -3 } } },
  { sun: { position: [1, 2, 3] }, time_s: 1e9 },
  { sun: { position: { time: '2026-06-21T05:00:00Z' } } },
  { air: null },
  { air: { ozone: null, colour: [1e-6, 0, 2] } },
  { fog: {} },
  { fog: { centre_m: 7 }, lens: { kind: 'whole' } },
  { lens: { kind: 'round', fov_deg: 200, mapping: 'b' } },
  { mist: [1e-6, 0, 2e-5], steps: 32 },
  { mist: 0 },
  { lamps: [{ centre_m: 1 }, { centre_m: 2 }] },
];

test('the tree has a node for each shape', () => {
  const kinds = Object.fromEntries((root.properties ?? []).map((p) => [p.key, [p.node.type, p.node.nullable]]));
  assert.deepEqual(kinds, {
    time_s: ['number', false], sun: ['object', false], air: ['object', true], fog: ['object', true],
    lens: ['variant', false], mist: ['bands', false], steps: ['number', true], lamps: ['list', false],
  });
  const { minimum, maximum, length, unit } = node('mist');
  assert.deepEqual({ minimum, maximum, length, unit }, { minimum: 0, maximum: 0.1, length: 3, unit: '1/m' });
  assert.deepEqual([node('time_s').title, node('time_s').unit], ['Time', 's']);
  assert.equal(node('sun').description, 'The sun.');
  const method = node('air').properties?.find((p) => p.key === 'method')?.node;
  assert.deepEqual(method?.options, [{ value: 'lut', description: 'Tables.' }, { value: 'nested', description: '' }]);
  assert.equal(node('air').properties?.find((p) => p.key === 'colour')?.node.length, 3);
});

test('an unknown type is an error, not a missing field', async () => {
  const { readSchema } = await import('../../web/src/schema.js');
  assert.throws(() => readSchema({ type: 'object', properties: { x: { type: 'wave' } } }), /wave/);
});

test('nested alternatives without a tag are told apart by shape', () => {
  const position = node('sun').properties?.find((p) => p.key === 'position')?.node;
  assert.ok(position);
  assert.deepEqual(position.variants?.map((v) => v.name), ['Azimuth and elevation', 'East, north, up', 'Time'].map((n) => n.split(',')[0]));
  assert.equal(variantOf(position, { azimuth_deg: 1, elevation_deg: 2 }), 0);
  assert.equal(variantOf(position, [1, 2, 3]), 1);
  assert.equal(variantOf(position, { time: '' }), 2);
  assert.equal(variantNode(position, 0).properties?.[1].node.initial, 35, 'the whole default gives the fields theirs');
});

test('variants start from their own defaults', () => {
  assert.deepEqual(initialVariant(node('lens'), 0), { kind: 'narrow', fov_deg: 60 });
  assert.deepEqual(initialVariant(node('lens'), 1), { kind: 'round', fov_deg: 180, mapping: 'a' });
  assert.deepEqual(initialVariant(node('lens'), 2), { kind: 'whole' });
});

test('an empty document is the default scene', () => {
  assert.deepEqual(complete(root, {}), DEFAULT);
  assert.equal(minimal(root, DEFAULT), undefined);
});

test('missing fields are filled, unknown ones stay for the server to refuse', () => {
  assert.deepEqual(complete(root, { fog: {}, clouds: 1 }), { ...DEFAULT, fog: { centre_m: 25 }, clouds: 1 });
  assert.deepEqual(complete(root, { lens: { kind: 'round' } }).lens, { kind: 'round', fov_deg: 180, mapping: 'a' });
});

for (const short of SHORT_DOCUMENTS) {
  test(`short, full and in the address: ${JSON.stringify(short)}`, () => {
    const full = complete(root, short);
    assert.deepEqual(minimal(root, full) ?? {}, short);
    assert.deepEqual(fromHash(toHash(short)), short);
    assert.doesNotMatch(toHash(short), /[\s"<>`{}]/, 'nothing that a browser or a mail program rewrites');
  });
}

test('the address is short and readable', () => {
  assert.equal(toHash({ sun: { position: { azimuth_deg: 200, elevation_deg: 5 } } }), '#sun.position.azimuth_deg=200&sun.position.elevation_deg=5');
  assert.equal(toHash({ air: null, time: '2026-06-21T05:00:00Z' }), '#air=null&time=2026-06-21T05:00:00Z');
});

test('texts that look like JSON stay texts', () => {
  for (const text of ['null', '12', 'true', '"', '{}', '', 'a&b=c#d', 'ü %']) assert.deepEqual(fromHash(toHash({ name: text })), { name: text });
});

test('names keep their dots and signs', () => {
  const odd = { 'a.b': { 'c=d': 1 } };
  assert.deepEqual(fromHash(toHash(odd)), odd);
});

test('a broken address says what is broken', () => {
  for (const hash of ['#sun', '#=1', '#a=[1,2', '#a=1&a.b=2', '#a..b=1', '#__proto__.x=1', '#a=%E0%A4%A']) assert.throws(() => fromHash(hash), Error, hash);
  assert.equal(/** @type {any} */ ({}).x, undefined);
});
