/** Terrain in the scene: what a choice of mountains, heights or a mesh makes of what stood there before. */
import { initial, initialVariant } from '../document.js';

/** @typedef {import('../schema.js').Node} Node */

/** What the page knows of a kind when none of it is there. @param {Node} node Of terrain @param {string} kind @param {any} held */
function begun(node, kind, held) {
  if (held?.kind === kind) return held;
  const index = /** @type {import('../schema.js').Variant[]} */ (node.variants).findIndex((variant) => variant.kind === kind);
  return initialVariant(node, index);
}

/** Mountains made from noise, with all that shapes them to be seen. @param {Node} node @param {any} held */
export function mountains(node, held) {
  const field = begun(node, 'heightfield', held);
  const shape = node.variants?.find(({ kind }) => kind === 'heightfield')?.node.properties?.find(({ key }) => key === 'mountains');
  if (!shape) throw new Error('the scene’s schema has no mountains');
  return { ...field, name: null, mountains: field.mountains ?? initial({ ...shape.node, initial: undefined }) };
}

/** Heights of a file, as large as the file says. @param {Node} node @param {any} held @param {string} name */
export const heights = (node, held, name) => ({ ...begun(node, 'heightfield', held), name, mountains: null, extent_m: null, height_m: null });

/** @param {Node} node @param {any} held @param {string} name */
export const mesh = (node, held, name) => ({ ...begun(node, 'mesh', held), name });

/** What stands there, as the list of choices has it: empty for nothing. @param {any} terrain */
export function choiceOf(terrain) {
  if (!terrain) return '';
  if (terrain.kind === 'mesh') return `meshes/${terrain.name}`;
  return terrain.name === null ? 'mountains' : `heightfields/${terrain.name}`;
}
