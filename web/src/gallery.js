/** All ready-made scenes, each with a small picture that the server renders when it is looked for. */
import { byId, h } from './dom.js';

const [WIDTH, HEIGHT] = [192, 120];

/** @param {string} name */
const pictureOf = (name) => `v1/frames?${new URLSearchParams({ preset: name, width_px: String(WIDTH), height_px: String(HEIGHT), format: 'jpeg' })}`;

/**
 * Loads pictures one after another, so that a small server is not asked for all at once, and only those in sight.
 * @param {HTMLElement} scroller
 */
function createLoader(scroller) {
  /** @type {HTMLImageElement[]} */
  const waiting = [];
  let isBusy = false;
  const next = () => {
    const image = isBusy || scroller.hidden ? undefined : waiting.shift();
    if (!image) return;
    isBusy = true;
    const done = () => {
      isBusy = false;
      next();
    };
    image.addEventListener('load', done, { once: true });
    image.addEventListener('error', () => {
      image.closest('button')?.classList.add('blank');
      done();
    }, { once: true });
    image.src = image.dataset.src ?? '';
  };
  const watcher = new IntersectionObserver(
    (entries) => {
      for (const { target, isIntersecting } of entries) {
        const image = /** @type {HTMLImageElement} */ (target);
        const at = waiting.indexOf(image);
        if (isIntersecting && at < 0 && !image.src) waiting.push(image);
        else if (!isIntersecting && at >= 0) waiting.splice(at, 1);
      }
      next();
    },
    { root: scroller, rootMargin: '60px' },
  );
  return { watch: (/** @type {HTMLImageElement} */ image) => watcher.observe(image), next };
}

/** @param {import('./presets.js').Presets} presets */
export function createGallery(presets) {
  const drawer = byId('gallery', HTMLElement);
  const loader = createLoader(drawer);
  const cards = presets.all.map((preset) => {
    const image = h('img', { alt: '', width: WIDTH, height: HEIGHT, 'data-src': pictureOf(preset.name) });
    const card = h(
      'button',
      { type: 'button', class: 'card', 'data-gallery': preset.name, title: preset.description, onclick: () => presets.take(preset) },
      image, h('span', {}, preset.title),
    );
    loader.watch(image);
    return { preset, card };
  });
  const part = (/** @type {string} */ title, /** @type {boolean} */ cloudy) => {
    const own = cards.filter(({ preset }) => (preset.scene.clouds !== null) === cloudy).map(({ card }) => card);
    return own.length > 0 ? [h('h3', {}, title), h('div', { class: 'cards' }, ...own)] : [];
  };
  drawer.querySelector('.drawer-body')?.replaceChildren(...part('Clouds', true), ...part('Clear skies', false));
  return {
    opened: loader.next,
    update: () => cards.forEach(({ preset, card }) => card.setAttribute('aria-pressed', String(presets.isShown(preset)))),
  };
}
