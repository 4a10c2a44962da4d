/** The map one paints on: the picture, the observer with what the camera sees, and the brush of pointer, pen or keys. */
import { byId } from '../dom.js';
import { clamp } from '../vector.js';
import { createStroke, SIDE, tint } from './raster.js';

const RAD = Math.PI / 180;
/** What the keys move the brush by, in cells: a step, and a fine one. */
const [KEY_STEP, FINE_STEP] = [16, 2];
/** Length of the camera's wedge, of the map's side. */
const WEDGE = 0.22;

/** @typedef {import('./place.js').Point} Point */
/** @typedef {{channel: import('./raster.js').Channel, radius: number, level: number, strength: number}} Brush Radius in cells. */

/** Mice have no pressure, and fingers seldom; a pen's counts. @param {PointerEvent} event */
export const pressureOf = ({ pointerType, pressure }) =>
  pointerType === 'pen' || (pointerType === 'touch' && pressure > 0 && pressure < 1 && pressure !== 0.5) ? pressure : 1;

/**
 * @param {import('./raster.js').Raster} raster @param {() => Brush} brush @param {() => void} painted After each change
 */
export function createBoard(raster, brush, painted) {
  const canvas = byId('map', HTMLCanvasElement);
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d', { alpha: false }));
  const [ring, cross, wedge, dot, bar] = ['map-brush', 'map-cross', 'map-view', 'map-here', 'map-scale'].map((id) => byId(id, SVGElement));
  canvas.width = SIDE;
  canvas.height = SIDE;
  const image = new ImageData(SIDE, SIDE);
  let isStale = true;
  /** Where the keys have the brush. @type {Point} */
  let cursor = { x: SIDE / 2, y: SIDE / 2 };

  const dab = (/** @type {Point} */ at, /** @type {number} */ pressure) => {
    const { channel, radius, level, strength } = brush();
    raster.dab(channel, at, radius, level, strength * pressure);
    isStale = true;
  };
  const placeOf = (/** @type {MouseEvent} */ event) => {
    const { left, top, width, height } = canvas.getBoundingClientRect();
    return { x: ((event.clientX - left) / width) * SIDE, y: ((event.clientY - top) / height) * SIDE };
  };
  const showRing = (/** @type {Point} */ { x, y }) => {
    ring.setAttribute('cx', String(x));
    ring.setAttribute('cy', String(y));
    ring.setAttribute('r', String(brush().radius));
    ring.removeAttribute('hidden');
  };

  /** @type {ReturnType<typeof createStroke> | null} */
  let stroke = null;
  canvas.addEventListener('pointerdown', (event) => {
    if (event.button !== 0 || stroke) return;
    canvas.setPointerCapture(event.pointerId);
    raster.begin(brush().channel);
    stroke = createStroke(dab, brush().radius);
    stroke.to(placeOf(event), pressureOf(event));
    painted();
  });
  canvas.addEventListener('pointermove', (event) => {
    showRing(placeOf(event));
    if (!stroke || !canvas.hasPointerCapture(event.pointerId)) return;
    const all = event.getCoalescedEvents();
    for (const part of all.length > 0 ? all : [event]) stroke.to(placeOf(part), pressureOf(part));
    painted();
  });
  const end = () => (stroke = null);
  canvas.addEventListener('pointerup', end);
  canvas.addEventListener('pointercancel', end);
  canvas.addEventListener('pointerleave', () => ring.setAttribute('hidden', ''));

  /** @type {Record<string, [number, number]>} */
  const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  canvas.addEventListener('keydown', (event) => {
    const step = steps[event.key];
    if (step) {
      const length = event.shiftKey ? FINE_STEP : KEY_STEP;
      cursor = { x: clamp(cursor.x + step[0] * length, 0, SIDE), y: clamp(cursor.y + step[1] * length, 0, SIDE) };
      const percent = (/** @type {number} */ v) => Math.round((100 * v) / SIDE);
      canvas.setAttribute('aria-label', `Map of the weather. Brush ${percent(cursor.x)} percent from the west, ${percent(cursor.y)} from the north.`);
    } else if (event.key === ' ' || event.key === 'Enter') {
      raster.begin(brush().channel);
      dab(cursor, 1);
      painted();
    } else return;
    event.preventDefault();
    event.stopPropagation();
    showRing(cursor);
    cross.setAttribute('transform', `translate(${cursor.x} ${cursor.y})`);
  });

  return {
    stale: () => (isStale = true),
    /** @param {boolean} isOn */
    enable(isOn) {
      canvas.toggleAttribute('inert', !isOn);
      canvas.classList.toggle('idle', !isOn);
    },
    /** Once an animation frame at most. @param {Point} here @param {{from: number, to: number}} cone @param {number} extentM */
    draw(here, cone, extentM) {
      if (isStale) {
        isStale = false;
        tint(raster, brush().channel, image.data);
        context.putImageData(image, 0, 0);
      }
      const [x, y] = [here.x * SIDE, here.y * SIDE];
      dot.setAttribute('transform', `translate(${x} ${y})`);
      const rim = (/** @type {number} */ azimuth) => `${x + WEDGE * SIDE * Math.sin(azimuth * RAD)} ${y - WEDGE * SIDE * Math.cos(azimuth * RAD)}`;
      const r = WEDGE * SIDE;
      const isRound = cone.to - cone.from >= 360;
      const [large, arc] = [Number(cone.to - cone.from > 180), `A${r} ${r} 0`];
      wedge.setAttribute('d', isRound ? `M${rim(0)}${arc} 1 1 ${rim(180)}${arc} 1 1 ${rim(0)}Z` : `M${x} ${y}L${rim(cone.from)}${arc} ${large} 1 ${rim(cone.to)}Z`);
      const { km, share } = scaleBar(extentM);
      bar.querySelector('path')?.setAttribute('d', `M16 ${SIDE - 24}v8h${share * SIDE}v-8`);
      const text = /** @type {SVGTextElement} */ (bar.querySelector('text'));
      text.textContent = `${km} km`;
      text.setAttribute('x', String(24 + share * SIDE));
    },
  };
}

/** A round length of about a quarter of the map. @param {number} extentM */
export function scaleBar(extentM) {
  const quarter = extentM / 4000;
  const decade = 10 ** Math.floor(Math.log10(quarter));
  const km = [5, 2, 1].map((n) => n * decade).find((length) => length <= quarter) ?? decade;
  return { km: Number(km.toPrecision(2)), share: (1000 * km) / extentM };
}
