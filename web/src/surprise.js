/** A random sky that might well be: clouds of some kind, a wind, and the sun at some hour of the day. */
import { toSolar, toUtc } from './clock.js';
import { isTimed, limited } from './sun.js';
import { toast } from './toast.js';
import { clamp, directionAngles } from './vector.js';

/** @typedef {() => number} Chance From 0 to 1, 1 not among them. */

const RAD = Math.PI / 180;
const MOST_SEED = 2 ** 32;
/** Nearest to the horizon that a surprise puts the sun, degrees. */
const LOWEST_SUN_DEG = 4;
const MOST_UNDO = 50;

/** @param {Chance} chance @param {number} low @param {number} high @param {number} [step] */
const between = (chance, low, high, step = 0.01) => Number((Math.round((low + (high - low) * chance()) / step) * step).toPrecision(6));

/**
 * What kinds of weather there are: ranges of coverage, type, rain, wind, and of the layer's base and depth, metres; and
 * how often there is a high sheet above.
 * @type {{name: string, coverage: [number, number], type: [number, number], rain: [number, number], wind: [number, number], base_m: [number, number], depth_m: [number, number], anvil: number, sheet: number}[]}
 */
export const WEATHERS = [
  { name: 'Fair-weather cumulus', coverage: [0.15, 0.4], type: [0.75, 1], rain: [0, 0], wind: [2, 10], base_m: [900, 1800], depth_m: [800, 1800], anvil: 0, sheet: 0.4 },
  { name: 'Broken clouds', coverage: [0.45, 0.7], type: [0.5, 0.85], rain: [0, 0.1], wind: [4, 14], base_m: [900, 1600], depth_m: [900, 2200], anvil: 0, sheet: 0.4 },
  { name: 'Stratocumulus', coverage: [0.65, 0.85], type: [0.4, 0.6], rain: [0, 0.1], wind: [2, 10], base_m: [700, 1500], depth_m: [500, 1000], anvil: 0, sheet: 0.1 },
  { name: 'Overcast', coverage: [0.92, 1], type: [0.1, 0.35], rain: [0, 0.4], wind: [2, 12], base_m: [300, 900], depth_m: [600, 1500], anvil: 0, sheet: 0 },
  { name: 'Showers', coverage: [0.4, 0.65], type: [0.9, 1], rain: [0.4, 0.9], wind: [6, 18], base_m: [700, 1200], depth_m: [4000, 7000], anvil: 0.2, sheet: 0.3 },
  { name: 'A storm', coverage: [0.65, 0.9], type: [1, 1], rain: [0.7, 1], wind: [10, 25], base_m: [500, 900], depth_m: [9000, 11_000], anvil: 0.8, sheet: 0.2 },
  { name: 'High clouds', coverage: [0, 0.08], type: [0.7, 1], rain: [0, 0], wind: [2, 10], base_m: [1200, 2000], depth_m: [600, 1000], anvil: 0, sheet: 1 },
];
const GENERA = ['cirrus', 'cirrocumulus', 'cirrostratus', 'altocumulus', 'altostratus'];
/** Height of each genus, metres. @type {Record<string, [number, number]>} */
const HEIGHTS = { cirrus: [8000, 11_000], cirrocumulus: [7000, 9000], cirrostratus: [7000, 10_000], altocumulus: [3000, 5500], altostratus: [3000, 5500] };

/**
 * A solar hour at which the sun stands clear of the horizon: sin h = sin φ sin δ + cos φ cos δ cos H, with the day of the
 * year for the sun's declination δ. Null where it does not rise that high on that day.
 * @param {string} date @param {number} latitudeDeg @param {Chance} chance
 */
export function dayHour(date, latitudeDeg, chance) {
  const day = (Date.parse(date) - Date.parse(`${date.slice(0, 4)}-01-01`)) / 86_400_000;
  const declination = -23.44 * RAD * Math.cos((2 * Math.PI * (day + 10)) / 365.25);
  const latitude = latitudeDeg * RAD;
  const cosine = (Math.sin(LOWEST_SUN_DEG * RAD) - Math.sin(latitude) * Math.sin(declination)) / (Math.cos(latitude) * Math.cos(declination));
  if (cosine > 1) return null;
  const half = Math.acos(clamp(cosine, -1, 1)) / RAD / 15;
  return 12 + (2 * chance() - 1) * half;
}

/** The sun at another hour of the day. @param {any} scene @param {Chance} chance */
function movedSun(scene, chance) {
  const { position } = scene.sun;
  if (!isTimed(position)) {
    const looking = directionAngles(scene.camera.direction).azimuth_deg;
    // Beside the frame as often as in it, seldom behind the observer.
    return limited({ azimuth_deg: between(chance, looking - 110, looking + 110, 0.1), elevation_deg: between(chance, LOWEST_SUN_DEG, 55, 0.1) });
  }
  const { date } = toSolar(position.time, position.longitude_deg);
  const hours = dayHour(date, position.latitude_deg, chance);
  return hours === null ? position : { ...position, time: toUtc({ date, hours }, position.longitude_deg) };
}

/**
 * @param {any} scene What is kept of it: all but the sun's place and the clouds' weather
 * @param {any} fair Clouds of fair weather, which say the rest @param {Chance} chance
 */
export function surprising(scene, fair, chance) {
  const weather = WEATHERS[Math.floor(chance() * WEATHERS.length)];
  const pick = (/** @type {[number, number]} */ [low, high], /** @type {number} */ step) => between(chance, low, high, step);
  const volume = fair.layers.find((/** @type {any} */ layer) => layer.kind === 'volume');
  const base_m = pick(weather.base_m, 50);
  const layers = [{ ...volume, base_m, top_m: base_m + pick(weather.depth_m, 50), type: pick(weather.type, 0.01), coverage: null, anvil: weather.anvil }];
  if (chance() < weather.sheet) {
    const genus = GENERA[Math.floor(chance() * GENERA.length)];
    layers.push({ kind: 'sheet', height_m: pick(HEIGHTS[genus], 100), genus, coverage: between(chance, 0.2, 0.7), optical_depth: null });
  }
  const wind = { ...fair.wind, speed_m_s: pick(weather.wind, 0.5), azimuth_deg: between(chance, 0, 359, 1), drift_m: [0, 0, 0] };
  const clouds = {
    ...fair, seed: Math.floor(chance() * MOST_SEED), coverage: pick(weather.coverage, 0.01), precipitation: pick(weather.rain, 0.01), layers, wind,
  };
  return { name: weather.name, scene: { ...scene, clouds, sun: { ...scene.sun, position: movedSun(scene, chance) } } };
}

/** @param {import('./store.js').Store} store @param {HTMLButtonElement} button @param {any} fair Clouds of fair weather */
export function createSurprise(store, button, fair) {
  /** @type {any[]} */
  const before = [];
  const undo = () => {
    const scene = before.pop();
    if (!scene) return;
    store.replace(scene);
    toast('The sky is as it was before.');
  };
  const act = () => {
    before.push(store.scene);
    if (before.length > MOST_UNDO) before.shift();
    const { name, scene } = surprising(store.scene, fair, Math.random);
    store.replace(scene);
    toast(`${name}, seed ${scene.clouds.seed}`, { action: { name: 'Undo', act: undo } });
  };
  button.addEventListener('click', act);
  return { act, undo };
}
