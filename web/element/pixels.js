// How many pixels an element has.
const largestDpr = 2; // canvas pixels per CSS pixel
const largestSide = 16384; // of a frame, as the core's table has it
const mostPixels = 2 ** 24; // 1 GB on the GPU, with its samples

/** Canvas pixels per CSS pixel: fewer where the picture would be larger than it may be. @param {HTMLElement} host */
export function dprOf({ clientWidth, clientHeight }) {
  const most = Math.min(largestSide / Math.max(1, clientWidth, clientHeight), Math.sqrt(mostPixels / Math.max(1, clientWidth * clientHeight)));
  return Math.min(window.devicePixelRatio, largestDpr, most);
}

/** Width and height at a share of the full resolution. @param {HTMLElement} host @param {number} scale */
export function sizeOf(host, scale) {
  return [host.clientWidth, host.clientHeight].map((side) => Math.max(1, Math.round(side * dprOf(host) * scale)));
}
