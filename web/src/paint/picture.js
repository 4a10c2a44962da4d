/** Maps as files: PNG of the raster, and the raster of any PNG that the server keeps. */
import { SIDE } from './raster.js';

/** @param {import('./raster.js').Raster} raster @returns {Promise<Blob>} */
export function toPng(raster) {
  const canvas = new OffscreenCanvas(SIDE, SIDE);
  const context = /** @type {OffscreenCanvasRenderingContext2D} */ (canvas.getContext('2d'));
  context.putImageData(new ImageData(raster.rgba(), SIDE, SIDE), 0, 0);
  return canvas.convertToBlob({ type: 'image/png' });
}

/** Numbers as they stand in the file: neither alpha nor a colour profile is applied. @param {Blob} file */
export async function fromPng(file) {
  const bitmap = await createImageBitmap(file, { premultiplyAlpha: 'none', colorSpaceConversion: 'none' });
  const canvas = new OffscreenCanvas(SIDE, SIDE);
  const context = /** @type {OffscreenCanvasRenderingContext2D} */ (canvas.getContext('2d', { willReadFrequently: true }));
  context.drawImage(bitmap, 0, 0, SIDE, SIDE);
  bitmap.close();
  return context.getImageData(0, 0, SIDE, SIDE).data;
}
