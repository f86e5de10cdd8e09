// A canvas with its viewer: what it shows, when it draws, and how well. Nothing is drawn unless the canvas can be
// seen and something changed; once all rests, samples are added to the picture until it has enough.
import { builtIn, needsFull, variantProblem } from './loading.js';
import { Viewer, ownTask } from './core.js';
import { listMaterials } from './materials.js';
import { decodeTexture } from './picture.js';
import { Motion } from './motion.js';
import { Orbit, usualFieldOfView } from './orbit.js';
import { dprOf, sizeOf } from './pixels.js';
import { Quality, levels } from './quality.js';

const slice = 12; // milliseconds of building a scene at once
const kinds = ['environment', 'background', 'model']; // in the order in which a viewer gets them
const stillAfter = 250; // milliseconds without motion until the full frame

/**
 * @typedef {object} Told what a stage tells its element
 * @property {(kind: 'model'|'environment') => void} shown
 * @property {(kind: 'model'|'environment', sentence: string) => void} rejected what was shown before stays
 * @property {(milliseconds: number) => void} frame is on the screen
 * @property {(detail: object) => void} scaled of the render-scale event
 * @property {(isByItself: boolean) => void} turned or moved
 * @property {(cause: string, sentence: string) => void} warned of something left out; '': of nothing any more
 * @property {(animations: object[]) => void} animated of the files that are shown now (Viewer.animations)
 * @property {(sentences: string[]) => void} noted what of the files that are shown is left out or changed
 * @property {() => void} lost the context
 * @property {() => void} restored
 * @property {(sentence: string) => void} failed to draw
 * @property {(sentence: string) => void} unsupported
 */

export class Stage {
  /** Where the camera shall be. */
  orbit = new Orbit();
  /** Where it is, on its way there. */
  view = new Motion(this.orbit);
  /** Of that way, milliseconds; 0: it is there at once. */
  decay = 0;
  quality = new Quality();
  /** Of Viewer.setGlass, for a full frame; the element's attributes. */
  glass = {};
  /** Of the file, to look through; null: all of the scene is in view. */
  cameraIndex = null;
  /** What files may ask for: bytes, triangles, pixels; null: as usual. */
  limits = [];
  /** @type {{model: import('./loading.js').Scene|null, environment: import('./loading.js').Source|null, background: import('./loading.js').Source|null}} */
  scene = { model: null, environment: builtIn('environment', 'studio'), background: null };

  /** @type {import('./backdrop.js').Backdrop|null} once the element has had one */
  backdrop = null;

  #host;
  #told;
  #core = null;
  #viewer = null;
  #pending = {}; // sources that no viewer was there for
  #coming = null; // the scene whose pictures the browser decodes, or that is being built
  #goOn = null; // with building it, for some milliseconds
  #filled = false; // the viewer has the scene
  #unfilled = []; // kinds of sources that a new viewer is still to be given
  #visible = false;
  #spin = 0;
  #motion = null;
  #pose = null; // of the animation that is shown; null: the scene is at rest
  #isPosed = true; // the viewer has it so
  #lastTime = 0;
  #lastStep = 0; // of the view's way
  #dirty = false;
  #isRefining = false; // samples may be missing
  #frame = 0; // of requestAnimationFrame
  #busy = null; // the fence of the frame on the GPU, or the promise of its shaders
  #lacks = false; // shaders could not be loaded
  #still = 0; // timer
  #framedFor = ''; // aspect and field of view
  #refused = null; // the technique that the scene is too large for
  #refusal = ''; // what is wrong with the last frame, a sentence
  #drawn = {}; // detail of the last render-scale
  #unchecked = 0; // the GPU has not been asked whether it has drawn such a frame: 1 its first sample, 2 a later one, which has targets of its own

  /** @param {HTMLElement} host holds a canvas @param {Told} told */
  constructor(host, told) {
    this.#host = host;
    this.#told = told;
  }

