/** Lamps and plates of ice in the scene: what a click, a colour or a slider makes of what stood there before. */
import { initial, initialVariant } from '../document.js';
import { altitudeAt, upAt } from '../fly/pose.js';
import { combine, dot } from '../vector.js';

/** @typedef {import('../schema.js').Node} Node */
/** @typedef {import('../vector.js').Vec3} Vec3 */
/**
 * What the next lamp will be.
 * @typedef {object} Lamp
 * @property {string} kind Of the schema's kinds, or `own`
 * @property {number} kelvin Of the kinds that have a colour temperature
 * @property {string} colour `#rrggbb`, of `own`
 * @property {number} candela
 * @property {number} height_m Above the ground
 * @property {string} emission
 */

/** Kinds that have a colour temperature, and what it is where nothing is said. @type {Record<string, number>} */
export const KELVIN = { incandescent: 2700, 'white-led': 4000 };
export const OWN = 'own';

/** Candela for each W/sr (per nm) in the three bands, as the picture's tone curve has it, and the bands' shares of luminance. */
const LUMINANCE_PER_RADIANCE = [90_231, 71_876, 69_561];
const LUMA = [0.2126, 0.7152, 0.0722];
/** Of fewer, the document would hold more digits than are seen. */
const DIGITS = 4;

const tidy = (/** @type {number} */ value) => Number(value.toPrecision(DIGITS));

/** Of an sRGB colour, W/sr (per nm): its luminous intensity is `candela`. @param {string} colour @param {number} candela */
export function radiantIntensity(colour, candela) {
  const linear = [1, 3, 5].map((i) => {
    const value = parseInt(colour.slice(i, i + 2), 16) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  });
  const luminance = linear.reduce((sum, v, i) => sum + LUMA[i] * v, 0);
  return linear.map((v, i) => (luminance > 0 ? tidy((candela * v) / luminance / LUMINANCE_PER_RADIANCE[i]) : 0));
}

/** A lamp of the scene. @param {Node} node Of `lights` @param {Lamp} lamp @param {[number, number]} place East and north, metres */
export function lightOf(node, lamp, place) {
  const light = { ...initial(/** @type {Node} */ (node.items)), position_m: [...place.map((v) => Math.round(v * 100) / 100 + 0), lamp.height_m], above: 'ground', emission: lamp.emission };
  if (lamp.kind === OWN) return { ...light, radiant_intensity_w_sr: radiantIntensity(lamp.colour, lamp.candela) };
  return { ...light, lamp: lamp.kind, colour_temperature_k: KELVIN[lamp.kind] ? lamp.kelvin : null, luminous_intensity_cd: tidy(lamp.candela) };
}

/** Where a ray from the camera meets the planet's sphere: how far away; null where it does not. @param {Vec3} from @param {Vec3} direction @param {number} radius */
export function toSphere(from, direction, radius) {
  const altitude = Math.max(altitudeAt(from, radius), 0);
  const fall = -dot(direction, upAt(from, radius));
  const reach = (radius + altitude) * fall;
  // With a small root of the quadratic in the form that does not cancel: c / (q + √(q² - c)).
  const c = altitude * (2 * radius + altitude);
  const root = reach * reach - c;
  return fall > 0 && root >= 0 ? c / (reach + Math.sqrt(root)) : null;
}

/** East and north of what lies at a distance. @param {Vec3} from @param {Vec3} direction @param {number} distance @returns {[number, number]} */
export function placeAt(from, direction, distance) {
  const [east, north] = combine([1, from], [distance, direction]);
  return [east, north];
}

/** The scene as its ground alone, to be asked how far away it is. @param {any} scene @param {Vec3} direction */
export const groundRequest = ({ planet, terrain, camera }, direction) => ({
  scene: { planet, terrain, camera: { position_m: camera.position_m }, atmosphere: null, clouds: null, haze: null, moon: null, stars: null, shafts: null },
  directions: [direction],
});

/** Layers as a list, whichever way they are written. @param {any} crystals @returns {any[]} */
export const layersOf = (crystals) => (crystals === null ? [] : Array.isArray(crystals) ? crystals : [crystals]);

/** Plates as the schema has them. @param {Node} node Of `ice_crystals` */
export const freshIce = (node) => initial({ ...node, initial: undefined });

/** Every layer changed in the same way. @param {any} crystals @param {(layer: any) => any} change */
export const withLayers = (crystals, change) => (Array.isArray(crystals) ? crystals.map(change) : change(crystals));

/** How far plates tilt, degrees: the spread, or the largest tilt where all up to it are alike. @param {any} layer */
export const tiltOf = ({ tilt }) => (tilt.kind === 'uniform' ? tilt.max_deg : tilt.sigma_deg);

/** @param {any} layer @param {number} deg */
export function tilted(layer, deg) {
  const { tilt } = layer;
  // Beyond four spreads hardly a plate is left out.
  return { ...layer, tilt: tilt.kind === 'uniform' ? { ...tilt, max_deg: deg } : { ...tilt, sigma_deg: deg, max_deg: Math.min(4 * deg, 45) } };
}

/** A top that leaves the layer some height. @param {any} layer @param {number} top_m */
export const upTo = (layer, top_m) => ({ ...layer, top_m: Math.max(top_m, layer.base_m + 10) });

/** The lamps of a file. @param {Node} node Of `town` @param {any} held @param {string} name */
export function townOf(node, held, name) {
  const index = /** @type {import('../schema.js').Variant[]} */ (node.variants).findIndex(({ kind }) => kind === 'asset');
  return { ...(held?.kind === 'asset' ? held : { ...initialVariant(node, index), factor: 1 }), name };
}

/** What lights as a town, as the list of choices has it: empty for nothing. @param {any} town */
export const choiceOf = (town) => (!town ? '' : town.kind === 'asset' ? `lights/${town.name}` : 'procedural');

/** The sun goes down, and the camera is exposed for lamps. @param {any} scene @param {number} azimuth_deg */
export const byNight = (scene, azimuth_deg) => ({
  ...scene,
  sun: { ...scene.sun, position: { azimuth_deg, elevation_deg: -25 } },
  display: { ...scene.display, exposure: { kind: 'ev', ev: -2.5 } },
});
