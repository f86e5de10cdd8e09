// Glass in a scene of three.js's: `glass.render(scene, camera)` in place of `renderer.render(scene, camera)`.
import { Color, Matrix4, SRGBColorSpace, Vector4 } from 'three';
import { Core, loadCore } from './core.js';
import { Environment } from './environment.js';
import { Geometries } from './geometry.js';
import { Objects } from './objects.js';
import { Output } from './output.js';
import { Pictures } from './pictures.js';

const presets = ['low', 'medium', 'high'];
const buildTime = 8; // milliseconds a frame, for geometry that is new

/** Why a renderer cannot be used; ''. */
function problemOf(renderer) {
  if (renderer?.isWebGPURenderer) return 'WebGPURenderer has no WebGL 2 context to draw into; use WebGLRenderer';
  if (!renderer?.isWebGLRenderer) return "a WebGLRenderer of three.js's is needed";
  if (renderer.getContext().isContextLost()) return 'the context of the renderer is lost; call it again once it is restored';
  const name = ['logarithmicDepthBuffer', 'reversedDepthBuffer'].find((one) => renderer.capabilities[one]);
  return name ? `the renderer has a ${name}, along which no ray can be followed; create it without` : '';
}

/** An option's value. @throws {RangeError} a sentence */
function check(name, value, low, high) {
  if (Number.isInteger(value) && value >= low && value <= high) return value;
  throw new RangeError(`createGlass: ${name} is ${value}; it must be a whole number from ${low} to ${high}`);
}

function readOptions({ preset = 'medium', samples = 1, maxEvents = 0, branches = 0, fresnel = true }) {
  if (!presets.includes(preset)) throw new RangeError(`createGlass: preset is '${preset}'; it must be one of ${presets.join(', ')}`);
  return { preset: presets.indexOf(preset), samples: check('samples', samples, 1, 4096), maxEvents: check('maxEvents', maxEvents, 0, 64), branches: check('branches', branches, -1, 4), fresnel: Boolean(fresnel) };
}

/** As browsers do. */
const canvasSamples = (renderer) => (renderer.getContext().getContextAttributes().antialias ? 4 : 0);

class Glass {
  #renderer;
  #module;
  #core = null; // null: the context is lost, or it was disposed
  #options;
  #output;
  #objects = new Objects();
  #environment;
  #pictures;
  #geometries;
  #isDisposed = false;
  #isWaiting = false; // for shaders or geometry
  #isLoading = false; // shaders
  #viewport = new Vector4();
  #matrix = new Matrix4();
  #clearColor = new Color();
  #notes = new Set();
  #listeners = { webglcontextlost: () => this.#stop(true), webglcontextrestored: () => this.#start() };

