// The compiled module, loaded once a page, and one Viewer (web/core/viewer.c) for each canvas.
import createVitrine from '../vitrine-core.js';
import { attributes } from './attributes.js';
import { placeShaders } from './later-shaders.js';
import { openInCore, placePicture } from './picture.js';

/** Browsers keep about 16 contexts; some are left to the rest of the page. */
const mostContexts = 12;

const viewers = new Set(); // those with a context
const numbers = new WeakMap(); // of a part's contents, by which the core knows them again
let lastNumber = 0;
let loading = null;
let places = {}; // of the last loadCore
let shaders = null; // promise of where they are in the core's memory

/**
 * The module. A load that failed is tried again by the next call.
 * @param {{locateFile?: (name: string) => string, wasmBinary?: BufferSource, laterShaders?: string}} from where the wasm and the shaders are, if not beside this
 */
export function loadCore(from = {}) {
  const { locateFile, wasmBinary } = (places = from);
  const wasm = () => new URL('../vitrine-core.wasm', import.meta.url).href;
  loading ??= createVitrine({ locateFile: (name) => locateFile?.(name) ?? wasm(), wasmBinary }).catch((reason) => {
    loading = null;
    throw reason;
  });
  return loading;
}

/** vitrine-shaders.txt, which most pages need not: once, unless that failed. @returns {Promise<number>} where it is in the core's memory */
function loadShaders(core) {
  shaders ??= placeShaders(core, places).catch((reason) => {
    shaders = null;
    throw reason;
  });
  return shaders;
}

/** What is held at present, for measurements, what of the files that are shown is left out or changed, and how the elements are drawn that move in less than full quality. */
export async function coreStatistics() {
  const core = await loading;
  const seen = [...viewers].filter(({ isLost }) => !isLost);
  const lessened = seen.flatMap((viewer) => viewer.lessened ?? []);
  return { contexts: viewers.size, heapBytes: core?.HEAPU8.length ?? 0, warnings: seen.flatMap(({ notes }) => notes), lessened };
}

const { values: wallsNames } = attributes.find(({ attribute }) => attribute === 'walls'); // in the order of vtWalls
const noGround = Array(14).fill(0); // of vtViewer_SetGround
const workAtOnce = 20000; // triangles looked at: a few milliseconds

/** A context, the renderer in it, and the calls of web/core/viewer.c. */
export class Viewer {
  #core;
  #canvas;
  #context; // Emscripten's handle
  #viewer = 0; // address of the vtViewer; 0 while the context is lost
  /** @type {object|null} detail of render-scale where less is drawn than at rest */
  lessened = null;

