/** JSON pointers (RFC 6901) over plain JSON values, without changing the value given. */

/** @param {string} pointer @returns {string[]} */
export const tokens = (pointer) =>
  pointer === '' ? [] : pointer.slice(1).split('/').map((t) => t.replaceAll('~1', '/').replaceAll('~0', '~'));

/** @param {string} pointer @param {string | number} key */
export const child = (pointer, key) => `${pointer}/${String(key).replaceAll('~', '~0').replaceAll('/', '~1')}`;

/** Undefined where nothing is there. @param {any} value @param {string} pointer @returns {any} */
export const getAt = (value, pointer) =>
  tokens(pointer).reduce((v, key) => (v !== null && typeof v === 'object' && Object.hasOwn(v, key) ? v[key] : undefined), value);

/** A copy with one member replaced. @param {any} value @param {string} pointer @param {any} member @returns {any} */
export function setAt(value, pointer, member) {
  const [key, ...rest] = tokens(pointer);
  if (key === undefined) return member;
  const inner = setAt(value?.[key], rest.reduce((p, k) => child(p, k), ''), member);
  if (Array.isArray(value)) return value.with(Number(key), inner);
  return { ...value, [key]: inner };
}
