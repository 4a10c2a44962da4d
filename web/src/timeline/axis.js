/** Times as people read them, and the ticks of a time axis. */

/** Steps between ticks, seconds: people count them in 1, 2, 5, and in parts of minutes, hours and days. */
const STEPS = [0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 10_800, 21_600, 43_200, 86_400];

/** @param {number} length_s @param {number} most How many there may be beside the first */
export function ticks(length_s, most) {
  const step = STEPS.find((s) => length_s / s <= most) ?? 86_400 * Math.ceil(length_s / most / 86_400);
  return { step, times: Array.from({ length: Math.floor(length_s / step + 1e-9) + 1 }, (_, i) => Number((i * step).toFixed(3))) };
}

/** `7.5`, `1:07.5`, `2:00:00`; seconds with as many decimals as are needed, two at most. @param {number} seconds */
export function timeText(seconds) {
  const whole = Math.round(seconds * 100) / 100;
  const [hours, minutes] = [Math.floor(whole / 3600), Math.floor((whole % 3600) / 60)];
  const rest = String(Number((whole % 60).toFixed(2)));
  const pad = (/** @type {string} */ text) => (/^\d(\.|$)/.test(text) ? `0${text}` : text);
  if (hours > 0) return `${hours}:${pad(String(minutes))}:${pad(rest)}`;
  return minutes > 0 ? `${minutes}:${pad(rest)}` : rest;
}

/** For speech. @param {number} seconds */
export const spokenTime = (seconds) => `${Number(seconds.toFixed(2))} seconds`;
