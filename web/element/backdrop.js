// The picture behind the glass: where it comes from, which part of it the element lies over, and when it is put into the
// core's texture anew. Loaded once an element has a backdrop.

const isVideoName = /\.(mp4|m4v|webm|ogv|mov)([?#]|$)/i;
const everywhere = [0, 0, 0, 0]; // of SetBackdrop: the largest part of the canvas's shape

/** Width and height in pixels, as far as it is there yet. */
const sizeOfSource = (source) => [source.videoWidth ?? source.naturalWidth ?? source.width, source.videoHeight ?? source.naturalHeight ?? source.height];

/** CSS's object-position along an axis: a length, or a share of the room that is left. */
function placeWithin(text, room) {
  const number = parseFloat(text);
  return Number.isNaN(number) ? 0.5 * room : text.endsWith('%') ? (number / 100) * room : number;
}

/** Where an element shows its whole picture, client coordinates. @param {HTMLElement} element @param {number[]} size of the picture */
function pictureBox(element, [pictureWidth, pictureHeight]) {
  const box = element.getBoundingClientRect(), style = getComputedStyle(element);
  const [left, top, right, bottom] = ['Left', 'Top', 'Right', 'Bottom'].map((side) => parseFloat(style[`padding${side}`]) + parseFloat(style[`border${side}Width`]));
  const [across, down] = [box.width / element.offsetWidth, box.height / element.offsetHeight]; // of transforms
  const [width, height] = [element.offsetWidth - left - right, element.offsetHeight - top - bottom];
  const scales = [width / pictureWidth, height / pictureHeight], fit = style.objectFit;
  const scale = fit === 'cover' ? Math.max(...scales) : fit === 'contain' ? Math.min(...scales) : fit === 'scale-down' ? Math.min(1, ...scales) : 1;
  const [shownWidth, shownHeight] = fit === 'fill' ? [width, height] : [scale * pictureWidth, scale * pictureHeight];
  const [x, y] = style.objectPosition.split(' ');
  return {
    left: box.left + across * (left + placeWithin(x, width - shownWidth)),
    top: box.top + down * (top + placeWithin(y, height - shownHeight)),
    width: across * shownWidth,
    height: down * shownHeight,
  };
}

/** Of a URL. @returns {Promise<HTMLImageElement|HTMLVideoElement>} @throws {Error} a sentence */
async function fetchPicture(url, moves) {
  const isVideo = isVideoName.test(url);
  const source = Object.assign(document.createElement(isVideo ? 'video' : 'img'), { crossOrigin: 'anonymous' });
  if (isVideo) Object.assign(source, { muted: true, loop: true, playsInline: true, autoplay: moves });
  const loaded = new Promise((resolve, reject) => {
    source.addEventListener(isVideo ? 'loadeddata' : 'load', resolve, { once: true });
    source.addEventListener('error', () => reject(new Error(`backdrop is '${url}': no picture or video that this browser can load; a server elsewhere has to answer with Access-Control-Allow-Origin`)), { once: true });
  });
  source.src = url;
  await loaded;
  return source;
}

export class Backdrop {
  #host;
  #stage;
  #told;
  #showing = null; // promise of it
  #problem = ''; // of the last frame, a sentence
  #wish = null; // the string or object that was asked for last
  #source = null; // that is shown
  #isAnchored = false; // it stands in the page, and the element lies over it
  #isMine = false; // a video that is played here
  #distance = 0;
  #part = everywhere;
  #version = 0; // of the picture's pixels
  #frame = 0; // of requestAnimationFrame
  #shown = new WeakMap(); // by viewer: what it has

  /**
   * @param {HTMLElement} host the element
   * @param {import('./stage.js').Stage} stage
   * @param {(sentence: string, reason?: Error) => void} told '': nothing is wrong
   */
  constructor(host, stage, told) {
    this.#host = host;
    this.#stage = stage;
    this.#told = told;
    stage.backdrop = this;
  }

  /** Is there one, so that the view is straight by itself? */
  get isThere() {
    return this.#source !== null;
  }

  /**
   * Resolves once it is there, or cannot be.
   * @param {string|HTMLImageElement|HTMLVideoElement|HTMLCanvasElement|OffscreenCanvas|ImageBitmap} wish URL, #id of an element in the page, or what has the picture; '': none. The same object again: it has changed
   * @param {number|null} distance behind the point looked at; null: beyond all glass
   */
  show(wish, distance) {
    this.#distance = distance ?? 0;
    this.#version += typeof wish !== 'string';
    this.#stage.invalidate();
    if (wish !== this.#wish) this.#showing = this.#open((this.#wish = wish));
    return this.#showing;
  }

  async #open(wish) {
    let problem = '', source = null;
    const isAnchored = typeof wish === 'string' && wish.startsWith('#');
    try {
      source = isAnchored ? await this.#find(wish) : typeof wish === 'string' ? wish && (await fetchPicture(wish, !matchMedia('(prefers-reduced-motion: reduce)').matches)) : wish;
    } catch (reason) {
      problem = reason;
    }
    if (this.#wish !== wish) return; // another one was asked for in the meantime
    if (this.#isMine) this.#source.pause();
    this.#source = source || null;
    this.#isAnchored = isAnchored;
    this.#isMine = Boolean(source?.play) && typeof wish === 'string' && !isAnchored;
    this.#part = everywhere;
    this.#version += 1;
    this.#told(problem && problem.message, problem || undefined);
    this.#watch(this.#source);
    this.#stage.invalidate();
  }

  /** The element of the page, once its picture is there. */
  async #find(wish) {
    const found = this.#host.getRootNode().querySelector?.(`[id="${CSS.escape(wish.slice(1))}"]`);
    if (!found || !['IMG', 'VIDEO', 'CANVAS'].includes(found.tagName)) throw new Error(`backdrop is '${wish}'; there must be an img, a video or a canvas of that id in the page`);
    if (found.tagName === 'IMG') await found.decode().catch(() => { throw new Error(`backdrop is '${wish}', whose picture cannot be loaded`); });
    if (found.tagName === 'VIDEO' && found.readyState < 2) await new Promise((done) => found.addEventListener('loadeddata', done, { once: true }));
    return found;
  }

  /** Follows what moves: frames of a video, content of a canvas, the element over its anchor. */
  #watch(source) {
    cancelAnimationFrame(this.#frame);
    if (source === null) return;
    const isCurrent = () => this.#source === source && this.#host.isConnected;
    const changed = () => {
      this.#version += 1;
      if (this.#stage.isVisible) this.#stage.moved();
    };
    if (source.requestVideoFrameCallback) {
      const onFrame = () => {
        if (this.#source !== source) return;
        changed();
        source.requestVideoFrameCallback(onFrame);
      };
      source.requestVideoFrameCallback(onFrame);
    }
    if (source.tagName === 'IMG') source.addEventListener('load', () => isCurrent() && changed()); // another src
    drawContent(source, () => isCurrent() && changed());
    const isPolled = source.tagName === 'VIDEO' && !source.requestVideoFrameCallback;
    if (!this.#isAnchored && !this.#isMine && !isPolled) return;
    let time = 0;
    const step = () => {
      if (this.#source !== source) return;
      if (isPolled && source.currentTime !== time) {
        time = source.currentTime;
        changed();
      }
      if (this.#isMine && source.autoplay && source.paused === (this.#stage.isVisible && this.#host.isConnected)) {
        if (source.paused) source.play().catch(() => { source.autoplay = false; });
        else source.pause();
      }
      if (this.#isAnchored && this.#stage.isVisible && this.#isElsewhere()) this.#stage.invalidate();
      this.#frame = requestAnimationFrame(step);
    };
    step();
  }

  /** Has the element come to lie over another part of its anchor? */
  #isElsewhere() {
    const view = this.#host.getBoundingClientRect(), box = pictureBox(this.#source, sizeOfSource(this.#source));
    const part = [(view.left - box.left) / box.width, (view.top - box.top) / box.height, (view.right - box.left) / box.width, (view.bottom - box.top) / box.height];
    const is = part.every(Number.isFinite) && part[0] < part[2] && part[1] < part[3] && part.some((value, i) => Math.abs(value - this.#part[i]) > 1e-6);
    if (is) this.#part = part;
    return is;
  }

  /**
   * Gives a viewer what it has not yet, before it draws.
   * @param {import('./core.js').Viewer} viewer
   * @returns {object} settings of its frame that go before the element's
   */
  apply(viewer) {
    if (!viewer.isFull) return {};
    const before = this.#shown.get(viewer) ?? { version: -1, address: 0, text: '' };
    if (this.#source === null) {
      if (before.text !== '') viewer.attempt('SetBackdrop', -1, ...everywhere);
      this.#shown.delete(viewer);
      return {};
    }
    if (this.#isAnchored) this.#isElsewhere();
    const [width, height] = sizeOfSource(this.#source), text = `${this.#distance} ${this.#part}`;
    const isOther = before.address !== viewer.address; // its context was lost in the meantime
    let problem = '';
    if (width > 0 && (isOther || before.version !== this.#version)) problem = this.#upload(viewer, width, height);
    if (!problem && (width > 0 || before.text !== '')) problem = viewer.attempt('SetBackdrop', this.#distance, ...this.#part);
    if (problem !== this.#problem) this.#told((this.#problem = problem));
    this.#shown.set(viewer, { version: this.#version, address: viewer.address, text });
    const isSeen = !this.#isAnchored && !this.#host.hasAttribute('background');
    return isSeen && !problem ? { background: { kind: 0, color: [0, 0, 0] } } : {}; // where no glass is
  }

  /** @returns {string} a sentence, or '' */
  #upload(viewer, width, height) {
    if (viewer.call('SizeBackdrop', width, height) === 0) return viewer.problem();
    const { gl } = viewer; // the texture is bound
    try {
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, gl.RGBA, gl.UNSIGNED_BYTE, this.#source);
    } catch {
      return 'backdrop: this page may not read the pixels of that picture; give it crossorigin, and have its server answer with Access-Control-Allow-Origin';
    }
    gl.generateMipmap(gl.TEXTURE_2D);
    return '';
  }
}

/**
 * Where the browser can (HTML in canvas), a canvas with layoutsubtree has its children drawn into it whenever they change,
 * unless the page does so itself.
 */
function drawContent(source, changed) {
  if (source.tagName !== 'CANVAS' || !source.hasAttribute('layoutsubtree')) return;
  if (!source.onpaint && 'drawElementImage' in CanvasRenderingContext2D.prototype) {
    source.onpaint = () => {
      const context = source.getContext('2d');
      context.reset();
      for (const child of source.children) context.drawElementImage(child, 0, 0);
    };
  }
  source.addEventListener('paint', changed);
  source.requestPaint?.();
}