  /** Another one in the place of one that is in use takes over what is shown. */
  set core(core) {
    if (this.#core !== core) this.close();
    this.#core = core;
    if (this.#visible) this.#beSeen();
  }

  /** What is shown, or is about to be. */
  get latest() {
    return { ...this.scene, ...(this.#coming && { model: this.#coming }), ...this.#pending };
  }

  /** Does that need the larger core? */
  get needsFull() {
    return this.#needsFull(this.latest.model);
  }

  #needsFull(source) {
    return this.limits.some(Boolean) || needsFull(source);
  }

  get isVisible() {
    return this.#visible;
  }

  set isVisible(visible) {
    this.#visible = visible;
    this.backdrop?.see();
    if (visible) this.#beSeen();
    this.#schedule();
  }

  /** Radians a second about +Y. */
  set spin(speed) {
    this.#spin = speed;
    this.#lastTime = 0;
    if (speed === 0) this.#awaitStill();
    this.#schedule();
  }

  /** Called before each frame with its time, milliseconds, to pose what moves; null: nothing does. @param {((time: number) => void)|null} advance */
  set motion(advance) {
    this.#motion = advance;
    if (advance === null) this.#awaitStill();
    this.#schedule();
  }

  /** Of Viewer.setTime. @param {{name: string, seconds: number}} pose */
  set pose(pose) {
    this.#pose = pose;
    this.#isPosed = false;
    this.invalidate();
  }

  /** Shows a source now, or as soon as there is a viewer. @param {import('./loading.js').Source|import('./loading.js').Scene} source */
  show(kind, source) {
    if (kind === 'model') this.#coming = null;
    delete this.#pending[kind];
    if (this.#viewer === null || this.#viewer.isLost || this.#unfilled.includes(kind) || (this.#needsFull(source) && !this.#viewer.isFull)) this.#pending[kind] = source;
    else this.#upload(kind, source);
  }

  /** There is no model any more. */
  dropModel() {
    this.scene.model = this.#coming = this.#goOn = null;
    delete this.#pending.model;
    this.close();
    this.#host.querySelector('canvas').getContext('bitmaprenderer').transferFromImageBitmap(null);
  }

  invalidate() {
    this.#dirty = true;
    this.#schedule();
  }

  /** Before the orbit changes: the view goes there from where it is. */
  depart() {
    if (this.decay === 0 || !this.#visible || !this.#filled || this.view.isMoving) return;
    this.view.depart();
    this.#lastStep = performance.now();
  }

  /** The view shall move, or has: less is drawn until it rests. */
  moved() {
    this.quality.moving = true;
    this.#awaitStill();
    this.invalidate();
  }

  /** Everything on the GPU is given back; sources stay for the next opening. */
  close() {
    cancelAnimationFrame(this.#frame);
    clearTimeout(this.#still);
    this.#frame = 0;
    this.#busy = null;
    if (this.#viewer === null) return;
    this.#keepComing();
    this.#viewer.destroy();
    this.#viewer = null;
  }

  /** As image(), but waits for shaders that are still to be loaded. @returns {Promise<ImageData>} */
  async wholeImage() {
    try {
      return this.image();
    } catch (reason) {
      if (!this.#viewer?.lacksShaders) throw reason;
      await this.#viewer.loadShaders();
      return this.image();
    }
  }

  /** The full picture. @returns {ImageData} @throws {Error} a sentence */
  image() {
    if (!this.#hasScene) throw new Error('nothing is shown yet');
    const [width, height] = sizeOf(this.#host, 1);
    const canvas = this.#host.querySelector('canvas');
    if (this.#dirty || this.quality.level !== 0 || canvas.width !== width || canvas.height !== height) {
      this.#frameObject();
      const problem = this.#applyPose() || this.#applyGlass(this.glass) || this.#applyView();
      if (problem) throw new Error(problem);
    }
    return this.#viewer.image(width, height);
  }

  /**
   * The exact path through a point of the canvas, x and y as shares of its sides from the top left; null where
   * nothing is shown. See vtViewer_Path.
   */
  path(x, y) {
    if (this.#viewer === null || this.#viewer.isLost || !this.#filled) return null;
    const { width, height } = this.#host.querySelector('canvas');
    return this.#viewer.path(x * width, y * height);
  }

  /** Of what is shown, corners of its box. @returns {{low: number[], high: number[]}|null} null: nothing */
  get box() {
    return this.#hasScene ? this.#viewer.info() : null;
  }

  /** Of what is shown; what is set stays until there is another model. */
  get materials() {
    return listMaterials((index) => (this.#hasScene ? this.#viewer.material(index) : null), (index, text) => {
      const problem = this.#hasScene ? this.#viewer.attempt('SetMaterial', index, `${index}:${text}`) : 'nothing is shown yet';
      if (problem) throw new Error(problem);
      this.scene.model.changes = [...(this.scene.model.changes ?? []).filter(([other, before]) => other !== index || before.split('=')[0] !== text.split('=')[0]), [index, text]];
      this.invalidate();
    });
  }

  /** In a viewer, which is there again where it was given back. */
  get #hasScene() {
    if (this.#viewer === null) this.#open();
    if (this.#viewer !== null && !this.#viewer.isLost) {
      while (this.#unfilled.length > 0) this.#fillNext();
      this.#goOn?.(Infinity);
    }
    return this.#filled && this.#viewer !== null && !this.#viewer.isLost;
  }

  #beSeen() {
    try {
      if (this.#viewer === null) this.#open();
      else this.#viewer.seen();
    } catch (reason) {
      this.#told.unsupported(reason.message);
    }
  }

  #open() {
    if (this.#core === null) return;
    const told = {
      lost: () => {
        this.#busy = null;
        this.#keepComing();
        this.#told.lost();
      },
      restored: (problem) => {
        if (problem) {
          this.#told.failed(problem);
          return;
        }
        this.#fill();
      },
      crowded: () => {
        if (!this.#visible) this.close();
        return this.#viewer === null;
      },
    };
    try {
      try {
        this.#viewer = new Viewer(this.#core, told);
      } catch { // the context may have been lost just then: another one is made
        this.#viewer = new Viewer(this.#core, told);
      }
    } catch (reason) {
      this.#core = null; // not tried again
      this.#told.unsupported(reason.message);
      return;
    }
    this.#fill();
  }

  /** The viewer goes: what it does not show yet is for the next one. */
  #keepComing() {
    if (this.#coming !== null && this.#coming !== this.scene.model) this.#pending.model ??= this.#coming;
    this.#coming = this.#goOn = null;
  }

  /** Gives a new viewer what was shown, and what came in the meantime, each in a task of its own. */
  async #fill() {
    const viewer = this.#viewer;
    this.#framedFor = '';
    this.#drawn = {};
    this.#filled = false;
    this.#unfilled = [...kinds];
    while (this.#unfilled.length > 0) {
      await ownTask();
      if (this.#viewer !== viewer || viewer.isLost) return;
      this.#fillNext();
    }
    this.#told.restored(); // in case the one before was lost
  }

  #fillNext() {
    const kind = this.#unfilled.shift();
    if (kind === undefined) return;
    if (this.scene[kind] !== null) this.#upload(kind, this.scene[kind], false);
    if (this.#pending[kind] !== undefined) this.show(kind, this.#pending[kind]);
  }

  #upload(kind, source, isNew = true) {
    const viewer = this.#viewer;
    if (viewer.isFull) viewer.call('Limit', ...this.limits);
    let problem;
    if (kind === 'environment') {
      problem = source.contents === null ? viewer.attempt('SetEnvironment', source.name) : viewer.attemptFile('OpenEnvironment', source);
    } else if (kind === 'background') {
      problem = source.contents instanceof ImageBitmap ? viewer.attemptFile('BackgroundOpen', source) : `${source.name}: no picture that this browser can decode; save it as PNG, JPEG or WebP`;
    } else {
      problem = viewer.begin(source.parts, source);
      if (!problem) {
        if (source.pictures === undefined && viewer.images.length > 0) this.#decode(source, viewer.images);
        else this.#build(source, isNew);
        return;
      }
    }
    this.#shown(kind, source, isNew, problem);
  }

  /** Shows the scene that was begun once it is built, in slices of time; unless another one has come, or the viewer has gone. */
  #build(source, isNew) {
    const viewer = this.#viewer;
    this.#coming = source;
    const goOn = (milliseconds) => {
      if (this.#goOn !== goOn || this.#coming !== source) return;
      if (viewer.build(milliseconds)) {
        this.#coming = this.#goOn = null;
        const problem = viewer.show(source.pictures ?? new Map());
        if (!problem) {
          this.#framedFor = '';
          this.#refused &&= {};
          if (isNew) this.#pose = null;
          this.#isPosed = this.#pose === null; // it is at rest
          if (isNew) this.#told.animated(viewer.animations);
          for (const [index, text] of source.changes ?? []) viewer.attempt('SetMaterial', index, `${index}:${text}`);
          if (isNew) this.#told.noted(viewer.notes);
          this.#told.warned('variant', variantProblem(source));
        }
        this.#shown('model', source, isNew, problem);
      } else {
        setTimeout(goOn, 0, slice);
      }
    };
    this.#goOn = goOn;
    setTimeout(goOn, 0, slice);
  }

  #shown(kind, source, isNew, problem) {
    this.#unchecked = 3;
    if (problem && this.#viewer.gl.isContextLost()) { // which is about to be told: it waits for the next one
      if (isNew) this.#pending[kind] = source;
      return;
    }
    if (!problem) this.scene[kind] = source;
    if (!problem && kind === 'model') this.#filled = true;
    else if (kind === 'model' && !this.#filled && isNew && this.scene.model !== null) this.#upload(kind, this.scene.model, false); // the one before stays
    this.invalidate();
    if (problem) this.#told.rejected(kind, problem);
    else if (isNew) this.#told.shown(kind);
  }

  /** Has the browser decode a scene's pictures, then shows it, unless another one has come. */
  async #decode(source, images) {
    this.#coming = source;
    const pictures = new Map(), missing = [];
    await Promise.all(images.map(async ({ index, bytes, name }) => {
      const picture = await decodeTexture(bytes);
      if (picture !== null) pictures.set(index, picture);
      else missing.push(`${name} is no picture that this browser can decode; white is shown in its place`);
    }));
    source.pictures = pictures;
    if (this.#coming !== source) return;
    this.#told.warned('pictures', missing.sort().join('. '));
    this.show('model', source);
  }

  /** A technique that cannot have the scene is tried once; the scene's usual one stands in for it. */
  #applyGlass(glass, lessened = false) {
    const viewer = this.#viewer;
    glass = this.backdrop?.apply(viewer, glass) ?? glass;
    const { technique } = glass;
    if (technique !== this.#refused?.technique) {
      const problem = viewer.setGlass({ ...glass, lessened });
      const isRefused = problem && technique !== null && !viewer.setGlass({ ...glass, technique: null, lessened });
      if (isRefused || this.#refused !== null) this.#told.warned('technique', isRefused ? problem : '');
      this.#refused = isRefused ? { technique } : null;
      return isRefused ? '' : problem;
    }
    return viewer.setGlass({ ...glass, technique: null, lessened });
  }

  #applyPose() {
    if (this.#isPosed) return '';
    this.#isPosed = true;
    return this.#viewer.setTime(this.#pose);
  }

  #applyView() {
    const { eye, target, fieldOfView } = this.view;
    return this.#viewer.attempt('SetView', ...eye, ...target, fieldOfView);
  }

  /** Finds the view that shows the whole scene, or the file's camera, where the scene or the shape of the picture is new. */
  #frameObject() {
    const [width, height] = sizeOf(this.#host, 1);
    const { orbit, cameraIndex, backdrop } = this;
    const key = `${width / height} ${orbit.wantedFieldOfView} ${cameraIndex} ${backdrop?.isThere}`;
    if (key === this.#framedFor) return;
    this.#framedFor = key;
    const problem = cameraIndex === null ? '' : this.#viewer.attempt('UseCamera', cameraIndex);
    const hasCamera = cameraIndex !== null && !problem;
    if (!hasCamera) {
      this.#viewer.attempt('SetView', 0, 0, 1, 0, 0, 0, orbit.limitFieldOfView(orbit.wantedFieldOfView ?? usualFieldOfView));
      this.#viewer.call('ResetView', width / height);
    }
    const { eye, target, fov } = this.#viewer.info();
    orbit.frame(hasCamera ? eye : backdrop?.straighten(eye, target) ?? eye, target, fov);
    this.view.jump();
    this.#told.warned('camera', problem);
  }

  #awaitStill() {
    clearTimeout(this.#still);
    this.#still = setTimeout(() => {
      if (this.#spin !== 0 || this.#motion !== null) return;
      const before = this.quality.level;
      this.quality.moving = false;
      if (this.quality.level !== before) this.invalidate();
      else this.#schedule();
    }, stillAfter);
  }

  #schedule() {
    const isWanted = this.#dirty || this.#spin !== 0 || this.#motion !== null || (this.#isRefining && !this.quality.moving);
    const canDraw = this.#viewer !== null && !this.#viewer.isLost && this.#visible && this.#filled;
    if (!isWanted || !canDraw || this.#busy !== null || this.#frame !== 0) return;
    this.#frame = requestAnimationFrame((time) => {
      this.#frame = 0;
      if (this.#viewer === null || this.#viewer.isLost || this.#busy !== null) return; // a frame on its way has another one follow
      this.#busy = 'waiting for its turn';
      this.#viewer.enter(this.#dirty || this.#spin !== 0 || this.#motion !== null, () => this.#draw(time));
    });
  }

  /** In its turn, which is over once there is nothing to wait for, or the picture is shown. */
  #draw(time) {
    this.#busy = null;
    if (this.#spin !== 0) {
      const seconds = this.#lastTime === 0 ? 0 : Math.min(0.2, (time - this.#lastTime) / 1000);
      this.#lastTime = time;
      this.orbit.turn(this.#spin * seconds, 0);
      this.view.turn(this.#spin * seconds);
      this.quality.moving = true;
      this.#dirty = true;
      this.#told.turned(true);
    }
    if (this.#motion !== null) {
      this.#motion(time);
      this.quality.moving = true;
    }
    const { quality } = this;
    const isNew = this.#dirty;
    this.#dirty = isNew && this.#step();
    const { pixelWidth, pixelHeight } = this.#drawn;
    const [width, height] = isNew ? sizeOf(this.#host, quality.scale) : [pixelWidth, pixelHeight];
    let problem = isNew ? this.#prepare(width, height) : '';
    const start = performance.now();
    const drawn = this.#viewer.draw(width, height);
    this.#isRefining = drawn > 0;
    if (drawn === 2) { // shaders are being compiled, or are still to be loaded
      this.#dirty = isNew;
      this.#viewer.leave();
      if (this.#viewer.lacksShaders) this.#awaitShaders();
      else this.#schedule();
      return;
    }
    if (this.#lacks) this.#told.warned('context', '');
    this.#lacks = false;
    if (drawn < 0 && this.#viewer.gl.isContextLost()) { // which is about to be told
      this.#viewer.leave();
      return;
    }
    if (drawn < 0) problem ||= this.#viewer.problem();
    if (isNew || problem) this.#tellRefusal(problem);
    if (isNew) this.#tellScale(width, height);
    if (drawn === 1) {
      this.#awaitFrame(start, quality.moving, isNew ? 1 : 2);
    } else {
      this.#viewer.leave();
      this.#schedule(); // what moves may stand for a frame
    }
  }

  /** The view goes on to where it shall be. @returns {boolean} it is not there yet */
  #step() {
    if (!this.view.isMoving) return false;
    const now = performance.now();
    const isMoving = this.view.step(Math.min(100, now - this.#lastStep), this.decay);
    this.#lastStep = now;
    if (isMoving) {
      this.quality.moving = true;
      this.#awaitStill();
    }
    this.#told.turned(false);
    return isMoving;
  }

  /** A new frame of that size. @returns {string} a sentence, or '' */
  #prepare(width, height) {
    this.#frameObject();
    const problem = this.#applyPose() || this.#applyGlass(this.glass, this.quality.lessened) || this.#applyView();
    const { pixelWidth, pixelHeight } = this.#drawn;
    return problem || (pixelWidth === width && pixelHeight === height ? '' : this.#viewer.attempt('Resize', width, height));
  }

  /** Until a frame is as it should be, once. */
  #tellRefusal(problem) {
    if (problem !== this.#refusal) this.#told.warned('frame', problem);
    this.#refusal = problem;
  }

  #tellScale(pixelWidth, pixelHeight) {
    const { layers, steps, maxEvents, branches, wavelengths } = this.#viewer.info();
    const preset = this.quality.lessened ? 'low' : this.glass.preset;
    const size = { pixelWidth, pixelHeight, preset, layers, steps, maxEvents, branches, wavelengths };
    if (Object.keys(size).every((key) => this.#drawn[key] === size[key])) return;
    this.#drawn = size;
    this.#unchecked = 3;
    const { reason, scale } = this.quality;
    const dpr = dprOf(this.#host), minimumDpr = dpr * levels.at(-1).scale;
    const detail = { reportedDpr: window.devicePixelRatio, renderedDpr: dpr * scale, minimumDpr, ...size, reason };
    this.#viewer.lessened = reason === 'frame-time' && scale < 1 ? detail : null;
    this.#told.scaled(detail);
  }

  /** Where they cannot be loaded, nothing is drawn until something changes. */
  #awaitShaders() {
    const loading = (this.#busy = this.#viewer.loadShaders());
    const end = (reason) => {
      if (this.#busy !== loading) return; // closed or lost
      this.#busy = null;
      this.#lacks = reason !== undefined;
      if (this.#lacks) this.#told.failed(reason.message);
      else this.#schedule();
    };
    loading.then(end, end);
  }

  /** Waits for the GPU without holding the page up; the next frame starts after it. @param {number} kind as of #unchecked */
  #awaitFrame(start, moving, kind) {
    const { gl } = this.#viewer;
    const fence = (this.#busy = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0));
    if (fence === null) return; // lost
    gl.flush();
    const poll = () => {
      if (this.#busy !== fence) return; // closed or lost
      if (gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.UNSIGNALED) {
        setTimeout(poll, 1);
        return;
      }
      gl.deleteSync(fence);
      this.#busy = null;
      const problem = this.#unchecked & kind ? this.#viewer.attempt('Check') : ''; // which waits, so once
      if (problem) {
        this.#isRefining = false;
        this.#viewer.leave();
        if (!gl.isContextLost()) this.#tellRefusal(problem);
        return;
      }
      this.#unchecked &= ~kind;
      this.#viewer.showOn(this.#host.querySelector('canvas'));
      this.#viewer.leave();
      const milliseconds = performance.now() - start;
      if (moving) this.quality.note(milliseconds);
      this.#told.frame(milliseconds);
      this.#schedule();
    };
    setTimeout(poll, 1);
  }
}
