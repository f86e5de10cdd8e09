// Pictures of Basis Universal in KTX 2 (KHR_texture_basisu), by the transcoder that npm's three brings: with it a module of
// its own, and basis.wasm beside it, which a page loads only for such a picture.
import createBasis from 'basis-transcoder'; // web/CMakeLists.txt says where it is

const rgba = 13; // the transcoder's number of 32 bits a pixel
const largestSide = 2048; // VT_MAX_ARRAY_SIDE: a smaller level is as good

let loading = null;

function load() {
  const fetchIt = async () => {
    const response = await fetch(new URL('./basis.wasm', import.meta.url));
    if (!response.ok) throw new Error(`the server answered ${response.status} to basis.wasm`);
    const basis = await createBasis({ wasmBinary: await response.arrayBuffer() });
    basis.initializeBasis();
    return basis;
  };
  loading ??= fetchIt().catch((reason) => {
    loading = null;
    throw reason;
  });
  return loading;
}

/**
 * The largest level that materials have use for. Throws where it is damaged, or none of Basis Universal's of 8 bits.
 * @param {Uint8Array} bytes
 * @returns {Promise<ImageData>} top row first
 */
export async function ktxToPicture(bytes) {
  const basis = await load();
  const file = new basis.KTX2File(bytes);
  try {
    if (!file.isValid() || !file.startTranscoding()) throw new Error('not KTX 2 of Basis Universal, or damaged');
    let level = 0;
    while (level < file.getLevels() - 1 && Math.max(file.getWidth(), file.getHeight()) >> level > largestSide) ++level;
    const { origWidth, origHeight } = file.getImageLevelInfo(level, 0, 0);
    const pixels = new Uint8Array(file.getImageTranscodedSizeInBytes(level, 0, 0, rgba));
    if (pixels.length !== 4 * origWidth * origHeight || !file.transcodeImage(pixels, level, 0, 0, rgba, 0, -1, -1)) throw new Error('damaged');
    return new ImageData(new Uint8ClampedArray(pixels.buffer), origWidth, origHeight);
  } catch (reason) {
    if (reason instanceof WebAssembly.RuntimeError) loading = null; // its memory may be in disorder: the next picture gets a new transcoder
    throw reason;
  } finally {
    if (loading !== null) {
      file.close();
      file.delete();
    }
  }
}
