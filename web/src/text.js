/** Names and numbers as people read them. */

/** Names that are not words. @type {Record<string, string>} */
const PROPER = { aces: 'ACES', agx: 'AgX', ev: 'EV', lut: 'LUT' };

/** `exr-float` or `tone_curve` as a label. @param {string} name */
export function sentence(name) {
  if (Object.hasOwn(PROPER, name)) return PROPER[name];
  const words = name.replaceAll(/[_-]/g, ' ');
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/** Shortest text of at most seven digits that a number input reads back. @param {number} value */
export function numberText(value) {
  const rounded = Number(value.toPrecision(7));
  const size = Math.abs(rounded);
  return size !== 0 && size < 1e-3 ? rounded.toExponential().replace('e+', 'e') : String(rounded);
}

/** @param {number} ms */
export const milliseconds = (ms) => `${ms < 10 ? ms.toFixed(1) : Math.round(ms)} ms`;

/** @param {number} deg @param {number} [digits] */
export const degrees = (deg, digits = 1) => `${(Math.round(deg * 10 ** digits) / 10 ** digits + 0).toFixed(digits)}°`;

/** @param {number} share 0 to 1 */
export const percent = (share) => `${Math.round(100 * share)} %`;

/** The point of the compass, for speech. @param {number} azimuthDeg */
export const compass = (azimuthDeg) =>
  ['north', 'north-east', 'east', 'south-east', 'south', 'south-west', 'west', 'north-west'][Math.round(azimuthDeg / 45) % 8];

/** Millimetres to millions of kilometres with three or four digits that count. @param {number} metres */
export function distance(metres) {
  const size = Math.abs(metres);
  const [value, unit] = size < 1000 ? [metres, 'm'] : [metres / 1000, 'km'];
  const digits = Math.abs(value) < 10 ? 2 : Math.abs(value) < 100 ? 1 : 0;
  return `${(Math.round(value * 10 ** digits) / 10 ** digits + 0).toFixed(digits)} ${unit}`;
}
