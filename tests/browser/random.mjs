/** Numbers that are the same in each run (mulberry32). @param {number} seed */
export function createRandom(seed) {
  let state = seed;
  const unit = () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
  return { unit, between: (/** @type {number} */ low, /** @type {number} */ high) => low + (high - low) * unit() };
}
