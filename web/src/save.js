/** Renders the scene at a chosen size and final quality, and hands it over as a file. */
import { postFrame } from './api.js';
import { byId, h } from './dom.js';

/** @type {[number, number][]} */
const SIZES = [[1280, 720], [1920, 1080], [3840, 2160], [2048, 1024], [8192, 4096], [6144, 1024]];
const TICK_MS = 200;

/** @param {import('./store.js').Store} store @param {() => {width_px: number, height_px: number}} windowSize */
export function createSave(store, windowSize) {
  const dialog = byId('save', HTMLDialogElement);
  const form = /** @type {HTMLFormElement} */ (dialog.querySelector('form'));
  const [sizes, width, height] = ['size', 'width', 'height'].map((name) => /** @type {HTMLInputElement} */ (form.elements.namedItem(name)));
  const error = /** @type {HTMLElement} */ (form.querySelector('.error'));
  const progress = /** @type {HTMLElement} */ (form.querySelector('.progress'));
  const elapsed = /** @type {HTMLElement} */ (progress.querySelector('span'));
  const buttons = /** @type {NodeListOf<HTMLButtonElement>} */ (form.querySelectorAll('[data-save]'));
  /** @type {AbortController | null} */
  let work = null;

  const fill = () => {
    const { width_px, height_px } = windowSize();
    const all = [[width_px, height_px], ...SIZES];
    sizes.replaceChildren(
      ...all.map(([w, hgt], i) => h('option', { value: `${w}x${hgt}` }, `${w} × ${hgt}${i === 0 ? ', as the window' : ''}`)),
      h('option', { value: '' }, 'Other'),
    );
    [width.valueAsNumber, height.valueAsNumber] = [width_px, height_px];
  };
  sizes.addEventListener('change', () => {
    if (sizes.value) [width.value, height.value] = sizes.value.split('x');
  });
  for (const input of [width, height]) input.addEventListener('input', () => (sizes.value = ''));

  const busy = (/** @type {boolean} */ isBusy) => {
    progress.hidden = !isBusy;
    for (const button of buttons) button.disabled = isBusy;
  };
  const save = async (/** @type {string} */ format) => {
    const controller = new AbortController();
    work = controller;
    error.hidden = true;
    busy(true);
    const start = performance.now();
    const tick = () => (elapsed.textContent = `Rendering, ${((performance.now() - start) / 1000).toFixed(1)} s`);
    tick();
    const timer = setInterval(tick, TICK_MS);
    try {
      const request = { scene: store.scene, width_px: width.valueAsNumber, height_px: height.valueAsNumber, format, quality: 'final' };
      const url = URL.createObjectURL(await postFrame(request, controller.signal));
      h('a', { href: url, download: `welkin.${format}` }).click();
      setTimeout(() => URL.revokeObjectURL(url), 60_000);
    } catch (cause) {
      if (controller.signal.aborted) return;
      error.textContent = /** @type {Error} */ (cause).message;
      error.hidden = false;
    } finally {
      clearInterval(timer);
      busy(false);
    }
  };
  form.addEventListener('submit', (event) => {
    event.preventDefault();
    save(event.submitter?.dataset.save ?? 'png');
  });
  form.querySelector('[value="cancel"]')?.addEventListener('click', () => dialog.close());
  dialog.addEventListener('close', () => work?.abort());
  return {
    open() {
      fill();
      error.hidden = true;
      dialog.showModal();
    },
  };
}
