/**
 * Reads the scene's JSON Schema (2020-12, as schemars writes it) into a tree of nodes that the panel and the URL walk.
 */
import { isObject } from './json.js';

/**
 * @typedef {object} Node
 * @property {'object' | 'number' | 'numbers' | 'bands' | 'list' | 'choice' | 'boolean' | 'text' | 'variant'} type
 * @property {string} title
 * @property {string} unit
 * @property {string} description
 * @property {boolean} nullable May be null: the part is off.
 * @property {any} [initial] The schema's default.
 * @property {number} [minimum]
 * @property {number} [maximum]
 * @property {boolean} [integer]
 * @property {number} [length] Of `numbers` and `bands`.
 * @property {Property[]} [properties] Of `object`.
 * @property {Node} [items] Of `numbers`, `bands` and `list`.
 * @property {number} [most] Of `list`: how many items it may have.
 * @property {{value: string, description: string}[]} [options] Of `choice`.
 * @property {Variant[]} [variants] Of `variant`.
 */
/** @typedef {{key: string, node: Node}} Property */
/** @typedef {{name: string, kind: string | undefined, node: Node}} Variant `kind` is the tag, where there is one. */

/** @param {any} schema The root document @returns {Node} */
export function readSchema(schema) {
  /** @param {any} s @returns {any} */
  const resolve = (s) => {
    if (!s.$ref) return s;
    const { $ref, ...beside } = s;
    return { ...resolve(schema.$defs[$ref.slice('#/$defs/'.length)]), ...beside };
  };
  return readNode(schema, resolve);
}

/** @param {any} unresolved @param {(s: any) => any} resolve @returns {Node} */
function readNode(unresolved, resolve) {
  const s = resolve(unresolved);
  const alternatives = s.anyOf ?? s.oneOf;
  const isNull = (/** @type {any} */ a) => a.type === 'null';
  if (alternatives?.some(isNull)) {
    const rest = alternatives.filter((/** @type {any} */ a) => !isNull(a));
    const { anyOf, oneOf, ...beside } = s;
    const inner = rest.length === 1 ? { ...resolve(rest[0]), ...beside } : { ...beside, anyOf: rest };
    return { ...readNode(inner, resolve), nullable: true };
  }
  const nullable = Array.isArray(s.type) && s.type.includes('null');
  const type = Array.isArray(s.type) ? s.type.find((/** @type {string} */ t) => t !== 'null') : s.type;
  const common = {
    title: s.title ?? '',
    unit: s['x-unit'] ?? '',
    description: s.description ?? '',
    nullable,
    ...(s.default === undefined ? {} : { initial: s.default }),
  };
  if (s.enum) return { ...common, type: 'choice', options: s.enum.map((/** @type {string} */ value) => ({ value, description: '' })) };
  if (alternatives) return { ...common, ...readAlternatives(alternatives, resolve) };
  switch (type) {
    case 'object':
      return { ...common, type: 'object', properties: readProperties(s.properties ?? {}, resolve) };
    case 'number':
    case 'integer':
      return { ...common, type: 'number', minimum: s.minimum, maximum: s.maximum, integer: type === 'integer' };
    case 'array': {
      const items = readNode(s.items ?? s.prefixItems[0], resolve);
      const fixed = items.type === 'number' && s.minItems !== undefined && s.minItems === s.maxItems;
      return fixed ? { ...common, type: 'numbers', length: s.minItems, items } : { ...common, type: 'list', items, most: s.maxItems };
    }
    case 'boolean':
      return { ...common, type: 'boolean' };
    case 'string':
      return { ...common, type: 'text' };
    default:
      throw new Error(`the scene's schema holds a type that this page does not know: ${JSON.stringify(s)}`);
  }
}

/** A tag is a constant: nothing to edit. @param {any} properties @param {(s: any) => any} resolve @returns {Property[]} */
function readProperties(properties, resolve) {
  return Object.entries(properties)
    .filter(([, s]) => s.const === undefined)
    .map(([key, s]) => ({ key, node: readNode(s, resolve) }));
}

/** @param {any[]} alternatives @param {(s: any) => any} resolve @returns {any} */
function readAlternatives(alternatives, resolve) {
  const flat = alternatives.map(resolve).flatMap((a) => (a.anyOf ? a.anyOf.map(resolve) : [a]));
  if (flat.every((a) => a.const !== undefined || a.enum)) {
    const options = flat.flatMap((a) =>
      (a.enum ?? [a.const]).map((/** @type {string} */ value) => ({ value, description: a.description ?? '' })),
    );
    return { type: 'choice', options };
  }
  const [one, three] = flat;
  if (flat.length === 2 && one.type === 'number' && three.type === 'array') {
    return { type: 'bands', minimum: one.minimum, maximum: one.maximum, length: three.minItems, items: readNode(three.items, resolve) };
  }
  const variants = flat.map((a) => {
    const kind = a.properties?.kind?.const;
    return { kind, name: kind ?? variantName(a), node: readNode(a, resolve) };
  });
  return { type: 'variant', variants };
}

/** The first words of the description name an untagged variant. @param {any} s */
const variantName = (s) => (s.description ?? s.type).split(/[.;,:]/)[0];

/**
 * A variant's node. Where the whole part's default is of this variant, its members are the defaults of the fields.
 * @param {Node} node @param {number} index @returns {Node}
 */
export function variantNode(node, index) {
  const { node: inner } = /** @type {Variant[]} */ (node.variants)[index];
  const whole = node.initial;
  if (whole === undefined || whole === null || variantOf(node, whole) !== index) return inner;
  const withDefault = (/** @type {Property} */ { key, node: n }) => ({ key, node: key in whole ? { ...n, initial: whole[key] } : n });
  return { ...inner, initial: whole, properties: inner.properties?.map(withDefault) };
}

/** The variant that a value has the shape of. @param {Node} node @param {any} value */
export function variantOf(node, value) {
  const variants = node.variants ?? [];
  const index = variants.findIndex(({ kind, node: inner }) => {
    if (kind !== undefined) return value?.kind === kind;
    if (inner.type === 'numbers' || inner.type === 'list') return Array.isArray(value);
    if (inner.type === 'object') return isObject(value) && Object.keys(value).every((k) => inner.properties?.some((p) => p.key === k));
    return typeof value === (inner.type === 'number' ? 'number' : 'string');
  });
  return Math.max(index, 0);
}
