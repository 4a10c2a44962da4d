/** Slider positions (0 to 1) and values: linear, or logarithmic where a positive range spans decades. */
import { clamp } from './vector.js';

/** A range this many times its default, or its least value, is read on a logarithm. */
const DECADES = 50;
/** Lengths are, from this on: heights of clouds matter near the ground as they do at the tropopause. */
const LENGTH_DECADES = 10;
/** A range that starts at zero has its first position there, the next at the default over this. */
const BELOW_DEFAULT = 1000;
/** A range round zero wider than this is nothing that a slider can set. */
const WIDEST_ROUND_ZERO = 1e4;

/** @typedef {{position: (value: number) => number, value: (position: number) => number, step: number}} Scale */

/** Null where no slider serves. @param {import('./schema.js').Node} node @returns {Scale | null} */
export function createScale({ minimum, maximum, initial, unit, integer, description }) {
  if (minimum === undefined || maximum === undefined) return null;
  if (/\bpower of two\b/.test(description)) return powersOfTwo(minimum, maximum);
  const span = maximum - minimum;
  if (minimum < 0 && span > WIDEST_ROUND_ZERO) return null;
  const anchor = minimum > 0 ? minimum : Number(initial) / BELOW_DEFAULT;
  const decades = minimum > 0 ? maximum / minimum : maximum / Number(initial);
  if (minimum >= 0 && unit !== '°' && anchor > 0 && decades >= (unit === 'm' ? LENGTH_DECADES : DECADES)) return logarithmic(minimum, anchor, maximum, Boolean(integer));
  const step = Math.max(10 ** Math.floor(Math.log10(span / 500)), integer ? 1 : 0);
  return {
    step,
    position: (value) => clamp((value - minimum) / span, 0, 1),
    value: (position) => clamp(rounded(minimum + position * span, step), minimum, maximum),
  };
}

/** @param {number} minimum @param {number} low First value above the minimum @param {number} high @param {boolean} integer @returns {Scale} */
function logarithmic(minimum, low, high, integer) {
  const ratio = Math.log(high / low);
  return {
    step: integer ? 1 : 10 ** Math.floor(Math.log10(low)),
    position: (value) => (value <= low ? 0 : clamp(Math.log(value / low) / ratio, 0, 1)),
    value: (position) => {
      const value = position <= 0 ? minimum : low * Math.exp(position * ratio);
      return clamp(integer ? Math.round(value) : Number(value.toPrecision(3)), minimum, high);
    },
  };
}

/** @param {number} minimum @param {number} maximum @returns {Scale} */
function powersOfTwo(minimum, maximum) {
  const [low, span] = [Math.log2(minimum), Math.log2(maximum / minimum)];
  return {
    step: 1,
    position: (value) => clamp((Math.log2(value) - low) / span, 0, 1),
    value: (position) => 2 ** Math.round(low + position * span),
  };
}

/** @param {number} value @param {number} step */
const rounded = (value, step) => Number((Math.round(value / step) * step).toPrecision(10));
