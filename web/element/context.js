// The WebGL context that all elements of a page draw with, so that shaders are compiled once and there may be any number
// of them: browsers keep about 16 contexts. They draw in turn into a canvas that nobody sees; each picture goes to the
// canvas of its element without a copy once the GPU has made it. Taken earlier, it would hold up the page in browsers
// that read it back.

const settings = {
  majorVersion: 2,
  alpha: true,
  premultipliedAlpha: false,
  antialias: false,
  depth: false,
  stencil: false,
  preserveDrawingBuffer: false,
  powerPreference: 'high-performance',
  enableExtensionsByDefault: false, // Emscripten's; asking for all of them holds the page up
};

/**
 * @typedef {object} Drawer one who draws with the context
 * @property {() => void} onLost what it has on the GPU is gone
 * @property {() => void} onRestored it has to make that anew
 */

export class Context {
  /** @type {Set<Drawer>} */
  drawers = new Set();
  #core;
  #canvas;
  #handle; // Emscripten's
  #queue = []; // who waits for a turn
  #holder = null; // whose turn it is

  /** @param core from loadCore @throws {Error} where the browser has no WebGL 2 */
  constructor(core) {
    this.#core = core;
    this.#open();
  }

  #open() {
    const canvas = typeof OffscreenCanvas === 'undefined' ? null : new OffscreenCanvas(1, 1);
    const handle = canvas && this.#core.GL.createContext(canvas, settings);
    if (!handle) throw new Error('This browser opens no WebGL 2 context; turn hardware acceleration on or try another browser');
    const listen = (type, act) => canvas.addEventListener(type, (event) => {
      if (canvas !== this.#canvas) return; // given up
      event.preventDefault();
      act();
    });
    listen('webglcontextlost', () => this.#lose());
    listen('webglcontextrestored', () => this.#restore());
    [this.#canvas, this.#handle] = [canvas, handle];
  }

  #lose() {
    this.#queue = [];
    this.#holder = null;
    for (const drawer of this.drawers) drawer.onLost();
  }

  #restore() {
    this.makeCurrent();
    for (const drawer of this.drawers) drawer.onRestored();
  }

  get gl() {
    return this.#core.GL.getContext(this.#handle).GLctx;
  }

  get isLost() {
    return this.gl.isContextLost();
  }

  makeCurrent() {
    this.#core.GL.makeContextCurrent(this.#handle);
  }

  /** In place of one that was lost and has not come back. @throws {Error} where there is none */
  renew() {
    const lost = this.#handle;
    this.#lose();
    this.#open();
    this.#core.GL.deleteContext(lost);
    this.#restore();
  }

  /** Gives everything back. */
  destroy() {
    const { gl } = this;
    this.#canvas = null;
    this.#core.GL.deleteContext(this.#handle);
    this.#core.GL.makeContextCurrent(0);
    if (!gl.isContextLost()) gl.getExtension('WEBGL_lose_context')?.loseContext(); // now, not when garbage is collected
  }

  /**
   * Calls `act` once the canvas is free, which it then is for nobody else until `leave`.
   * @param {Drawer} drawer
   * @param {boolean} isUrgent goes before those that are not
   */
  enter(drawer, isUrgent, act) {
    const place = isUrgent ? this.#queue.findIndex((other) => !other.isUrgent) : -1;
    this.#queue.splice(place < 0 ? this.#queue.length : place, 0, { drawer, isUrgent, act });
    this.#goOn();
  }

  /** Its turn is over, or no longer wanted. */
  leave(drawer) {
    this.#queue = this.#queue.filter((other) => other.drawer !== drawer);
    if (this.#holder === drawer) this.#holder = null;
    this.#goOn();
  }

  #goOn() {
    if (this.#holder !== null || this.#queue.length === 0) return;
    const { drawer, act } = this.#queue.shift();
    this.#holder = drawer;
    act();
  }

  /** The canvas has that size, in pixels. */
  resize(width, height) {
    if (this.#canvas.width !== width) this.#canvas.width = width;
    if (this.#canvas.height !== height) this.#canvas.height = height;
  }

  /** What has been drawn is shown on a canvas. @param {HTMLCanvasElement} canvas */
  show(canvas) {
    const { width, height } = this.#canvas;
    if (canvas.width !== width) canvas.width = width;
    if (canvas.height !== height) canvas.height = height;
    canvas.getContext('bitmaprenderer').transferFromImageBitmap(this.#canvas.transferToImageBitmap());
  }
}
