/** Files that the server keeps for scenes, by kind and name. */
import { listAssets, putAsset } from './api.js';

/** @typedef {'weather-maps' | 'heightfields' | 'meshes'} Kind */

const PRECONDITION_FAILED = 412;
const MOST_TRIES = 100;
/** Which kind a file is of, by the end of its name; the server looks into it. @type {Record<string, Kind>} */
const TERRAIN_ENDS = { png: 'heightfields', tif: 'heightfields', tiff: 'heightfields', npy: 'heightfields', glb: 'meshes', zip: 'meshes' };

/** Null for a file that is no terrain. @param {string} file @returns {Kind | null} */
export const terrainKind = (file) => TERRAIN_ENDS[/\.([a-z0-9]+)$/i.exec(file)?.[1].toLowerCase() ?? ''] ?? null;

export const TERRAIN_FILES = Object.keys(TERRAIN_ENDS).map((end) => `.${end}`).join(',');

/** A name that an asset may have, of a file's name. @param {string} file @param {string} other Where nothing of it is left */
export const assetName = (file, other) =>
  file.toLowerCase().replace(/\.[a-z0-9]+$/, '').replaceAll(/[^a-z0-9_-]+/g, '-').replace(/^[_-]+/, '').slice(0, 60).replace(/-+$/, '') || other;

/** Under the file's name, or that with a number where there is one of it. @param {Kind} kind @param {File} file @param {string} other @returns {Promise<string>} */
export async function upload(kind, file, other) {
  const base = assetName(file.name, other);
  for (let i = 1; ; i++) {
    const name = i === 1 ? base : `${base}-${i}`;
    try {
      return (await putAsset(kind, name, file, { isNew: true })).name;
    } catch (error) {
      if (/** @type {any} */ (error).problem?.status !== PRECONDITION_FAILED || i === MOST_TRIES) throw error;
    }
  }
}

/** @param {Kind} kind */
export const namesOf = async (kind) => (await listAssets(kind)).map(({ name }) => name);