  constructor(renderer, module, options) {
    this.#renderer = renderer;
    this.#module = module;
    this.#options = options;
    this.#output = new Output();
    this.#start();
    for (const [name, act] of Object.entries(this.#listeners)) renderer.domElement.addEventListener(name, act);
  }

  #start() {
    if (this.#core) return;
    this.#core = new Core(this.#module, this.#renderer.getContext());
    this.#geometries = new Geometries(this.#core);
    this.#pictures = new Pictures();
    this.#environment = new Environment();
    this.#renderer.resetState();
  }

  #stop(isLost) {
    if (!this.#core) return;
    this.#geometries.dispose(isLost);
    this.#core.destroy();
    this.#core = null;
  }

  #note = (sentence) => {
    if (this.#notes.has(sentence)) return;
    this.#notes.add(sentence);
    console.warn(`vitrine-viewer/three: ${sentence}`);
  };

  /** Sentences on what is drawn otherwise than a scene asks; each was printed once. */
  get notes() {
    return [...this.#notes];
  }

  /** What is held, for measurements. */
  get statistics() {
    return { geometries: this.#core ? this.#geometries.count : 0, objects: this.#objects.count, heapBytes: this.#module.HEAPU8.length };
  }

  /** Reads the surroundings anew with the next frame: a render target's texture does not tell that it was drawn. */
  updateEnvironment() {
    this.#environment.forget();
  }

  /**
   * Draws the scene into the renderer's present target, as `renderer.render` does, its glass by Vitrine.
   * @returns {boolean} false: three.js drew all of it, as there is no glass, or something is still to come (shaders, geometry, a lost context), or it cannot be drawn (see `notes`)
   * @throws {Error} after dispose
   */
  render(scene, camera) {
    if (this.#isDisposed) throw new Error('glass.render: it was disposed; createGlass makes a new one');
    const renderer = this.#renderer;
    const target = renderer.getRenderTarget(), face = renderer.getActiveCubeFace(), level = renderer.getActiveMipmapLevel();
    renderer.setRenderTarget(target, face, level); // before three.js's first picture there is no viewport
    renderer.getCurrentViewport(this.#viewport);
    let isDrawn = false;
    this.#isWaiting = false;
    if (renderer.xr.isPresenting) this.#note("in WebXR glass is three.js's own");
    else if (this.#core) {
      try {
        isDrawn = this.#prepare(scene, camera) && this.#draw(scene, camera, target ? target.samples : canvasSamples(renderer));
      } catch (reason) {
        this.#note(`${reason.message}; three.js draws the glass`);
      }
      renderer.resetState();
      renderer.setRenderTarget(target, face, level);
    }
    if (isDrawn) this.#output.draw(renderer, !renderer.autoClear);
    else renderer.render(scene, camera);
    return isDrawn;
  }

  /** Draws until nothing is still to come. */
  async compileAsync(scene, camera) {
    while (!this.#isDisposed && (this.render(scene, camera), this.#isWaiting)) await new Promise(requestAnimationFrame);
  }

  /** The last frame, or a part of its glass, was three.js's as something is still to come: draw again. */
  get isWaiting() {
    return this.#isWaiting;
  }

  /** Gives the core what there is to draw. @returns {boolean} is there something? */
  #prepare(scene, camera) {
    const renderer = this.#renderer, core = this.#core, objects = this.#objects, note = this.#note;
    if (scene.matrixWorldAutoUpdate) scene.updateMatrixWorld();
    if (camera.parent === null && camera.matrixWorldAutoUpdate) camera.updateMatrixWorld();
    const isExact = (mesh) => mesh.userData.glass === 'exact';
    objects.collect(scene, camera, this.#geometries, { until: performance.now() + buildTime, isExact, note });
    this.#geometries.sweep();
    this.#isWaiting = objects.isWaiting;
    if (!objects.hasGlass) return false;
    if (scene.fog) note('glass has no fog; what is seen through it has');
    if (renderer.toneMapping && !renderer.getRenderTarget() && scene.background?.colorSpace === SRGBColorSpace) note('scene.background is an sRGB picture; its tones are mapped, too');
    this.#environment.update(renderer, scene, core, note);
    const count = objects.write(core, this.#environment.rotation, { intensity: this.#environment.intensity, pictures: this.#pictures, note });
    this.#pictures.update(renderer, core);
    objects.place(core);
    return count > 0;
  }

  /** @param {number[]} color its alpha is 0 */
  #clear(target, color = [0, 0, 0]) {
    const renderer = this.#renderer, gl = renderer.getContext();
    renderer.setRenderTarget(target);
    renderer.clear();
    gl.clearBufferfv(gl.COLOR, 0, [...color, 0]);
  }

  /** Draws what is not glass. Its alpha is without the background's colour, of which three.js maps no tones. */
  #drawOpaque(scene, camera) {
    const renderer = this.#renderer, { autoClear } = renderer, { background } = scene, { opaque, backdrop } = this.#output;
    const alpha = renderer.getClearAlpha(), isColor = background?.isColor;
    renderer.getClearColor(this.#clearColor);
    const color = (isColor ? background : this.#clearColor).toArray(), share = isColor ? 1 : background || !autoClear ? 0 : alpha;
    backdrop.set(...color, share);
    this.#clear(opaque, color.map((value) => share * value));
    try {
      renderer.autoClear = false;
      if (isColor) {
        renderer.setClearColor(background, 1); // also for what three.js draws through glass of its own
        scene.background = null;
      }
      renderer.render(scene, camera);
    } finally {
      renderer.autoClear = autoClear;
      renderer.setClearColor(this.#clearColor, alpha);
      scene.background = background;
    }
  }

  /** Draws what is not glass, of so many samples a pixel, and the glass, each into a target of its own. */
  #draw(scene, camera, samples) {
    const renderer = this.#renderer, { rotation, intensity } = this.#environment;
    const width = Math.round(this.#viewport.z), height = Math.round(this.#viewport.w);
    if (width < 1 || height < 1) return false;
    this.#output.setSize(width, height, samples, this.#objects.hasRoughGlass);
    const { opaque, glass, hasLevels } = this.#output;
    renderer.resetState();
    this.#objects.hide(renderer.shadowMap.enabled);
    try {
      this.#drawOpaque(scene, camera);
    } finally {
      this.#objects.show();
    }
    this.#clear(glass);
    const { properties } = renderer;
    const answer = this.#core.draw({
      view: this.#matrix.copy(rotation).transpose().premultiply(camera.matrixWorldInverse).elements,
      projection: camera.projectionMatrix.elements,
      width,
      height,
      framebuffer: properties.get(glass).__webglFramebuffer,
      color: properties.get(opaque.texture).__webglTexture,
      depth: properties.get(opaque.depthTexture).__webglTexture,
      exposure: Math.log2(intensity),
      levels: hasLevels,
      ...this.#options,
    });
    if (answer < 0) throw new Error(this.#core.problem());
    this.#isWaiting ||= answer !== 1;
    if (answer === 3) this.#loadShaders();
    return answer === 1;
  }

  #loadShaders() {
    if (this.#isLoading) return;
    this.#isLoading = true;
    this.#core.loadShaders().catch(({ message }) => this.#note(message)).finally(() => (this.#isLoading = false));
  }

  /** Gives all of it back, but the renderer. */
  dispose() {
    if (this.#isDisposed) return;
    this.#isDisposed = true;
    for (const [name, act] of Object.entries(this.#listeners)) this.#renderer.domElement.removeEventListener(name, act);
    this.#stop(false);
    this.#output.dispose();
    this.#renderer.resetState();
  }
}

/**
 * Glass for a renderer of three.js's.
 * @param {import('three').WebGLRenderer} renderer without logarithmic or reversed depth buffer
 * @param {import('./index.d.ts').GlassOptions} options
 * @returns {Promise<Glass>}
 * @throws {Error} a sentence, where the renderer cannot be used, an option is out of its range or the WebAssembly cannot be loaded
 */
export async function createGlass(renderer, { locateFile, wasmBinary, ...options } = {}) {
  const fail = () => {
    const problem = problemOf(renderer);
    if (problem) throw new Error(`createGlass: ${problem}`);
  };
  fail();
  const read = readOptions(options);
  const module = await loadCore({ locateFile, wasmBinary });
  fail(); // the context may be lost meanwhile
  return new Glass(renderer, module, read);
}
