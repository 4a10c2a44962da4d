/** The canvas that fills the window: keeps the last picture, whatever happens to size and connection. */
import { clamp } from './vector.js';

/** A finer picture than this costs more than it shows. */
const MOST_PIXELS = 2_400_000;
const HIGHEST_DENSITY = 2;
/** Sides that the live connection takes, pixels. */
const [LEAST_SIDE, MOST_SIDE] = [16, 4096];

/** Width over height that a projection demands, or null where any will do. @param {string} kind */
const aspectOf = (kind) => ({ equirectangular: 2, cubemap: 6 })[kind] ?? null;

/** @typedef {{x: number, y: number, width: number, height: number}} Box */

/**
 * Where the picture stands in a window, CSS pixels: all of it, or a strip of the projection's own shape in its middle.
 * @param {string} kind @param {number} width @param {number} height @returns {Box}
 */
export function pictureBox(kind, width, height) {
  const aspect = aspectOf(kind);
  if (aspect === null) return { x: 0, y: 0, width, height };
  const w = Math.min(width, height * aspect);
  return { x: (width - w) / 2, y: (height - w / aspect) / 2, width: w, height: w / aspect };
}

/** Pixels to ask the server for. @param {string} kind @param {Box} box @param {number} density Device pixels per CSS pixel */
export function frameSize(kind, box, density) {
  const limit = Math.sqrt(MOST_PIXELS / (box.width * box.height));
  const scale = Math.min(clamp(density, 1, HIGHEST_DENSITY), limit);
  const side = (/** @type {number} */ length) => clamp(Math.round(length * scale), LEAST_SIDE, MOST_SIDE);
  const aspect = aspectOf(kind);
  const height_px = aspect === null ? side(box.height) : Math.min(side(box.height), Math.floor(MOST_SIDE / aspect));
  return { width_px: aspect === null ? side(box.width) : height_px * aspect, height_px };
}

/** @param {HTMLCanvasElement} canvas */
export function createStage(canvas) {
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d', { alpha: false }));
  /** @type {ImageBitmap | null} */
  let picture = null;
  let kind = 'perspective';

  const paint = () => {
    context.fillStyle = '#05070c';
    context.fillRect(0, 0, canvas.width, canvas.height);
    if (!picture) return;
    const box = pictureBox(kind, canvas.width, canvas.height);
    // While the window is resized the old picture covers the new box, its middle kept in the middle.
    const scale = Math.max(box.width / picture.width, box.height / picture.height);
    const [w, h] = [picture.width * scale, picture.height * scale];
    context.imageSmoothingQuality = 'high';
    context.drawImage(picture, box.x + (box.width - w) / 2, box.y + (box.height - h) / 2, w, h);
  };

  return {
    /** Follows the window. */
    resize() {
      const density = clamp(window.devicePixelRatio || 1, 1, HIGHEST_DENSITY);
      const [width, height] = [Math.round(canvas.clientWidth * density), Math.round(canvas.clientHeight * density)];
      if (width === canvas.width && height === canvas.height) return;
      canvas.width = width;
      canvas.height = height;
      paint();
    },
    /** @param {string} projection */
    setProjection: (projection) => (kind = projection),
    /** @returns {Box} */
    box: () => pictureBox(kind, canvas.clientWidth, canvas.clientHeight),
    /** The size to ask the server for. */
    size: () => frameSize(kind, pictureBox(kind, canvas.clientWidth, canvas.clientHeight), window.devicePixelRatio || 1),
    /** @param {ImageBitmap} next */
    show(next) {
      picture?.close();
      picture = next;
      paint();
    },
  };
}

/** @typedef {ReturnType<typeof createStage>} Stage */
