/** What parts that are off begin with when they are switched on, where the schema's defaults leave it open. */
import { initial } from './document.js';
import { mountains } from './terrain/document.js';
import { setAt } from './pointer.js';
import { limited } from './sun.js';
import { wrap360 } from './vector.js';

/**
 * @typedef {object} Known
 * @property {() => import('./vector.js').Angles | null} sun Where the sun stands
 * @property {() => import('./moon.js').MoonPlace | null} moon Where the moon stands, where there is one
 * @property {() => string[]} heightfields Names of what the server keeps
 */

/** Koschmieder's: the optical depth that leaves 2 % of contrast. */
const CONTRAST_DEPTH = 3.912;
const MOON_ELEVATION_DEG = 30;

/** By pointer, `*` for any place in a list. @type {Record<string, (scene: any, known: Known, node: import('./schema.js').Node) => any>} */
const STARTS = {
  '/haze/visibility_m': ({ haze }) => (haze?.extinction_per_m ? Number((CONTRAST_DEPTH / haze.extinction_per_m).toPrecision(3)) : 20_000),
  '/haze/extinction_per_m': ({ haze }) => Number((CONTRAST_DEPTH / (haze?.visibility_m ?? 20_000)).toPrecision(3)),
  '/moon/position': (_, known) => {
    const moon = known.moon();
    if (moon) return limited(moon);
    return { azimuth_deg: wrap360((known.sun()?.azimuth_deg ?? 0) + 180), elevation_deg: MOON_ELEVATION_DEG };
  },
  '/moon/phase_angle_deg': (_, known) => Math.round(known.moon()?.phase_angle_deg ?? 0),
  '/moon/angular_diameter_deg': (_, known) => Number((known.moon()?.angular_diameter_deg ?? 0.518).toFixed(3)),
  '/atmosphere/view_steps': () => 32,
  '/atmosphere/sun_steps': () => 32,
  '/clouds/shape/seed': ({ clouds }) => clouds.seed,
  '/clouds/weather_map/seed': ({ clouds }) => clouds.seed,
  '/clouds/layers/*/coverage': ({ clouds }) => clouds.coverage,
  '/clouds/layers/*/type': () => 0.5,
  '/clouds/layers/*/optical_depth': () => 1,
  '/terrain': (_, __, node) => mountains(node, null),
  '/terrain/name': (_, known) => known.heightfields()[0],
  '/terrain/extent_m': () => 40_000,
  '/terrain/height_m': () => 2500,
};

/** One quantity in two forms: the server takes one of them. @type {Record<string, string>} */
const OTHER_FORM = {
  '/haze/visibility_m': '/haze/extinction_per_m',
  '/haze/extinction_per_m': '/haze/visibility_m',
  '/terrain/name': '/terrain/mountains',
  '/terrain/mountains': '/terrain/name',
};

/**
 * The scene with the part at `pointer` switched on.
 * @param {any} scene @param {string} pointer @param {import('./schema.js').Node} node @param {Known} known
 */
export function turnedOn(scene, pointer, node, known) {
  const start = STARTS[pointer.replaceAll(/\/\d+/g, '/*')]?.(scene, known, node);
  let next = setAt(scene, pointer, start ?? initial(node) ?? initial({ ...node, initial: undefined }));
  if (OTHER_FORM[pointer]) next = setAt(next, OTHER_FORM[pointer], null);
  // Haze that does not say how dense it is shows nothing to set.
  return pointer === '/haze' ? setAt(next, '/haze/visibility_m', STARTS['/haze/visibility_m'](next, known, node)) : next;
}
