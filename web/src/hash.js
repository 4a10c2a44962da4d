/**
 * A short scene document as the fragment of an address, and back: `sun.position.azimuth_deg=200&display.dither=false`.
 * A value is JSON; a text that cannot be mistaken for JSON stands bare.
 */
import { isObject } from './json.js';

/** Left readable: none of these ends an address or a fragment. @param {string} text */
const escape = (text) => encodeURIComponent(text).replaceAll(/%(3A|2C|5B|5D)/g, decodeURIComponent);

/** Begins as JSON does that has an end. */
const LOOKS_CUT = /^[[{"]/;

/** @param {any} value */
function valueText(value) {
  if (typeof value !== 'string' || LOOKS_CUT.test(value)) return JSON.stringify(value);
  try {
    JSON.parse(value);
    return JSON.stringify(value);
  } catch {
    return value;
  }
}

/** @param {string} text @returns {any} */
function readValue(text) {
  try {
    return JSON.parse(text);
  } catch {
    if (LOOKS_CUT.test(text)) throw new Error(`“${text}” is cut short`);
    return text;
  }
}

/** @param {any} document @param {string[]} path @returns {string[]} */
function pairs(document, path) {
  if (isObject(document) && Object.keys(document).length > 0) {
    return Object.entries(document).flatMap(([key, v]) => pairs(v, [...path, key]));
  }
  return [`${path.map((key) => escape(key).replaceAll('.', '%2E')).join('.')}=${escape(valueText(document))}`];
}

/** Empty for an empty document. @param {Record<string, any>} document */
export const toHash = (document) => (Object.keys(document).length === 0 ? '' : `#${pairs(document, []).join('&')}`);

/** Throws an `Error` that says which part cannot be read. @param {string} hash @returns {Record<string, any>} */
export function fromHash(hash) {
  /** @type {Record<string, any>} */
  const document = {};
  const text = hash.replace(/^#/, '');
  if (text === '') return document;
  for (const pair of text.split('&')) {
    const at = pair.indexOf('=');
    if (at < 1) throw new Error(`“${pair}” is not of the form name=value`);
    const path = pair.slice(0, at).split('.').map(decodeURIComponent);
    if (path.some((key) => key === '' || key === '__proto__')) throw new Error(`“${pair}” does not name a field`);
    let part = document;
    for (const key of path.slice(0, -1)) {
      if (!Object.hasOwn(part, key)) part[key] = {};
      part = part[key];
      if (!isObject(part)) throw new Error(`“${pair}” reaches into a value`);
    }
    part[path[path.length - 1]] = readValue(decodeURIComponent(pair.slice(at + 1)));
  }
  return document;
}
