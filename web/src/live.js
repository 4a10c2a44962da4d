/** The WebSocket to `/v1/live`, which comes back by itself. */

const FIRST_DELAY_MS = 250;
const LONGEST_DELAY_MS = 8000;

/** Twice as long each time, with some chance so that many pages do not return at once. @param {number} attempt */
export const backoffMs = (attempt, chance = Math.random()) =>
  Math.min(LONGEST_DELAY_MS, FIRST_DELAY_MS * 2 ** attempt) * (0.75 + 0.5 * chance);

/**
 * @typedef {object} LiveEvents
 * @property {() => void} opened
 * @property {(retryInMs: number) => void} lost
 * @property {(message: any) => void} text
 * @property {(buffer: ArrayBuffer) => void} binary
 */

/** @param {string} url @param {LiveEvents} events */
export function connectLive(url, events) {
  let attempt = 0;
  /** @type {WebSocket} */
  let socket;
  let timer = 0;
  const open = () => {
    clearTimeout(timer);
    socket = new WebSocket(url);
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      attempt = 0;
      events.opened();
    };
    socket.onmessage = ({ data }) => (typeof data === 'string' ? events.text(JSON.parse(data)) : events.binary(data));
    socket.onclose = () => {
      const delay = backoffMs(attempt++);
      events.lost(delay);
      timer = window.setTimeout(open, delay);
    };
  };
  window.addEventListener('online', () => socket.readyState === WebSocket.CLOSED && open());
  open();
  return {
    isOpen: () => socket.readyState === WebSocket.OPEN,
    /** @param {any} message */
    send: (message) => socket.send(JSON.stringify(message)),
  };
}
