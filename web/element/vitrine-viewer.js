// <vitrine-viewer>: glass in any page. Attributes: attributes.js; events, slots, parts and variables: docs/web.md.
import { Access } from './access.js';
import { adoptProperties, attributes, defineProperties, readAttributes } from './attributes.js';
import { listenToControls } from './controls.js';
import { coreStatistics, loadCore, ownTask } from './core.js';
import { Extras } from './extras.js';
import { readGround } from './ground.js';
import { Loader } from './loader.js';
import { needsFull, readBackground, wishOf } from './loading.js';
import { parseFieldOfView, parseOrbit, parsePlacement, parseTarget } from './orbit.js';
import { Stage } from './stage.js';
import { createShadow } from './template.js';

const spinSpeed = Math.PI / 32; // radians a second, as model-viewer's
const spinPause = 3000; // milliseconds after the last touch
const cameraWords = ['camera-orbit', 'camera-target', 'field-of-view', 'min-camera-orbit', 'max-camera-orbit', 'min-field-of-view', 'max-field-of-view'];

/**
 * @fires load {url}: the model is in the picture
 * @fires progress {totalProgress}: 0 to 1, from bytes
 * @fires error {type: 'loadfailure'|'webglcontextlost'|'unsupported'|'invalid', sourceError}
 * @fires camera-change {source: 'user-interaction'|'none'}
 * @fires warning {sentences}: what of the files is left out or changed
 * @fires play, pause, loop: an animation
 * @fires frame {milliseconds}: one is on the screen, and how long it took
 * @fires render-scale {reportedDpr, renderedDpr, minimumDpr, pixelWidth, pixelHeight, preset, layers, steps, maxEvents, branches, wavelengths, reason}
 */
export class VitrineViewer extends (globalThis.HTMLElement ?? class {}) {
  static observedAttributes = attributes.map(({ attribute }) => attribute);

  /** Where the wasm is, if not beside this module; set before the first element. @type {((name: string) => string)|undefined} */
  static locateFile;
  /** The wasm itself, for a bundle. @type {BufferSource|undefined} */
  static wasmBinary;
  /** What vitrine-shaders.txt has in it, for a bundle. @type {string|undefined} */
  static laterShaders;
  /** Contexts and bytes held by all elements, for measurements. */
  static statistics = coreStatistics;