  /**
   * @param core from loadCore
   * @param {HTMLCanvasElement} canvas without a context
   * @param {() => boolean} onCrowded asked when contexts run short; true if it destroyed this viewer
   * @throws {Error} where the browser has no WebGL 2 or the renderer cannot start
   */
  constructor(core, canvas, onCrowded) {
    this.onCrowded = onCrowded;
    for (const other of [...viewers]) {
      if (viewers.size < mostContexts) break;
      other.onCrowded();
    }
    this.#core = core;
    this.#canvas = canvas;
    this.#context = core.GL.createContext(canvas, {
      majorVersion: 2,
      alpha: true,
      premultipliedAlpha: false,
      antialias: false,
      depth: false,
      stencil: false,
      preserveDrawingBuffer: false,
      powerPreference: 'high-performance',
    });
    if (!this.#context) {
      throw new Error('This browser opens no WebGL 2 context; turn hardware acceleration on or try another browser');
    }
    viewers.add(this);
    try {
      this.start();
    } catch (reason) {
      this.destroy();
      throw reason;
    }
  }

  get gl() {
    return this.#core.GL.getContext(this.#context).GLctx;
  }

  get isLost() {
    return this.#viewer === 0;
  }

  /** At first and after the context was restored. */
  start() {
    this.#core.GL.makeContextCurrent(this.#context);
    this.gl.getExtension('KHR_parallel_shader_compile'); // where there is one, the core asks when shaders are ready
    this.#viewer = this.#core.ccall('vtViewer_Create', 'number', ['number', 'number'], [1, 1]);
    const problem = this.#viewer === 0 ? 'out of memory' : this.problem();
    if (problem) throw new Error(problem);
  }

  /** The context is lost: so is everything in it. */
  stop() {
    this.#core.GL.makeContextCurrent(this.#context);
    if (this.#viewer !== 0) this.#core.ccall('vtViewer_Destroy', null, ['number'], [this.#viewer]);
    this.#viewer = 0;
  }

  /** Gives everything back; the canvas cannot be used again. */
  destroy() {
    const { gl } = this;
    this.stop();
    viewers.delete(this);
    this.#core.GL.deleteContext(this.#context);
    this.#core.GL.makeContextCurrent(0);
    if (!gl.isContextLost()) gl.getExtension('WEBGL_lose_context')?.loseContext(); // now, not when garbage is collected
    this.#canvas.width = this.#canvas.height = 0;
  }

  call(name, ...values) {
    this.#core.GL.makeContextCurrent(this.#context);
    const types = values.map((value) => (typeof value === 'string' ? 'string' : 'number'));
    return this.#core.ccall(`vtViewer_${name}`, 'number', ['number', ...types], [this.#viewer, ...values]);
  }

  /** A call that answers with a sentence, or nothing; returns that sentence or ''. */
  attempt(name, ...values) {
    return this.#core.UTF8ToString(this.call(name, ...values));
  }

  /**
   * Settings by their names in the core's table (src/technique/settings.c), a word by its attribute's list; null: as the preset or each object says; technique null: as the scene has it; background as readBackground.
   * @returns {string} a sentence, or ''
   */
  setGlass({ technique, lessened, ground = noGround, background: { kind, color } = { kind: 1, color: [0, 0, 0] }, ...settings }) {
    for (const [name, value] of Object.entries(settings)) {
      const words = attributes.find(({ attribute }) => attribute === name)?.values;
      this.call('Set', name, words ? words.indexOf(value) : Number(value));
    }
    this.call('SetBackground', kind, ...color);
    return this.attempt('SetGround', ...ground) || this.attempt('SetGlass', technique ?? '', Number(lessened));
  }

  /** As attempt, for a call that takes the contents of a file over. @param {import('./loading.js').Source} source */
  attemptFile(name, source) {
    this.#core.GL.makeContextCurrent(this.#context);
    const more = source.spec === undefined ? [] : [source.spec, this.#numberOf(source.contents)];
    const open = (call, ...values) => this.attempt(call, ...values, source.name, ...more);
    return openInCore(this.#core, this.gl, name, source.contents, open) ?? `${source.name}: too large for the memory of this page`;
  }

  #numberOf(contents) {
    if (!numbers.has(contents)) numbers.set(contents, ++lastNumber);
    return numbers.get(contents);
  }

  /** Adds a part to the scene that was begun; heights that the core keeps are not put into its memory again. */
  #add({ kind, name, contents, spec, variants }, { walls, variantName }) {
    if (contents === null) return this.attempt('AddShape', name, spec);
    const number = this.#numberOf(contents);
    if (this.call('Keeps', spec, number)) return this.attempt('AddRelief', 0, 0, name, spec, number);
    this.call('Expect', wallsNames.indexOf(walls), variants?.includes(variantName) ? variantName : '');
    return this.attemptFile(kind === 'relief' ? 'AddRelief' : 'AddModel', { name, contents, spec });
  }

  /** Begins a scene of these parts; it is not shown yet. @param {import('./loading.js').Source[]} parts @param {{walls?: string, variantName?: string}} looks of files @returns {string} a sentence, or '' */
  begin(parts, looks = {}) {
    this.images = []; // that the browser must decode
    this.call('Begin');
    for (const part of parts) {
      const first = this.call('ImageCount');
      const problem = this.#add(part, looks);
      if (problem) return problem;
      for (let index = first; index < this.call('ImageCount'); ++index) {
        const place = this.call('ImageBytes', index);
        const bytes = this.#core.HEAPU8.slice(place, place + this.call('ImageSize', index));
        if (place !== 0) this.images.push({ index, bytes, name: `${part.name}: image ${index - first}` });
      }
    }
    return '';
  }

  /** Shows the scene that was begun. @param {Map<number, ImageBitmap>} pictures its images, decoded; white without @returns {string} a sentence, or '' */
  show(pictures) {
    for (const [index, picture] of pictures) {
      const place = placePicture(this.#core, this.gl, picture);
      if (place !== 0) this.call('SetImage', index, place, picture.width, picture.height);
    }
    return this.attempt('Show');
  }

  /** What of the files that are shown is left out or changed. @returns {string[]} sentences */
  get notes() {
    return this.attempt('Notes').split('\n').filter(Boolean);
  }

  /** Goes on with what the scene that was begun is searched by, for some milliseconds. @returns {boolean} it is whole, or cannot be */
  build(milliseconds) {
    const end = performance.now() + milliseconds;
    let isWhole;
    do isWhole = this.call('Build', workAtOnce) === 1;
    while (!isWhole && performance.now() < end);
    return isWhole;
  }

  get lacksShaders() {
    return this.call('LacksShaders') === 1;
  }

  /** Loads what the last frame lacked. @throws {Error} a sentence */
  async loadShaders() {
    const place = await loadShaders(this.#core);
    if (this.isLost || !viewers.has(this)) return;
    const problem = this.attempt('SetShaders', place);
    if (!problem) return;
    shaders = null;
    throw new Error(problem);
  }

  problem() {
    return this.#core.UTF8ToString(this.call('Error'));
  }

  info() {
    return JSON.parse(this.#core.UTF8ToString(this.call('Info')));
  }

  /** The exact path through a pixel (vtViewer_Path); throws the sentence where it fails. */
  path(x, y) {
    const place = this.call('Path', x, y);
    if (place === 0) throw new Error(this.problem());
    return JSON.parse(this.#core.UTF8ToString(place));
  }

  /** The present view and settings at that size, RGBA, top row first; throws the sentence where it fails. */
  image(width, height) {
    const place = this.call('Image', width, height);
    if (place === 0) throw new Error(this.problem());
    return new ImageData(new Uint8ClampedArray(this.#core.HEAPU8.slice(place, place + 4 * width * height)), width, height);
  }
}
