// PNG, JPEG, WebP and AVIF, which the browser decodes, OpenEXR, which exr.js does, and Basis Universal, which basis.js does; the core reads Radiance HDR and PFM only.

const largestTexture = 2048; // VT_MAX_ARRAY_SIDE
const largestRelief = 4096; // VT_MAX_RELIEF_SIDE

/**
 * What the core opens as environment: the decoded picture, or the bytes as they are where they hold none that the
 * browser knows, so that the core says what is wrong.
 * @param {Uint8Array} bytes
 * @returns {Promise<ImageBitmap|Uint8Array>}
 */
export async function decodePicture(bytes) {
  if (bytes[0] === 0x23 && bytes[1] === 0x3f) return bytes; // "#?" of Radiance HDR
  if (bytes[0] === 0x76 && bytes[1] === 0x2f) return import('./exr.js').then(({ exrToPfm }) => exrToPfm(bytes)).catch(() => bytes);
  const asInTheFile = { colorSpaceConversion: 'none', premultiplyAlpha: 'none' };
  const isKtx = bytes[0] === 0xab && bytes[1] === 0x4b;
  const source = isKtx ? import('./basis.js').then(({ ktxToPicture }) => ktxToPicture(bytes)) : Promise.resolve(new Blob([bytes]));
  return source.then((picture) => createImageBitmap(picture, asInTheFile)).catch(() => bytes);
}

/** Not where it begins as a .glb or .gltf does. @param {Uint8Array} bytes */
export function mayBePicture([first, second]) {
  return first !== 0x7b && !(first === 0x67 && second === 0x6c); // "{", "glTF"
}

/** As materials have them: no larger than the core keeps them. @returns {Promise<ImageBitmap|null>} null: not a picture */
export async function decodeTexture(bytes) {
  const picture = await decodePicture(bytes);
  if (!(picture instanceof ImageBitmap)) return null;
  const scale = largestTexture / Math.max(picture.width, picture.height);
  if (scale >= 1) return picture;
  const [resizeWidth, resizeHeight] = [picture.width, picture.height].map((side) => Math.max(1, Math.round(scale * side)));
  return createImageBitmap(picture, { resizeWidth, resizeHeight, resizeQuality: 'high', colorSpaceConversion: 'none', premultiplyAlpha: 'none' });
}

/**
 * Puts a file into the core's memory and opens it there.
 * @param core the compiled module
 * @param {WebGL2RenderingContext} gl
 * @param {string} name of the call of web/core/viewer.c, for bytes; that for pictures ends in Picture
 * @param {Uint8Array|ImageBitmap} contents
 * @param {(name: string, ...values: number[]) => unknown} open makes the call
 * @returns what `open` returns; null where memory is out
 */
export function openInCore(core, gl, name, contents, open) {
  const isPicture = contents instanceof ImageBitmap;
  const { width, height } = contents;
  const pictureName = name.replace(/[A-Z][a-z]+$/, 'Picture');
  if (name.startsWith('Add') && Math.max(width, height) > largestRelief) return open(pictureName, 0, width, height); // refused without its pixels
  const size = isPicture ? 4 * width * height : contents.length;
  const place = core._malloc(size || 1);
  if (place === 0) return null;
  if (!isPicture) {
    core.HEAPU8.set(contents, place);
    return open(name, place, size);
  }
  readPicture(gl, contents, core.HEAPU8, place);
  return open(pictureName, place, width, height);
}

/** Copies a decoded picture into the core's memory. @returns {number} where; 0: memory is out */
export function placePicture(core, gl, picture) {
  const place = core._malloc(4 * picture.width * picture.height);
  if (place !== 0) readPicture(gl, picture, core.HEAPU8, place);
  return place;
}

/** Its RGBA bytes, untouched by alpha, which a 2D canvas would multiply in. */
function readPicture(gl, picture, heap, place) {
  const { width, height } = picture;
  if (Math.max(width, height) > gl.getParameter(gl.MAX_TEXTURE_SIZE)) return; // the core refuses it
  const texture = gl.createTexture(), framebuffer = gl.createFramebuffer();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, picture);
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, heap, place);
  gl.deleteFramebuffer(framebuffer);
  gl.deleteTexture(texture);
}