  #shadow = createShadow(this);
  #stage = new Stage(this.#shadow.view, this.#tell());
  #access;
  #values = {};
  #messages = new Map(); // by cause
  #loader = new Loader({
    progress: (value) => this.#showProgress(value),
    loaded: (kind, source) => this.#stage.show(kind, source),
    failed: (kind, reason) => this.#fail('loadfailure', kind, reason.message, reason),
  });
  #source = 'none'; // of the last motion
  #extras = new Extras(this, this.#stage, { say: (...values) => this.#say(...values), failed: (...values) => this.#fail('loadfailure', ...values) });
  #backdrop = ''; // text, or what has the picture
  #behind = null; // promise of it
  #animation = null; // animation.js's, once files have some
  #isAnimating = false; // it is being loaded
  #isFull = false; // it needs vitrine-full
  #isLoaded = false;
  #warnings = [];
  #hasFrame = false;
  #isDismissed = false;
  #wasSeen = false;
  #isOpen = false; // observers are on
  #updating = null; // attributes that wait for the end of the script
  #timers = {};
  #observers = [];
  #reduced = matchMedia('(prefers-reduced-motion: reduce)');

  constructor() {
    super();
    const { orbit } = this.#stage;
    const act = (change) => (...numbers) => {
      this.#stage.depart();
      change(...numbers);
      this.#moved('user-interaction');
    };
    listenToControls(this.#shadow.view, {
      isActive: () => this.cameraControls,
      canZoom: () => !this.disableZoom,
      canPan: () => !this.disablePan,
      turn: act((right, up) => orbit.turn(right, up)),
      pan: act((right, up) => orbit.pan(right, up)),
      zoom: act((factor) => orbit.zoom(factor)),
      reset: act(() => this.#placeCamera()),
    });
    this.#access = new Access(this.#shadow, orbit, (change) => act(change)());
  }

  // ------------------------------------------------------------------------------------------------- for pages

  /** The model of the present src is in the picture. */
  get loaded() {
    return this.#isLoaded;
  }

  /** What of the model's files is left out or changed, sentences. */
  get warnings() {
    return this.#warnings;
  }

  /** Names of the variants of materials that the files shown have, for variant-name. */
  get availableVariants() {
    return [...new Set(this.#stage.scene.model?.parts.flatMap(({ variants }) => variants ?? []))];
  }

  /** Names of the animations that the files shown have, for animation-name. */
  get availableAnimations() {
    return this.#animation?.names ?? [];
  }

  /** As its attribute, which it does not change, or what has the picture. @type {string|HTMLImageElement|HTMLVideoElement|HTMLCanvasElement|OffscreenCanvas|ImageBitmap} */
  get backdrop() {
    return this.#backdrop;
  }

  set backdrop(picture) {
    this.#backdrop = picture ?? '';
    this.#update('backdrop');
  }

  /** Seconds of the animation that is played; 0 without any. */
  get duration() {
    return this.#animation?.duration ?? 0;
  }

  get paused() {
    return this.#animation?.paused ?? true;
  }

  /** Of the animation, seconds; setting it shows that time. */
  get currentTime() {
    return this.#animation?.currentTime ?? 0;
  }

  set currentTime(seconds) {
    if (this.#animation !== null) this.#animation.currentTime = seconds;
  }

  /** Plays the animation of animation-name, round and round, while the element is in view. */
  play() {
    this.#animation?.play();
  }

  pause() {
    this.#animation?.pause();
  }

  /** The poster is gone and the model can be seen. */
  get modelIsVisible() {
    return this.#hasFrame && this.#shadow.poster.hidden;
  }

  /** Removes the poster where reveal is manual. */
  dismissPoster() {
    this.#isDismissed = true;
    this.#showPoster();
  }

  /** @returns {{theta: number, phi: number, radius: number, toString: () => string}} radians and metres */
  getCameraOrbit() {
    const { view } = this.#stage;
    const text = String(view);
    return { theta: view.theta, phi: view.phi, radius: view.distance, toString: () => text };
  }

  /** @returns {{x: number, y: number, z: number}} the point looked at, world */
  getCameraTarget() {
    return xyz(this.#stage.view.target);
  }

  /** @returns {number} degrees, vertical */
  getFieldOfView() {
    return this.#stage.view.fieldOfView;
  }

  /** The view is where the attributes and the visitor want it, without the way there. */
  jumpCameraToGoal() {
    this.#stage.view.jump();
    this.#stage.invalidate();
  }

  /** @returns {{x: number, y: number, z: number}|null} sides of the box around all that is shown; null: nothing is */
  getDimensions() {
    const { box } = this.#stage;
    return box && xyz(box.high.map((value, i) => value - box.low[i]));
  }

  /** @returns {{x: number, y: number, z: number}|null} its middle, world */
  getBoundingBoxCenter() {
    const { box } = this.#stage;
    return box && xyz(box.high.map((value, i) => (value + box.low[i]) / 2));
  }

  /**
   * Of what is shown, in the order of the files; what is set stays until there is another model.
   * @returns {{opaque: boolean, ior: number, tint: number[], absorption: number[], absorptionDistance: number, roughness: number, dispersion: number}[]}
   */
  get materials() {
    return this.#stage.materials;
  }

  /** World points in client coordinates, as they are seen now. @param {number[][]} points @returns {number[][]} */
  project(points) {
    const { left, top, width, height } = this.#shadow.view.getBoundingClientRect();
    return points.map((point) => {
      const [x, y] = this.#stage.view.project(point, width / height);
      return [left + (0.5 + 0.5 * x) * width, top + (0.5 - 0.5 * y) * height];
    });
  }

  /**
   * The exact path of light through a point of the page, traced on the CPU; null where no glass is.
   * `points` has one more than `events`: where the light has gone after the last.
   * @returns {{events: {kind: 'refraction'|'reflection', in: number, out: number}[], points: number[][], screen: number[][], exited: boolean}|null}
   */
  pathAt(clientX, clientY) {
    const { left, top, width, height } = this.#shadow.view.getBoundingClientRect();
    const path = this.#stage.path((clientX - left) / width, (clientY - top) / height);
    if (path === null || path.events.length === 0) return null;
    const points = path.events.map(({ position }) => position);
    const { distance } = this.#stage.view;
    points.push(path.end ?? points.at(-1).map((value, i) => value + 0.3 * distance * path.direction[i]));
    const events = path.events.map((event) => ({ kind: event.kind, in: event.in, out: event.out }));
    return { events, points, screen: this.project(points), exited: path.exited };
  }

  /** Back to camera-orbit, camera-target and field-of-view. */
  resetView() {
    this.#stage.depart();
    this.#placeCamera();
    this.#moved('none');
  }

  /** The full picture as a file. @param {{mimeType?: string, qualityArgument?: number}} options @returns {Promise<Blob>} */
  async toBlob({ mimeType = 'image/png', qualityArgument } = {}) {
    const canvas = paint(await this.#stage.wholeImage());
    return new Promise((resolve, reject) => {
      canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('the browser gave no file'))), mimeType, qualityArgument);
    });
  }

  /** The full picture as a data: URL. */
  toDataURL(type = 'image/png', qualityArgument) {
    return paint(this.#stage.image()).toDataURL(type, qualityArgument);
  }

  // -------------------------------------------------------------------------------------------------- life

  connectedCallback() {
    adoptProperties(this);
    clearTimeout(this.#timers.removal);
    if (this.#isOpen) return; // moved
    this.#isOpen = true;
    const seen = new IntersectionObserver((entries) => this.#see(entries.at(-1).isIntersecting));
    const size = new ResizeObserver(() => this.#stage.invalidate());
    seen.observe(this);
    size.observe(this);
    const motion = () => {
      this.#update('');
      this.#updateAnimation();
    };
    this.#reduced.addEventListener('change', motion);
    const children = new MutationObserver(() => this.#extras.placeHotspots());
    children.observe(this, { childList: true, subtree: true, attributeFilter: ['slot', 'data-position', 'data-normal'] });
    this.#extras.placeHotspots();
    this.#observers = [seen, size, { disconnect: () => this.#reduced.removeEventListener('change', motion) }, children];
    this.#watchPixelRatio();
    this.#update('src');
  }

  disconnectedCallback() {
    // Put back within this task it goes on as it was.
    this.#timers.removal = setTimeout(() => !this.isConnected && this.#close());
  }

  attributeChangedCallback(name, before, after) {
    if (name === 'backdrop') this.backdrop = after;
    else if (before !== after) this.#update(name);
  }

  #close() {
    this.#isOpen = this.#wasSeen = this.#hasFrame = false;
    for (const observer of this.#observers) observer.disconnect();
    for (const timer of Object.values(this.#timers)) clearTimeout(timer);
    this.#timers = {};
    this.#access.stop();
    this.#loader.abort();
    this.#stage.isVisible = false;
    this.#stage.close();
    this.#extras.stop();
    this.#showPoster();
  }

  #watchPixelRatio() {
    const query = matchMedia(`(resolution: ${window.devicePixelRatio}dppx)`);
    const changed = () => {
      this.#stage.invalidate();
      this.#watchPixelRatio();
    };
    query.addEventListener('change', changed, { once: true });
    this.#observers[4] = { disconnect: () => query.removeEventListener('change', changed) };
  }

  #see(isSeen) {
    this.#stage.isVisible = isSeen;
    if (!isSeen || this.#wasSeen) return;
    this.#wasSeen = true;
    this.#load();
  }

  // ---------------------------------------------------------------------------------------------- attributes

  /** Several changes of one script are taken together. */
  #update(name) {
    if (this.#updating === null) {
      this.#updating = new Set();
      queueMicrotask(() => {
        const changed = this.#updating;
        this.#updating = null;
        this.#apply(changed);
      });
    }
    this.#updating.add(name);
  }

  #apply(changed) {
    const { values, problems } = readAttributes(this);
    const isFirst = this.#values.src === undefined;
    this.#values = values;
    const { background } = values;
    if (background && !readBackground(background)) {
      problems.push(`background is '${background}'; it must be environment, transparent, blurred, blurred:DEGREES (1 to 90), #rrggbb or a URL`);
      values.background = '';
    }
    const stage = this.#stage;
    const behind = readBackground(this.#background);
    const { technique, ior, roughness, dispersion, fresnel, preset, layers, steps, maxEvents, output, layer, exposure, toneMapping, samples } = values;
    stage.limits = [values.maxMemory, values.maxTriangles, values.maxPixels];
    stage.cameraIndex = values.cameraIndex;
    stage.decay = this.#reduced.matches ? 0 : values.interpolationDecay;
    attempt(problems, () => (values.placement = parsePlacement(values.orientation, values.scale)));
    const { ground, problems: ofGround } = readGround(values);
    problems.push(...ofGround);
    stage.glass = { ground, technique, ior, roughness: roughness ?? -1, dispersion: dispersion ?? -1, fresnel, preset, layers, steps, 'max-events': maxEvents, output, layer, samples, exposure: Math.log2(exposure), 'tone-mapping': toneMapping, background: behind, 'background-blur': behind.blur };
    stage.quality.mode = values.quality;

    this.#access.describe(values);
    const img = this.#shadow.poster.querySelector('img');
    img.hidden = values.poster === '';
    if (values.poster !== '' && img.getAttribute('src') !== values.poster) img.src = values.poster;
    this.#showPoster();

    if (isFirst || [...cameraWords, 'camera-index'].some((name) => changed.has(name))) {
      stage.depart();
      problems.push(...this.#placeCamera());
      this.#changedCamera('none');
    }
    const sentence = problems.join('. ');
    const isNew = sentence !== (this.#messages.get('invalid') ?? '');
    this.#say('invalid', sentence);
    if (sentence && isNew) this.#dispatch('error', { type: 'invalid', sourceError: new Error(sentence) });
    this.#updateSpin();
    this.#updateAnimation();
    const isBehind = changed.has('backdrop');
    if (this.#behind !== null && (isBehind || changed.has('backdrop-distance'))) this.#behind = this.#showBackdrop();
    stage.invalidate();
    if ((isBehind && !this.#isFull) || ['src', 'relief', 'relief-depth', 'relief-slab', 'relief-smooth', 'objects', 'walls', 'variant-name', 'ground', 'shadow-intensity', 'autoplay', 'animation-name', 'orientation', 'scale', 'max-memory', 'max-triangles', 'max-pixels', 'loading', 'environment-image', 'skybox-image', 'background'].some((name) => changed.has(name))) this.#load();
  }

  /** The camera as the attributes have it; returns sentences about those that cannot stand. */
  #placeCamera() {
    const { orbit } = this.#stage;
    const { limits } = orbit;
    const problems = [];
    attempt(problems, () => orbit.place(parseOrbit(this.cameraOrbit)));
    attempt(problems, () => orbit.aim(parseTarget(this.cameraTarget)));
    attempt(problems, () => (orbit.wantedFieldOfView = parseFieldOfView(this.fieldOfView)));
    attempt(problems, () => (limits.low = parseOrbit(this.minCameraOrbit, 'min-camera-orbit')));
    attempt(problems, () => (limits.high = parseOrbit(this.maxCameraOrbit, 'max-camera-orbit')));
    attempt(problems, () => (limits.lowFieldOfView = parseFieldOfView(this.minFieldOfView, 'min-field-of-view')));
    attempt(problems, () => (limits.highFieldOfView = parseFieldOfView(this.maxFieldOfView, 'max-field-of-view')));
    this.#stage.view.unwind();
    return problems;
  }

  #updateSpin() {
    this.#stage.spin = this.#values.autoRotate && !this.#reduced.matches && !this.#timers.pause ? spinSpeed : 0;
  }

  #updateAnimation() {
    if (this.#animation !== null) this.#say('animation', this.#animation.update(this.#values, this.#reduced.matches));
  }

  /** The files shown are others. */
  async #animate(animations) {
    if (animations.length > 0 && this.#animation === null) {
      this.#isAnimating = true;
      try {
        const { Animation } = await import('./animation.js');
        this.#animation ??= new Animation(this.#stage, (type) => this.#dispatch(type));
      } catch (reason) {
        this.#fail('loadfailure', 'animation', `The animations cannot be played: ${reason.message}`, reason);
      }
      this.#isAnimating = false;
      this.#stage.invalidate();
    }
    this.#animation?.reset(animations);
    this.#updateAnimation();
  }

  // --------------------------------------------------------------------------------------------------- loading

  async #load() {
    const { src, loading, environmentImage, skyboxImage } = this.#values;
    if (!this.#isOpen || src === undefined || (loading !== 'eager' && !this.#wasSeen)) return;
    loadCore(VitrineViewer, this.#needsFull).catch(() => {}); // said below
    this.#behind ??= this.#showBackdrop();
    const model = this.#wish;
    if (model.url === '') {
      this.#isLoaded = this.#hasFrame = false;
      this.#stage.dropModel();
      this.#animate([]);
      this.#showPoster();
    }
    if (this.#stage.scene.model?.url !== model.url) this.#isLoaded = false;
    for (const cause of ['model', 'environment', 'background', 'pictures']) this.#say(cause, '');
    const environment = (!this.hasAttribute('environment-image') && skyboxImage) || environmentImage || 'studio';
    if (!(await this.#loader.load({ environment: { url: environment }, background: { url: readBackground(this.#background).kind === 4 ? this.#background : '' }, model }, this.#stage.latest, this.#values.maxMemory ?? undefined))) return;
    this.#openCore();
  }

  /** The stage has the module that there is now. */
  async #openCore() {
    try {
      await this.#behind; // the first frame shall have it
      const loaded = await loadCore(VitrineViewer, this.#needsFull);
      await ownTask();
      this.#stage.core = loaded;
    } catch (reason) {
      this.#fail('loadfailure', 'model', `The renderer cannot be loaded: ${reason.message}`, reason);
    }
  }

  #showBackdrop() {
    return this.#extras.showBackdrop(this.#backdrop, this.#values.backdropDistance);
  }

  /** The larger core, that has a ground, a backdrop, panels and animations; who has it keeps it. */
  get #needsFull() {
    const { ground, shadowIntensity, autoplay, animationName } = this.#values;
    this.#isFull ||= this.#backdrop !== '' || ground || shadowIntensity > 0 || autoplay || animationName !== '' || needsFull(this.#wish) || this.#stage.needsFull;
    return this.#isFull;
  }

  get #background() {
    return this.#values.background || (this.hasAttribute('skybox-image') ? 'environment' : 'transparent');
  }

  get #wish() {
    return wishOf(this.#values);
  }

  #showProgress(value) {
    const { bar } = this.#shadow;
    bar.hidden = value >= 1;
    bar.firstElementChild.style.transform = `scaleX(${value})`;
    bar.setAttribute('aria-valuenow', Math.round(100 * value));
    this.#dispatch('progress', { totalProgress: value });
  }

  #showPoster() {
    const stays = this.reveal === 'manual' && !this.#isDismissed;
    this.#shadow.poster.hidden = this.#hasFrame && !stays;
  }

  // ------------------------------------------------------------------------------------------- what is told

  /** What the stage tells. */
  #tell() {
    return {
      shown: (kind) => {
        if (kind === 'model') this.#loader.progress?.advance(0.95);
      },
      rejected: (kind, sentence) => {
        this.#fail('loadfailure', kind, sentence);
        this.#openCore(); // another one where memory was out
      },
      warned: (cause, sentence) => (sentence ? this.#fail('invalid', cause, sentence) : this.#say(cause, '')),
      animated: (animations) => this.#animate(animations),
      noted: (sentences) => {
        this.#warnings = sentences;
        if (sentences.length > 0) this.#dispatch('warning', { sentences });
      },
      frame: (milliseconds) => this.#onFrame(milliseconds),
      scaled: (detail) => this.#dispatch('render-scale', detail),
      turned: (isByItself) => this.#changedCamera(isByItself ? 'none' : this.#source),
      lost: () => this.#fail('webglcontextlost', 'context', 'The graphics context was lost; the picture comes back with it.'),
      restored: () => this.#say('context', ''),
      failed: (sentence) => this.#fail('loadfailure', 'context', sentence),
      unsupported: (sentence) => this.#fail('unsupported', 'context', sentence),
    };
  }

  #onFrame(milliseconds) {
    this.#hasFrame = true;
    this.#extras.placeHotspots();
    this.#showPoster();
    this.#dispatch('frame', { milliseconds });
    if (this.#isLoaded || this.#isAnimating || this.#stage.scene.model?.url !== this.#wish.url) return;
    this.#isLoaded = true;
    this.#extras.awaitPrompt(this.#values, !this.#reduced.matches);
    this.#loader.progress?.advance(1);
    this.#access.follow();
    this.#dispatch('load', { url: this.#values.relief || this.#values.src });
  }

  #moved(source) {
    this.#source = source;
    if (source === 'user-interaction') {
      this.#extras.endPrompt();
      clearTimeout(this.#timers.pause);
      this.#timers.pause = setTimeout(() => {
        this.#timers.pause = 0;
        this.#updateSpin();
      }, spinPause);
      this.#updateSpin();
    }
    this.#stage.moved();
    this.#access.speak();
    this.#changedCamera(source);
  }

  #changedCamera(source) {
    this.#dispatch('camera-change', { source });
  }

  #fail(type, cause, sentence, sourceError = new Error(sentence)) {
    this.#shadow.bar.hidden = true;
    this.#say(cause, sentence);
    this.#dispatch('error', { type, sourceError });
  }

  #say(cause, sentence) {
    this.#messages.set(cause, sentence);
    const { message } = this.#shadow;
    message.textContent = [...this.#messages.values()].filter(Boolean).join('. ');
    message.hidden = message.textContent === '';
  }

  #dispatch(type, detail) {
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }
}

const xyz = ([x, y, z]) => ({ x, y, z });

function attempt(problems, act) {
  try {
    act();
  } catch (reason) {
    problems.push(reason.message);
  }
}

function paint(image) {
  const canvas = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height });
  canvas.getContext('2d').putImageData(image, 0, 0);
  return canvas;
}

defineProperties(VitrineViewer.prototype);
// Where a server renders the page there are none.
if (globalThis.customElements && !customElements.get('vitrine-viewer')) customElements.define('vitrine-viewer', VitrineViewer);
