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

/** The numbers behind the picture. @param {any} request @returns {Promise<any>} */
export const postProbe = async (request) => (await post('v1/probe', request)).json();

/** The scene that a weather report tells. @param {{metar: string, date: string | null}} report @returns {Promise<any>} */
export const postReport = async (report) => (await post('v1/scenes/from-metar', report)).json();

/** Stops a job. @param {string} id */
export async function stopJob(id) {
  const response = await fetch(`v1/jobs/${id}`, { method: 'DELETE' });
  if (!response.ok) throw await failure(response);
}

const ASSETS = 'v1/assets';

/** @typedef {import('./assets.js').Kind} Kind */
/** @typedef {{name: string, bytes: number, sha256: string}} Asset */

/** What the server keeps of a kind. @param {Kind} kind @returns {Promise<Asset[]>} */
export const listAssets = async (kind) => (await getJson(`${ASSETS}/${kind}`)).assets;

/** @param {Kind} kind @param {string} name @returns {Promise<Blob>} */
export async function getAsset(kind, name) {
  const response = await fetch(`${ASSETS}/${kind}/${name}`);
  if (!response.ok) throw await failure(response);
  return response.blob();
}

/**
 * Stores a file. Where `isNew`, one that has the name stays, and the error's problem has the status 412.
 * @param {Kind} kind @param {string} name @param {Blob} file @param {{isNew?: boolean}} [options] @returns {Promise<Asset>}
 */
export async function putAsset(kind, name, file, { isNew = false } = {}) {
  const headers = { 'content-type': file.type || 'application/octet-stream', ...(isNew ? { 'if-none-match': '*' } : {}) };
  const response = await fetch(`${ASSETS}/${kind}/${name}`, { method: 'PUT', headers, body: file });
  if (!response.ok) throw await failure(response);
  return response.json();
}
