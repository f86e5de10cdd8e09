// The compiled modules, each loaded once a page: vitrine-core, and vitrine-full for elements that need a ground, a backdrop,
// a panel or animations; and one Viewer (web/core/viewer.c) for each element.
import createVitrine from '../vitrine-core.js';
import { attributes } from './attributes.js';
import { Context } from './context.js';
import { openInCore, placePicture } from './picture.js';

/** Elements out of view keep what they have on the GPU until all hold more than that, bytes. */
const mostBytes = 2 ** 27;

const contexts = new Map(); // of all viewers, by their module; only those that there are viewers of
const numbers = new WeakMap(); // of a part's contents, by which the core knows them again
let lastNumber = 0;
const loading = new Map(); // promises of the modules, by isFull
let places = {}; // of the last loadCore
const shaders = new WeakMap(); // promises of where they are in a module's memory

/** What the map has for that key, else what `make` promises; a promise that fails is forgotten, and made anew by the next call. */
function remember(map, key, make) {
  if (!map.has(key)) {
    map.set(key, make().catch((reason) => {
      map.delete(key);
      throw reason;
    }));
  }
  return map.get(key);
}

async function loadFull(locateFile) {
  const { default: create } = await import('../vitrine-full.js');
  return create(locateFile ? { locateFile } : {});
}

/**
 * The module. A load that failed is tried again by the next call.
 * @param {{locateFile?: (name: string) => string, wasmBinary?: BufferSource, laterShaders?: string}} from where the wasm and the shaders are, if not beside this; wasmBinary is vitrine-core.wasm's
 * @param {boolean} isFull with all of that
 */
export function loadCore(from = {}, isFull = false) {
  const { locateFile, wasmBinary } = (places = from);
  const wasm = () => new URL('../vitrine-core.wasm', import.meta.url).href;
  return remember(loading, isFull, () => (isFull ? loadFull(locateFile) : createVitrine({ locateFile: (name) => locateFile?.(name) ?? wasm(), wasmBinary })));
}

let lastTask = Promise.resolve();

/** A task of its own for each who asks, so that many elements do not make their scenes in one. @returns {Promise<void>} */
export function ownTask() {
  lastTask = lastTask.then(() => new Promise((done) => setTimeout(done)));
  return lastTask;
}

/** vitrine-shaders.txt, which most pages need not: once, unless that failed. @returns {Promise<number>} where it is in the core's memory */
function loadShaders(core) {
  return remember(shaders, core, async () => (await import('./later-shaders.js')).placeShaders(core, places));
}

/** What is held at present, for measurements, what of the files that are shown is left out or changed, and how the elements are drawn that move in less than full quality. */
export async function coreStatistics() {
  const cores = await Promise.all(loading.values());
  const viewers = [...contexts.values()].flatMap(({ drawers }) => [...drawers]).filter(({ isLost }) => !isLost);
  const heapBytes = cores.reduce((sum, { HEAPU8 }) => sum + HEAPU8.length, 0);
  const gpuBytes = viewers.reduce((sum, { bytes }) => sum + bytes, 0);
  const lessened = viewers.flatMap((viewer) => viewer.lessened ?? []);
  return { contexts: contexts.size, viewers: viewers.length, gpuBytes, heapBytes, warnings: viewers.flatMap(({ notes }) => notes), lessened };
}

const { values: wallsNames } = attributes.find(({ attribute }) => attribute === 'walls'); // in the order of vtWalls
const noGround = Array(14).fill(0); // of vtViewer_SetGround
const workAtOnce = 20000; // triangles looked at: a few milliseconds

/** Those out of view that were seen longest ago give back what they have, until all hold no more than they may. */
function makeRoom(context, newest) {
  const sizes = [...context.drawers].filter((viewer) => viewer !== newest).map((viewer) => [viewer, viewer.bytes]);
  let sum = sizes.reduce((total, [, bytes]) => total + bytes, 0);
  for (const [viewer, bytes] of sizes) {
    if (sum <= mostBytes) return;
    if (viewer.told.crowded()) sum -= bytes;
  }
}

/** A renderer in the page's context, and the calls of web/core/viewer.c. */
export class Viewer {
  #core;
  #context;
  #viewer = 0; // address of the vtViewer; 0 while the context is lost
  /** @type {object|null} detail of render-scale where less is drawn than at rest */
  lessened = null;

