/** Sends the map to the server while it is painted: the latest one, one at a time, and not too often. */

const REST_MS = 200;

/**
 * @param {() => Promise<void>} send Sends the map as it is
 * @param {(error: Error) => void} failed
 * @param {number} [restMs] Between the end of one and the beginning of the next
 */
export function createPublisher(send, failed, restMs = REST_MS) {
  let isDue = false;
  /** @type {Promise<void> | null} */
  let work = null;
  const run = async () => {
    while (isDue) {
      isDue = false;
      try {
        await send();
      } catch (error) {
        isDue = false;
        failed(/** @type {Error} */ (error));
      }
      await new Promise((resolve) => setTimeout(resolve, restMs));
    }
    work = null;
  };
  return {
    /** The map has changed. The promise ends when the server has it, or has refused it. */
    changed() {
      isDue = true;
      work ??= run();
      return work;
    },
  };
}
