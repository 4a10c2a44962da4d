/** HTTP calls. A refusal becomes an `Error` whose message is the problem's (RFC 9457). */

/** @param {Response} response */
async function failure(response) {
  const isProblem = response.headers.get('content-type')?.startsWith('application/problem+json');
  const problem = isProblem ? await response.json() : {};
  return new Error(problem.detail ?? problem.title ?? `the server answered ${response.status} ${response.statusText}`);
}

/** @param {string} path @returns {Promise<any>} */
export async function getJson(path) {
  const response = await fetch(path);
  if (!response.ok) throw await failure(response);
  return response.json();
}

/** @param {any} request @param {AbortSignal} signal @returns {Promise<Blob>} */
export async function postFrame(request, signal) {
  const response = await fetch('v1/frames', {
    method: 'POST',
    headers: { 'content-type': 'application/json' },
    body: JSON.stringify(request),
    signal,
  });
  if (!response.ok) throw await failure(response);
  return response.blob();
}
