/** Dates and hours of local mean solar time, which is 12 when the mean sun stands in the meridian, and UTC. */

const HOUR_MS = 3_600_000;
const DEGREES_PER_HOUR = 15;

/** @typedef {{date: string, hours: number}} SolarTime `date` as 2026-06-21, `hours` in 0..24. */

/** @param {string} utc RFC 3339 @param {number} longitudeDeg East is positive @returns {SolarTime} */
export function toSolar(utc, longitudeDeg) {
  const local = new Date(Date.parse(utc) + (longitudeDeg / DEGREES_PER_HOUR) * HOUR_MS);
  const date = local.toISOString().slice(0, 10);
  return { date, hours: (local.getTime() - Date.parse(date)) / HOUR_MS };
}

/** To the second. @param {SolarTime} solar @param {number} longitudeDeg @returns {string} RFC 3339, UTC */
export function toUtc({ date, hours }, longitudeDeg) {
  const ms = Date.parse(date) + (hours - longitudeDeg / DEGREES_PER_HOUR) * HOUR_MS;
  return new Date(Math.round(ms / 1000) * 1000).toISOString().replace('.000Z', 'Z');
}

/** `06:30`. @param {number} hours */
export function clockText(hours) {
  const minutes = Math.round(hours * 60) % (24 * 60);
  return `${String(Math.floor(minutes / 60)).padStart(2, '0')}:${String(minutes % 60).padStart(2, '0')}`;
}
