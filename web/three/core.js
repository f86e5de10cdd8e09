// The compiled module that draws in a context of three.js's (web/three/three.c), loaded once a page.
import createVitrine from '../vitrine-three.js';
import { placeShaders } from '../element/later-shaders.js';

let loading = null;
let shaders = null; // promise of where they are in the core's memory
let places = {}; // of the first loadCore

/** The module. A load that failed is tried again by the next call. @param {{locateFile?: (name: string) => string, wasmBinary?: BufferSource}} from where the wasm is, if not beside this */
export function loadCore(from) {
  if (!loading) {
    places = from;
    const wasm = () => new URL('../vitrine-three.wasm', import.meta.url).href;
    loading = createVitrine({ locateFile: (name) => from.locateFile?.(name) ?? wasm(), wasmBinary: from.wasmBinary }).catch((reason) => {
      loading = null;
      throw new Error(`vitrine-three.wasm cannot be loaded: ${reason.message}`, { cause: reason });
    });
  }
  return loading;
}

/** Words in the core's memory that grow as they must, kept from frame to frame. */
class Words {
  #core;
  #capacity = 0;
  place = 0;

  constructor(core) {
    this.#core = core;
  }

  /** At least so many words, what they hold kept only if there were as many. @param {number} count @returns {{floats: Float32Array, words: Uint32Array}} */
  reserve(count) {
    if (count > this.#capacity || !this.place) {
      this.#core._free(this.place);
      this.#capacity = Math.max(count, 1);
      this.place = this.#core._malloc(4 * this.#capacity);
    }
    if (!this.place) throw new Error('out of memory');
    const { buffer } = this.#core.HEAPU8;
    return { floats: new Float32Array(buffer, this.place, this.#capacity), words: new Uint32Array(buffer, this.place, this.#capacity) };
  }

  free() {
    this.#core._free(this.place);
    this.place = this.#capacity = 0;
  }
}

const frameWords = 44; // of vtThreeFrame
const namesOfGl = ['framebuffers', 'textures', 'textures']; // frame's, in the order of Core.draw

/** A renderer in that context, and the calls of web/three/three.c. */
export class Core {
  #module;
  #context; // Emscripten's handle
  #three; // address of the vtThree
  #names; // of GL objects of three.js's, in Emscripten's tables

  /** @param module from loadCore @param {WebGL2RenderingContext} gl @throws {Error} where the renderer cannot start */
  constructor(module, gl) {
    this.#module = module;
    this.#context = module.GL.registerContext(gl, { majorVersion: 2, minorVersion: 0, enableExtensionsByDefault: false });
    module.GL.makeContextCurrent(this.#context);
    gl.getExtension('KHR_parallel_shader_compile');
    this.#three = module.ccall('vtThree_Create', 'number', [], []);
    const problem = this.#three === 0 ? 'out of memory' : this.problem();
    if (problem) throw new Error(problem);
    this.isGone = false;
    this.#names = namesOfGl.map((table) => module.GL.getNewId(module.GL[table]));
    this.frame = new Words(module);
    this.objects = new Words(module);
    this.materials = new Words(module);
  }

  /** Gives everything back, but what three.js made. */
  destroy() {
    this.isGone = true;
    this.call('Destroy');
    const { GL } = this.#module;
    this.#names.forEach((name, i) => (GL[namesOfGl[i]][name] = null));
    for (const words of [this.frame, this.objects, this.materials]) words.free();
    GL.deleteContext(this.#context);
    GL.makeContextCurrent(0);
  }

  call(name, ...values) {
    this.#module.GL.makeContextCurrent(this.#context);
    const types = values.map((value) => (typeof value === 'string' ? 'string' : 'number'));
    return this.#module.ccall(`vtThree_${name}`, 'number', ['number', ...types], [this.#three, ...values]);
  }

  /** A call that answers with a sentence, or nothing. @throws {Error} that sentence */
  attempt(name, ...values) {
    const problem = this.#module.UTF8ToString(this.call(name, ...values));
    if (problem) throw new Error(problem);
  }

  problem() {
    return this.#module.UTF8ToString(this.call('Error'));
  }

  /** Numbers in memory that a call takes over; 0 of null. @param {?ArrayBufferView} numbers */
  place(numbers) {
    if (!numbers) return 0;
    const place = this.#module._malloc(numbers.byteLength || 1);
    if (!place) throw new Error('out of memory');
    this.#module.HEAPU8.set(new Uint8Array(numbers.buffer, numbers.byteOffset, numbers.byteLength), place);
    return place;
  }

  free(place) {
    this.#module._free(place);
  }

  /** Loads what the last frame lacked, and makes it known. @throws {Error} a sentence */
  async loadShaders() {
    shaders ??= placeShaders(this.#module, places).catch((reason) => {
      shaders = null;
      throw reason;
    });
    const place = await shaders;
    if (!this.isGone) this.attempt('SetShaders', place);
  }

  /**
   * Draws what was placed.
   * @param {{view: number[], projection: number[], width: number, height: number, framebuffer: WebGLFramebuffer, color: WebGLTexture, depth: WebGLTexture, exposure: number, samples: number, preset: number, maxEvents: number, branches: number, fresnel: boolean, levels: boolean}} frame
   * @returns {number} as vtThree_Draw
   */
  draw({ view, projection, width, height, framebuffer, color, depth, exposure, samples, preset, maxEvents, branches, fresnel, levels }) {
    const { GL } = this.#module;
    [framebuffer, color, depth].forEach((object, i) => (GL[namesOfGl[i]][this.#names[i]] = object));
    const { floats, words } = this.frame.reserve(frameWords);
    floats.set(view, 0);
    floats.set(projection, 16);
    words.set([width, height, ...this.#names], 32);
    floats[37] = exposure;
    words.set([samples, preset, maxEvents, branches, Number(fresnel), Number(levels)], 38);
    const gl = GL.getContext(this.#context).GLctx;
    const buffer = gl.getIndexedParameter(gl.UNIFORM_BUFFER_BINDING, 0); // three.js sets it once, the core each frame
    const answer = this.call('Draw', this.frame.place);
    gl.bindBufferBase(gl.UNIFORM_BUFFER, 0, buffer);
    return answer;
  }
}