  /**
   * @param core from loadCore
   * @param {object} told
   * @param {() => void} told.lost the context, and all that was in it
   * @param {(problem: string) => void} told.restored all has to be given to it again; problem: a sentence where that cannot be
   * @param {() => boolean} told.crowded memory runs short; true if it destroyed this viewer
   * @throws {Error} where the browser has no WebGL 2 or the renderer cannot start
   */
  constructor(core, told) {
    this.told = told;
    this.#core = core;
    if (!contexts.has(core)) contexts.set(core, new Context(core));
    const context = (this.#context = contexts.get(core));
    try {
      if (context.isLost) context.renew();
      context.drawers.add(this);
      makeRoom(context, this);
      this.#start();
    } catch (reason) {
      this.destroy();
      throw reason;
    }
  }

  get gl() {
    return this.#context.gl;
  }

  get isLost() {
    return this.#viewer === 0;
  }

  #start() {
    this.#context.makeCurrent();
    this.gl.getExtension('KHR_parallel_shader_compile'); // where there is one, the core asks when shaders are ready
    const other = [...this.#context.drawers].find((viewer) => !viewer.isLost);
    this.#viewer = this.#core.ccall('vtViewer_Create', 'number', ['number', 'number', 'number'], [1, 1, other?.address ?? 0]);
    const problem = this.#viewer === 0 ? 'out of memory' : this.problem();
    if (problem) throw new Error(problem);
  }

  #stop() {
    if (this.#viewer === 0) return;
    this.#context.makeCurrent();
    this.#core.ccall('vtViewer_Destroy', null, ['number'], [this.#viewer]);
    this.#viewer = 0;
  }

  get address() {
    return this.#viewer;
  }

  onLost() {
    if (this.isLost) return;
    this.#stop();
    this.told.lost();
  }

  onRestored() {
    try {
      this.#start();
      this.told.restored('');
    } catch (reason) {
      this.told.restored(reason.message);
    }
  }

  /** The element is in view again: should the context be lost, there is another. */
  seen() {
    const { drawers } = this.#context;
    drawers.delete(this); // the last to be asked for room
    drawers.add(this);
    if (this.isLost) this.#context.renew();
  }

  /** Gives everything back. */
  destroy() {
    this.#stop();
    this.#context.drawers.delete(this);
    this.#context.leave(this);
    if (this.#context.drawers.size > 0) return;
    this.#context.destroy();
    contexts.delete(this.#core);
  }

  /** As Context.enter: `act` may draw then, until `leave`. */
  enter(isUrgent, act) {
    this.#context.enter(this, isUrgent, act);
  }

  leave() {
    this.#context.leave(this);
  }

  /** Draws the next sample of a picture of that size, if there is anything to draw. @returns {number} as vtViewer_Tick */
  draw(width, height) {
    this.#context.resize(width, height);
    return this.call('Tick');
  }

  /** What has been drawn is shown on a canvas. */
  showOn(canvas) {
    this.#context.show(canvas);
  }

  /** On the GPU. */
  get bytes() {
    return this.isLost ? 0 : this.call('Bytes');
  }

  call(name, ...values) {
    this.#context.makeCurrent();
    const types = values.map((value) => (typeof value === 'string' ? 'string' : 'number'));
    return this.#core.ccall(`vtViewer_${name}`, 'number', ['number', ...types], [this.#viewer, ...values]);
  }

  /** Is it vitrine-full's, with all calls? */
  get isFull() {
    return '_vtViewer_SetGround' in this.#core;
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
    return (this.isFull && this.attempt('SetGround', ...ground)) || this.attempt('SetGlass', technique ?? '', Number(lessened));
  }

  /** As attempt, for a call that takes the contents of a file over. @param {import('./loading.js').Source} source */
  attemptFile(name, source) {
    this.#context.makeCurrent();
    const more = source.spec === undefined ? [] : [source.spec, this.#numberOf(source.contents)];
    const open = (call, ...values) => {
      try {
        return this.attempt(call, ...values, source.name, ...more);
      } catch { // C++ found no memory, and that module does not get back what it had: who loads next has another one
        loading.clear();
        return null;
      }
    };
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

  /** Of the files that are shown, in their order. @returns {{name: string, duration: number, isFirst: boolean}[]} isFirst: of its file */
  get animations() {
    const all = [];
    if (!this.isFull) return all;
    for (let place; (place = this.call('AnimationName', all.length)) !== 0;) {
      const name = this.#core.UTF8ToString(place), duration = this.call('AnimationDuration', all.length);
      all.push({ name, duration, isFirst: this.call('AnimationIsFirst', all.length) === 1 });
    }
    return all;
  }

  /** Shows an animation, '': each file's first, at a time. @returns {string} a sentence, or '' */
  setTime({ name, seconds }) {
    return this.attempt('SetTime', name, seconds);
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
    if (this.isLost) return;
    const problem = this.attempt('SetShaders', place);
    if (!problem) return;
    shaders.delete(this.#core);
    throw new Error(problem);
  }

  problem() {
    return this.#core.UTF8ToString(this.call('Error'));
  }

  info() {
    return JSON.parse(this.#core.UTF8ToString(this.call('Info')));
  }

  /** @returns {object|null} a material of what is shown (vtViewer_Material); null past the last one */
  material(index) {
    const place = this.call('Material', index);
    return place === 0 ? null : JSON.parse(this.#core.UTF8ToString(place));
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
