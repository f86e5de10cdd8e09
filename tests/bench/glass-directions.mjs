// Directions as pictures and back, for glass.mjs. A direction image is 3 floats a pixel, bottom row first, as in the
// PFM of `vitrine render --directions`: (0,0,0) background, (2,2,2) lost.

const degrees = 180 / Math.PI;

export function readPfm(bytes) {
  const header = /^PF\n(\d+) (\d+)\n(-?[\d.]+)\n/.exec(bytes.toString('latin1', 0, 64));
  if (header === null || Number(header[3]) > 0) throw new Error('not a little-endian colour PFM');
  return new Float32Array(bytes.buffer.slice(bytes.byteOffset + header[0].length, bytes.byteOffset + bytes.length));
}

export function pfm(directions, size) {
  return Buffer.concat([Buffer.from(`PF\n${size} ${size}\n-1.0\n`), Buffer.from(directions.buffer, directions.byteOffset, directions.byteLength)]);
}

const toLinear = (value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);

/** Colours 0.5 + 0.5 d to unit directions: linear RGBA floats, bottom row first, or sRGB bytes of `size`, top row first. */
export function decode(pixels, size = 0) {
  const isFloat = pixels instanceof Float32Array;
  const count = pixels.length / 4;
  const directions = new Float32Array(3 * count);
  for (let i = 0; i < count; ++i) {
    const from = isFloat ? i : (size - 1 - Math.floor(i / size)) * size + (i % size);
    const color = [0, 1, 2].map((k) => (isFloat ? pixels[4 * from + k] : toLinear(pixels[4 * from + k] / 255)));
    const direction = color.map((value) => 2 * value - 1);
    const length = Math.hypot(...direction) || 1;
    direction.forEach((value, k) => (directions[3 * i + k] = value / length));
  }
  return directions;
}

/** Degrees between two direction images, pixel by pixel. */
function angles(a, b) {
  const found = new Float64Array(a.length / 3);
  for (let i = 0; i < found.length; ++i) {
    const [p, q] = [a, b].map((from) => from.subarray(3 * i, 3 * i + 3));
    const length = Math.hypot(...p) * Math.hypot(...q);
    const cosine = length > 0 ? (p[0] * q[0] + p[1] * q[1] + p[2] * q[2]) / length : -1;
    found[i] = Math.acos(Math.min(1, Math.max(-1, cosine))) * degrees;
  }
  return found;
}

const isBackground = (truth, i) => truth[3 * i] === 0 && truth[3 * i + 1] === 0 && truth[3 * i + 2] === 0;

export function background(truth) {
  let count = 0;
  for (let i = 0; i < truth.length / 3; ++i) count += isBackground(truth, i);
  return count;
}

/** Directions of the rays through the pixels' centres. */
export function cameraRays(size, { eye, target, fov }) {
  const subtract = (a, b) => a.map((value, k) => value - b[k]);
  const unit = (a) => a.map((value) => value / Math.hypot(...a));
  const cross = ([a, b, c], [d, e, f]) => [b * f - c * e, c * d - a * f, a * e - b * d];
  const forward = unit(subtract(target, eye));
  const right = unit(cross(forward, [0, 1, 0]));
  const up = cross(right, forward);
  const rays = new Float32Array(3 * size * size);
  const half = Math.tan(fov / 2 / degrees);
  for (let j = 0; j < size; ++j) {
    for (let i = 0; i < size; ++i) {
      const x = (((i + 0.5) / size) * 2 - 1) * half, y = (((j + 0.5) / size) * 2 - 1) * half;
      unit(forward.map((value, k) => value + x * right[k] + y * up[k])).forEach((value, k) => (rays[3 * (j * size + i) + k] = value));
    }
  }
  return rays;
}

/** Whether a pixel and its neighbours are all background, or, not wanted, none is: the silhouette is the rasterizer's to decide. */
function isInside(truth, size, i, wanted) {
  const x = i % size, y = Math.floor(i / size);
  return x > 0 && y > 0 && x < size - 1 && y < size - 1 && [0, -1, 1, -size, size].every((step) => isBackground(truth, i + step) === wanted);
}

/** How far decoded background pixels are from the camera's rays, whose directions are known. */
export function calibrate(directions, truth, rays, size) {
  const off = [...angles(directions, rays)].filter((_, i) => isInside(truth, size, i, true)).sort((a, b) => a - b);
  return { median: off[Math.floor(off.length / 2)] ?? null, largest: off[off.length - 1] ?? null };
}

const smooth = 15; // degrees

/**
 * Whether light through a pixel and through its neighbours leaves in about the same direction. Rasterizers place a point
 * to a sixteenth of a pixel or better: there that is 1 degree, elsewhere, as where one surface ends before another, a pixel
 * may go either way.
 */
function isSmooth(truth, size, i) {
  const [here, ...around] = [0, -1, 1, -size, size].map((step) => truth.subarray(3 * (i + step), 3 * (i + step) + 3));
  return isInside(truth, size, i, false) && around.every((there) => angles(here, there)[0] <= smooth);
}

/** How often a is within 2 degrees of b, of the judged pixels where the truth is smooth, but those lost in b. */
export function agreement(a, b, truth, judged, size) {
  const off = [...angles(a, b)].filter((_, i) => judged[i] && b[3 * i] !== 2 && isSmooth(truth, size, i));
  return { share: off.filter((angle) => angle <= 2).length / off.length, count: off.length };
}

/** Shares of the judged pixels that are right within 1 and 5 degrees, and the median angle. */
export function shares(directions, truth, judged) {
  const off = [...angles(directions, truth)].map((angle, i) => (directions[3 * i] === 2 ? 180 : angle)).filter((_, i) => judged[i]);
  const within = (limit) => off.filter((angle) => angle <= limit).length / off.length;
  return { within1: within(1), within5: within(5), medianAngle: off.sort((a, b) => a - b)[Math.floor(off.length / 2)] };
}

/** The environment 0.5 + 0.5 d as Radiance HDR without run lengths, for Vitrine in the browser. */
export function directionsHdr(width = 1024, height = 512) {
  const pixels = Buffer.alloc(4 * width * height);
  for (let j = 0; j < height; ++j) {
    const elevation = (0.5 - (j + 0.5) / height) * Math.PI;
    for (let i = 0; i < width; ++i) {
      const azimuth = ((i + 0.5) / width - 0.5) * 2 * Math.PI;
      const direction = [Math.cos(elevation) * Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation) * Math.sin(azimuth)];
      const color = direction.map((value) => 0.5 + 0.5 * value);
      const exponent = Math.floor(Math.log2(Math.max(...color))) + 1;
      color.forEach((value, k) => (pixels[4 * (j * width + i) + k] = Math.min(255, Math.floor((value * 256) / 2 ** exponent))));
      pixels[4 * (j * width + i) + 3] = exponent + 128;
    }
  }
  return Buffer.concat([Buffer.from(`#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`), pixels]);
}
