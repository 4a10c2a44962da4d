/** HTTP calls. A refusal becomes an `Error` that has the problem (RFC 9457) and its message. */

/** @param {Response} response */
async function failure(response) {
  const isProblem = response.headers.get('content-type')?.startsWith('application/problem+json');
  const problem = isProblem ? await response.json() : {};
  const message = problem.detail ?? problem.title ?? `the server answered ${response.status} ${response.statusText}`;
  return Object.assign(new Error(message), { problem });
}

/** @param {string} path @returns {Promise<any>} */
export async function getJson(path) {
  const response = await fetch(path);
  if (!response.ok) throw await failure(response);
  return response.json();
}

/** @param {string} path @param {any} body @param {AbortSignal} [signal] */
async function post(path, body, signal) {
  const headers = { 'content-type': 'application/json' };
  const response = await fetch(path, { method: 'POST', headers, body: JSON.stringify(body), signal });
  if (!response.ok) throw await failure(response);
  return response;
}

/** @param {any} request @param {AbortSignal} signal @returns {Promise<Blob>} */
export const postFrame = async (request, signal) => (await post('v1/frames', request, signal)).blob();

/** The scene that a weather report tells. @param {{metar: string, date: string | null}} report @returns {Promise<any>} */
export const postReport = async (report) => (await post('v1/scenes/from-metar', report)).json();

/** Stops a job. @param {string} id */
export async function stopJob(id) {
  const response = await fetch(`v1/jobs/${id}`, { method: 'DELETE' });
  if (!response.ok) throw await failure(response);
}

const MAPS = 'v1/assets/weather-maps';

/** @typedef {{name: string, bytes: number, sha256: string, width_px: number, height_px: number}} Asset */

/** The weather maps that the server keeps. @returns {Promise<Asset[]>} */
export const listMaps = async () => (await getJson(MAPS)).assets;

/** @param {string} name @returns {Promise<Blob>} */
export async function getMap(name) {
  const response = await fetch(`${MAPS}/${name}`);
  if (!response.ok) throw await failure(response);
  return response.blob();
}

/**
 * Stores a weather map. Where `isNew`, one that has the name stays, and the error's problem has the status 412.
 * @param {string} name @param {Blob} file @param {{isNew?: boolean}} [options] @returns {Promise<Asset>}
 */
export async function putMap(name, file, { isNew = false } = {}) {
  const headers = { 'content-type': 'image/png', ...(isNew ? { 'if-none-match': '*' } : {}) };
  const response = await fetch(`${MAPS}/${name}`, { method: 'PUT', headers, body: file });
  if (!response.ok) throw await failure(response);
  return response.json();
}
