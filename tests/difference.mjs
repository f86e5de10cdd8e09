// How far two pictures are apart, as tests and docs/robustness.md tell it.
import assert from 'node:assert/strict';

/**
 * Of two PNGs of the same size, alpha apart.
 * @returns {{mean: number, most: number, apart: number}} of a channel in the mean and at most, of 255; the share of pixels with a channel off by more than 8
 */
export function difference(a, b) {
  assert.deepEqual([a.width, a.height], [b.width, b.height]);
  let sum = 0, most = 0, apart = 0;
  for (let i = 0; i < a.data.length; i += 4) {
    const here = [0, 1, 2].map((k) => Math.abs(a.data[i + k] - b.data[i + k]));
    sum += here[0] + here[1] + here[2];
    most = Math.max(most, ...here);
    apart += Math.max(...here) > 8;
  }
  return { mean: sum / (0.75 * a.data.length), most, apart: apart / (a.data.length / 4) };
}
