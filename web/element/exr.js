// OpenEXR, read by npm's parse-exr: with it a module of its own, which a page loads only for such a picture.
import parseExr from 'parse-exr';

const float = 1015, rgba = 1023; // three.js's numbers

/**
 * As PFM, which the core reads; both begin with the lowest row. Throws where the file is damaged.
 * @param {Uint8Array} bytes
 * @returns {Uint8Array}
 */
export function exrToPfm(bytes) {
  const { data, width, height, format } = parseExr(bytes.slice().buffer, float);
  const channels = format === rgba ? 4 : 1;
  const light = new Float32Array(3 * width * height).map((_, i) => data[channels * Math.floor(i / 3) + (channels === 4 ? i % 3 : 0)]);
  const header = new TextEncoder().encode(`PF\n${width} ${height}\n-1\n`);
  const file = new Uint8Array(header.length + light.byteLength);
  file.set(header);
  file.set(new Uint8Array(light.buffer), header.length);
  return file;
}
