/**
 * Scene documents in full and in short. The server fills what a document leaves out with defaults; these functions do
 * the same from the schema, so that the page holds every value and shows only what differs.
 */
import { equal, isObject } from './json.js';
import { variantNode, variantOf } from './schema.js';

/** @typedef {import('./schema.js').Node} Node */

/** What a part holds when a document does not name it. @param {Node} node @returns {any} */
export function initial(node) {
  if (node.initial !== undefined) return node.initial === null ? null : complete({ ...node, initial: undefined }, node.initial);
  switch (node.type) {
    case 'object':
      return Object.fromEntries((node.properties ?? []).map(({ key, node: inner }) => [key, initial(inner)]));
    case 'variant':
      return initialVariant(node, 0);
    case 'numbers':
      return Array.from({ length: node.length ?? 0 }, () => initial(/** @type {Node} */ (node.items)));
    case 'number':
    case 'bands':
      return Math.min(Math.max(0, node.minimum ?? -Infinity), node.maximum ?? Infinity);
    case 'choice':
      return node.options?.[0].value;
    case 'list':
      return [];
    case 'boolean':
      return false;
    default:
      return '';
  }
}

/** @param {Node} node @param {number} index @returns {any} */
export function initialVariant(node, index) {
  const { kind } = /** @type {import('./schema.js').Variant[]} */ (node.variants)[index];
  const value = initial(variantNode(node, index));
  return kind === undefined ? value : { kind, ...value };
}

/** Fills what is missing. What the schema does not know stays, for the server to refuse by name.
 * @param {Node} node @param {any} value @returns {any} */
export function complete(node, value) {
  if (value === undefined) return initial(node);
  if (node.type === 'object' && isObject(value)) {
    const known = (node.properties ?? []).map(({ key, node: inner }) => [key, complete(inner, value[key])]);
    return { ...value, ...Object.fromEntries(known) };
  }
  if (node.type === 'variant') {
    const { node: inner } = /** @type {import('./schema.js').Variant[]} */ (node.variants)[variantOf(node, value)];
    return complete(inner, value);
  }
  if (node.type === 'list' && Array.isArray(value)) return value.map((v) => complete(/** @type {Node} */ (node.items), v));
  return value;
}

/**
 * The shortest document that means the same: `complete(node, minimal(node, v))` is `v`. Undefined where nothing
 * differs from the default. A variant is named whole, since its tag tells what the rest means.
 * @param {Node} node @param {any} value @returns {any}
 */
export function minimal(node, value) {
  if (equal(value, initial(node))) return undefined;
  if (node.type !== 'object' || !isObject(value)) return value;
  const entries = Object.entries(value).map(([key, v]) => {
    const inner = node.properties?.find((p) => p.key === key)?.node;
    return [key, inner ? minimal(inner, v) : v];
  });
  return Object.fromEntries(entries.filter(([, v]) => v !== undefined));
}
