/** How the world lies on the map, and the map in the scene. */
import { directionAngles } from '../vector.js';

export const CONVENTION = 'coverage-type-rain';
const DEFAULT_EXTENT_M = 60_000;
const RAD = Math.PI / 180;

/** @typedef {{x: number, y: number}} Point */

/** Side of the square that the scene's weather map covers. @param {any} scene @returns {number} */
export const extentOf = (scene) => scene.clouds?.weather_map.extent_m ?? DEFAULT_EXTENT_M;

/** The map that the scene shows, where it is a picture that can be painted. @param {any} scene @returns {string | null} */
export function shownName(scene) {
  const map = scene.clouds?.weather_map;
  return map?.kind === 'asset' && map.convention === CONVENTION ? map.name : null;
}

/**
 * The observer on the map, of its side, from its north-west corner. The weather has drifted with the wind: it is met where
 * it came from.
 * @param {any} scene @returns {Point}
 */
export function observerOn(scene) {
  const [east, north] = scene.camera.position_m;
  const { speed_m_s = 0, azimuth_deg = 0, drift_m = [0, 0, 0] } = scene.clouds?.wind ?? {};
  const run = speed_m_s * scene.time_s;
  const x = east - drift_m[0] + run * Math.sin(azimuth_deg * RAD);
  const y = north - drift_m[1] + run * Math.cos(azimuth_deg * RAD);
  const share = (/** @type {number} */ metres) => 0.5 + metres / extentOf(scene) - Math.floor(0.5 + metres / extentOf(scene));
  return { x: share(x), y: share(-y) };
}

/**
 * From which to which azimuth the camera sees, degrees; all round where it does.
 * @param {any} camera @param {number} aspect Width of the picture over its height
 */
export function viewCone(camera, aspect) {
  const { kind, vertical_fov_deg, fov_deg } = camera.projection;
  const all = { from: 0, to: 360 };
  if (kind !== 'perspective' && kind !== 'fisheye') return all;
  const width = kind === 'fisheye' ? fov_deg : (2 * Math.atan(Math.tan((vertical_fov_deg * RAD) / 2) * aspect)) / RAD;
  const { azimuth_deg, elevation_deg } = directionAngles(camera.direction);
  // A camera that sees the zenith or the nadir sees it from all sides.
  const tall = kind === 'fisheye' ? fov_deg : vertical_fov_deg;
  if (width >= 360 || Math.abs(elevation_deg) + tall / 2 >= 90) return all;
  return { from: azimuth_deg - width / 2, to: azimuth_deg + width / 2 };
}

/**
 * The scene under a painted map. What is painted acts: a layer's own type gives way to the map's, and rain falls.
 * @param {any} scene @param {any} fair Clouds for a scene without any
 * @param {{name: string, extent_m: number}} map @param {import('./raster.js').Channel[]} channels What was painted
 */
export function shownBy(scene, fair, { name, extent_m }, channels) {
  const clouds = scene.clouds ?? fair;
  const own = channels.includes('type');
  const layers = clouds.layers.map((/** @type {any} */ layer) => (own && layer.kind === 'volume' ? { ...layer, type: null } : layer));
  const precipitation = channels.includes('rain') && clouds.precipitation === 0 ? 1 : clouds.precipitation;
  return { ...scene, clouds: { ...clouds, layers, precipitation, weather_map: { kind: 'asset', name, convention: CONVENTION, extent_m } } };
}
