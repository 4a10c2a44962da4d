/** Copies the scene: as a link, as a `curl` command, as JSON. */
import { byId } from './dom.js';
import { toast } from './toast.js';

/** A POSIX shell's single quotes. @param {string} text */
const quoted = (text) => `'${text.replaceAll("'", "'\\''")}'`;

/** A command that works as it stands. @param {string} origin @param {any} request A frame request */
export function curlCommand(origin, request) {
  const url = new URL('v1/frames', origin).href;
  return [
    `curl --fail-with-body -sS -X POST ${quoted(url)}`,
    `-H 'content-type: application/json'`,
    `-o welkin.${request.format}`,
    `-d ${quoted(JSON.stringify(request))}`,
  ].join(' \\\n  ');
}

/** Where the browser keeps the clipboard to itself, the text is shown to be copied by hand. @param {string} text @param {string} what */
async function copy(text, what) {
  try {
    await navigator.clipboard.writeText(text);
    toast(`${what} copied`);
  } catch {
    const dialog = byId('text', HTMLDialogElement);
    const area = /** @type {HTMLTextAreaElement} */ (dialog.querySelector('textarea'));
    area.value = text;
    dialog.showModal();
    area.select();
  }
}

/**
 * @param {import('./store.js').Store} store @param {() => string} link
 * @param {() => {width_px: number, height_px: number}} size
 */
export function createShare(store, link, size) {
  const menu = byId('share', HTMLDivElement);
  /** @type {Record<string, [string, () => string]>} */
  const copies = {
    link: ['Link', link],
    curl: ['Command', () => curlCommand(document.baseURI, { scene: store.short(), ...size(), format: 'png' })],
    scene: ['Scene', () => JSON.stringify(store.scene, null, 2)],
  };
  menu.addEventListener('click', (event) => {
    const kind = /** @type {HTMLElement} */ (event.target).dataset.copy;
    if (!kind) return;
    menu.hidePopover();
    const [what, text] = copies[kind];
    copy(text(), what);
  });
}
