/** Drawers at the edge: one open at a time, each with a button in the bar. */
import { byId } from './dom.js';

/** @typedef {{opened?: () => void, closed?: () => void}} Drawer */

/** @param {Record<string, Drawer>} drawers By the id of their element; `open-` and the id is their button's @param {() => void} onOpen */
export function createDrawers(drawers, onOpen) {
  const parts = Object.entries(drawers).map(([id, events]) => {
    const element = byId(id, HTMLElement);
    return { id, element, events, button: byId(`open-${id}`, HTMLButtonElement) };
  });
  const show = (/** @type {string | null} */ shown) => {
    for (const { id, element, events, button } of parts) {
      const isOpen = id === shown;
      if (isOpen === !element.hidden) continue;
      element.hidden = !isOpen;
      button.setAttribute('aria-expanded', String(isOpen));
      if (isOpen) events.opened?.();
      else events.closed?.();
    }
    if (shown) onOpen();
  };
  for (const { id, element, button } of parts) {
    const close = () => {
      show(null);
      button.focus();
    };
    button.addEventListener('click', () => show(element.hidden ? id : null));
    element.querySelector('[data-close]')?.addEventListener('click', close);
    element.addEventListener('keydown', (event) => {
      if (event.key === 'Escape' && !event.defaultPrevented) close();
    });
  }
  return { show, close: () => show(null) };
}
