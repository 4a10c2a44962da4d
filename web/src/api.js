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
