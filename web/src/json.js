/** Comparison of plain JSON values, and the patch that leads from one to another. */

/** @param {any} v */
export const isObject = (v) => v !== null && typeof v === 'object' && !Array.isArray(v);

/** @param {any} a @param {any} b @returns {boolean} */
export function equal(a, b) {
  if (Object.is(a, b)) return true;
  if (Array.isArray(a) && Array.isArray(b)) return a.length === b.length && a.every((v, i) => equal(v, b[i]));
  if (!isObject(a) || !isObject(b)) return false;
  const keys = Object.keys(a);
  return keys.length === Object.keys(b).length && keys.every((k) => Object.hasOwn(b, k) && equal(a[k], b[k]));
}

/** @param {any} value @returns {boolean} */
const holdsNull = (value) =>
  value === null || (typeof value === 'object' && Object.values(value).some(holdsNull));

/**
 * The JSON Merge Patch (RFC 7396) from one object to another, or null where none exists: a merge patch reads `null` as
 * "remove", so it cannot set a member to null.
 * @param {Record<string, any>} from @param {Record<string, any>} to @returns {Record<string, any> | null}
 */
export function mergePatch(from, to) {
  /** @type {Record<string, any>} */
  const patch = {};
  for (const key of Object.keys(from)) if (!Object.hasOwn(to, key)) patch[key] = null;
  for (const [key, value] of Object.entries(to)) {
    if (Object.hasOwn(from, key) && equal(from[key], value)) continue;
    if (isObject(value) && isObject(from[key])) {
      const inner = mergePatch(from[key], value);
      if (inner === null) return null;
      patch[key] = inner;
    } else if (!Array.isArray(value) && holdsNull(value)) return null;
    else patch[key] = value;
  }
  return patch;
}
