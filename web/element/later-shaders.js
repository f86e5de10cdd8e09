// Shaders that a page loads once a picture needs them.

/**
 * Puts vitrine-shaders.txt into a core's memory.
 * @param {{locateFile?: (name: string) => string, laterShaders?: string}} from where it is, if not beside the core, or its text
 * @returns {Promise<number>} where it is
 * @throws {Error} a sentence
 */
export async function placeShaders(core, { locateFile, laterShaders }) {
  const name = 'vitrine-shaders.txt';
  try {
    const response = laterShaders ? new Response(laterShaders) : await fetch(locateFile?.(name) ?? new URL('../vitrine-shaders.txt', import.meta.url));
    if (!response.ok) throw new Error(`the server answered ${response.status}; serve it beside vitrine-core.wasm`);
    const bytes = new Uint8Array(await response.arrayBuffer()).map((byte) => (byte === 12 ? 0 : byte)); // as vtRenderer_SetLaterShaders has it
    const place = core._malloc(bytes.length + 2);
    if (place === 0) throw new Error('out of memory');
    core.HEAPU8.set(bytes, place);
    core.HEAPU8.fill(0, place + bytes.length, place + bytes.length + 2);
    return place;
  } catch (reason) {
    throw new Error(`${name} cannot be loaded: ${reason.message}`, { cause: reason });
  }
}
