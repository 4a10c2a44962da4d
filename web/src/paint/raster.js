/**
 * A weather map as numbers: coverage, type and rain, each 0 to 1, on a square whose edges meet. The first row is the
 * north, the first column the west.
 */

/** Cells along a side. */
export const SIDE = 512;
/** As the picture's R, G and B hold them. */
export const CHANNELS = /** @type {const} */ (['coverage', 'type', 'rain']);
/** @typedef {typeof CHANNELS[number]} Channel */

/** What is there before anything is painted. @type {Record<Channel, number>} */
export const BLANK = { coverage: 0, type: 0.5, rain: 0 };
const MOST_UNDO = 30;

/** Cells that a brush reaches beyond its middle: 1 in the middle, 0 at its rim, smooth at both. @param {number} share Of the radius */
export const falloff = (share) => (share >= 1 ? 0 : (1 - share * share) ** 2);

const wrap = (/** @type {number} */ cell) => ((cell % SIDE) + SIDE) % SIDE;

export function createRaster() {
  const planes = Object.fromEntries(CHANNELS.map((channel) => [channel, new Float32Array(SIDE * SIDE).fill(BLANK[channel])]));
  /** @type {{channel: Channel, values: Float32Array}[][]} */
  const past = [];
  const remember = (/** @type {readonly Channel[]} */ channels) => {
    past.push(channels.map((channel) => ({ channel, values: planes[channel].slice() })));
    if (past.length > MOST_UNDO) past.shift();
  };
  return {
    planes,
    /** Before a stroke or anything else that is undone at once. @param {Channel} channel */
    begin: (channel) => remember([channel]),
    /** @returns {boolean} False where there is nothing to undo */
    undo() {
      const step = past.pop();
      for (const { channel, values } of step ?? []) planes[channel].set(values);
      return step !== undefined;
    },
    canUndo: () => past.length > 0,
    /**
     * Draws the cells round a place towards a level.
     * @param {Channel} channel @param {{x: number, y: number}} at In cells @param {number} radius In cells
     * @param {number} level @param {number} strength 0 to 1
     */
    dab(channel, at, radius, level, strength) {
      const plane = planes[channel];
      const reach = Math.min(Math.ceil(radius), SIDE / 2);
      for (let dy = -reach; dy < reach; dy++) {
        const [y, row] = [Math.floor(at.y) + dy, wrap(Math.floor(at.y) + dy) * SIDE];
        for (let dx = -reach; dx < reach; dx++) {
          const x = Math.floor(at.x) + dx;
          const weight = strength * falloff(Math.hypot(x + 0.5 - at.x, y + 0.5 - at.y) / radius);
          const cell = row + wrap(x);
          plane[cell] += (level - plane[cell]) * weight;
        }
      }
    },
    /** @param {Channel} channel @param {number} level */
    fill(channel, level) {
      remember([channel]);
      planes[channel].fill(level);
    },
    clear() {
      remember(CHANNELS);
      for (const channel of CHANNELS) planes[channel].fill(BLANK[channel]);
    },
    /** Takes over a picture of the same size. @param {Uint8ClampedArray} rgba */
    read(rgba) {
      past.length = 0;
      CHANNELS.forEach((channel, c) => {
        for (let i = 0; i < SIDE * SIDE; i++) planes[channel][i] = rgba[4 * i + c] / 255;
      });
    },
    /** The picture that the server is sent. */
    rgba() {
      const rgba = new Uint8ClampedArray(4 * SIDE * SIDE);
      for (let i = 0; i < SIDE * SIDE; i++) {
        CHANNELS.forEach((channel, c) => (rgba[4 * i + c] = 255 * planes[channel][i]));
        rgba[4 * i + 3] = 255;
      }
      return rgba;
    },
  };
}

/** @typedef {ReturnType<typeof createRaster>} Raster */

/** How near dabs of a stroke are set, of the radius. */
const SPACING = 0.25;

/**
 * A stroke of the brush: dabs at even distances along the way, the first where it begins.
 * @param {(at: {x: number, y: number}, pressure: number) => void} dab @param {number} radius In cells
 */
export function createStroke(dab, radius) {
  /** @type {{x: number, y: number} | null} */
  let last = null;
  const step = Math.max(radius * SPACING, 0.5);
  return {
    /** @param {{x: number, y: number}} at @param {number} pressure 0 to 1 */
    to(at, pressure) {
      if (!last) {
        last = at;
        return dab(at, pressure);
      }
      const [from, length] = [last, Math.hypot(at.x - last.x, at.y - last.y)];
      for (let way = step; way <= length; way += step) {
        last = { x: from.x + ((at.x - from.x) * way) / length, y: from.y + ((at.y - from.y) * way) / length };
        dab(last, pressure);
      }
    },
  };
}

/** Colours of the map as people see it: land or cloud, from stratus to cumulus, and rain. @type {Record<string, [number, number, number]>} */
const INK = { land: [29, 58, 86], cloud: [244, 247, 250], stratus: [118, 130, 205], cumulus: [255, 176, 96], rain: [40, 120, 255] };

/**
 * The map as people see it; the channel that is painted stands out.
 * @param {Raster} raster @param {Channel} channel @param {Uint8ClampedArray} rgba Takes the picture
 */
export function tint({ planes }, channel, rgba) {
  const { coverage, type, rain } = planes;
  const [typed, wet] = { coverage: [0, 0.6], type: [0.9, 0.2], rain: [0, 0.95] }[channel];
  const floor = channel === 'type' ? 0.35 : 0;
  for (let i = 0; i < SIDE * SIDE; i++) {
    const seen = floor + (1 - floor) * coverage[i];
    for (let c = 0; c < 3; c++) {
      const kind = INK.stratus[c] + (INK.cumulus[c] - INK.stratus[c]) * type[i];
      const cloud = INK.cloud[c] + (kind - INK.cloud[c]) * typed;
      const dry = INK.land[c] + (cloud - INK.land[c]) * seen;
      rgba[4 * i + c] = dry + (INK.rain[c] - dry) * wet * rain[i];
    }
    rgba[4 * i + 3] = 255;
  }
}
