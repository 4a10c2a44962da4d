/** Short messages over the picture; they also reach screen readers. */
import { byId, h } from './dom.js';

const SHOWN_MS = 6000;
/** Faults, and what can be undone, are there for longer. */
const LASTING_MS = 30_000;
const MOST = 3;

/** Says something to a screen reader alone. @param {string} message */
export function announce(message) {
  const region = byId('announcer', HTMLParagraphElement);
  if (region.textContent !== message) region.textContent = message;
}

/** @param {string} message @param {{bad?: boolean, action?: {name: string, act: () => void}}} [options] */
export function toast(message, { bad = false, action } = {}) {
  const list = byId('toasts', HTMLDivElement);
  const close = h('button', { type: 'button', 'aria-label': 'Dismiss', class: 'quiet', onclick: () => element.remove() }, '×');
  const act = () => {
    element.remove();
    action?.act();
  };
  const button = action ? h('button', { type: 'button', onclick: act }, action.name) : null;
  const element = h('div', { class: `toast glass ${bad ? 'bad' : ''}`, role: bad ? 'alert' : 'status' }, h('span', {}, message), button, close);
  for (const same of list.children) if (same.firstChild?.textContent === message) same.remove();
  while (list.children.length >= MOST) list.firstChild?.remove();
  list.append(element);
  setTimeout(() => element.remove(), action || bad ? LASTING_MS : SHOWN_MS);
}
