// The picture behind the glass: where it comes from, which part of it lies under the element, and when it is put into the
// core's texture anew. Loaded once an element has a backdrop.

const isVideoName = /\.(mp4|m4v|webm|ogv|mov)([?#]|$)/i;
const everywhere = [0, 0, 0, 0]; // of SetBackdrop: the largest part of the element's shape
const followedFor = 60; // frames after the last sign that something moves
const lookedAfter = 100; // milliseconds, where no sign tells of it: Element.animate() has none
const signs = ['scroll', 'resize', 'pointermove', 'pointerdown', 'keydown', 'transitionrun', 'animationstart'];
const tracing = [null, 'exact', 'heightfield']; // techniques that show it

/** Width and height in pixels; 0 where it is not there yet. */
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

export class Backdrop {
  #host;
  #stage;
  #told;
  #fetch;
  #decode;
  #showing = null; // promise of it
  #problems = { opening: '', drawing: '' }; // sentences
  #wish = ''; // the string or object that was asked for last
  #source = null; // that is shown
  #isAnchored = false; // it stands in the page, and the element lies over it
  #isMine = false; // a video that is played here
  #address = ''; // of its source, when the element was in view last
  #distance = 0;
  #part = everywhere;
  #version = 0; // of the picture's pixels
  #frame = 0; // of requestAnimationFrame
  #left = 0; // of followedFor
  #ending = new AbortController(); // of what listens to the source
  #shown = new WeakMap(); // by viewer: what it has

  /**
   * @param {HTMLElement} host the element
   * @param {import('./stage.js').Stage} stage
   * @param {object} told as Extras has it
   * @param {typeof import('./loading.js').fetchSource} fetchSource
   * @param {typeof import('./picture.js').decodePicture} decodePicture
   */
  constructor(host, stage, told, fetchSource, decodePicture) {
    this.#host = host;
    this.#stage = stage;
    this.#told = told;
    this.#fetch = fetchSource;
    this.#decode = decodePicture;
  }

  get isThere() {
    return this.#source !== null;
  }

  /** Where the eye is by itself: with a backdrop straight in front. @param {number[]} eye elsewhere @param {number[]} target */
  straighten(eye, target) {
    const distance = Math.hypot(...eye.map((value, i) => value - target[i]));
    return this.isThere ? [target[0], target[1], target[2] + distance] : eye;
  }

  /**
   * Resolves once it is there, or cannot be; the one before stays then.
   * @param {string|HTMLImageElement|HTMLVideoElement|HTMLCanvasElement|OffscreenCanvas|ImageBitmap} wish URL, #id of an element in the page, or what has the picture; '': none. The same element again: it has changed
   * @param {number|null} distance behind the point looked at; null: beyond all glass
   */
  show(wish, distance) {
    this.#distance = distance ?? 0;
    if (wish !== this.#wish) this.#showing = this.#open((this.#wish = wish));
    else if (typeof wish !== 'string' || this.#isAnchored) this.#changed(false);
    this.#stage.invalidate();
    return this.#showing;
  }

  async #open(wish) {
    const isAnchored = wish[0] === '#';
    let source;
    try {
      source = isAnchored ? this.#find(wish) : wish === '' ? null : typeof wish === 'string' ? await this.#load(wish) : wish;
      if (source?.tagName === 'IMG') await source.decode().catch(() => { throw new Error(`${isAnchored ? wish : source.src}: the picture of backdrop cannot be loaded`); });
    } catch (reason) {
      if (this.#wish === wish) this.#tell('opening', reason.message, reason);
      return;
    }
    if (this.#wish !== wish) return; // another one was asked for in the meantime
    if (this.#isMine) this.#source.pause();
    this.#source = source;
    this.#isAnchored = isAnchored;
    this.#isMine = typeof wish === 'string' && !isAnchored && Boolean(source?.play);
    this.#part = everywhere;
    this.#tell('opening', '');
    this.#address = '';
    this.#changed(false);
    this.see();
  }

  #tell(when, sentence, reason) {
    if (sentence === this.#problems[when]) return;
    this.#problems[when] = sentence;
    const all = Object.values(this.#problems).filter(Boolean).join('. ');
    if (sentence) this.#told.failed('backdrop', all, reason);
    else this.#told.say('backdrop', all);
  }

  #find(wish) {
    const id = wish.slice(1), found = this.#host.getRootNode().getElementById?.(id) ?? document.getElementById(id);
    if (!['IMG', 'VIDEO', 'CANVAS'].includes(found?.tagName)) throw new Error(`backdrop is '${wish}'; there must be an img, a video or a canvas of that id in the page`);
    return found;
  }

  /** A picture, or a video that can be shown. @returns {Promise<ImageBitmap|HTMLVideoElement>} @throws {Error} a sentence */
  async #load(url) {
    if (!isVideoName.test(url)) {
      const { contents } = await this.#fetch(url, new AbortController().signal, () => {});
      const picture = await this.#decode(contents);
      if (picture instanceof ImageBitmap) return picture;
    }
    const video = Object.assign(document.createElement('video'), { crossOrigin: 'anonymous', muted: true, loop: true, playsInline: true, preload: 'auto' });
    await new Promise((resolve, reject) => {
      video.onloadeddata = resolve;
      video.onerror = async () => {
        const ending = new AbortController(); // the server's answer says why; what it sends is not read
        const reason = await this.#fetch(url, ending.signal, () => ending.abort()).catch((one) => one);
        reject(reason instanceof Error && !ending.signal.aborted ? reason : new Error(`${url}: no picture or video that this browser can decode; save it as PNG, JPEG, WebP, WebM or MP4`));
      };
      video.src = url;
    });
    return video;
  }

  /** Its pixels are others. @param {boolean} isMoving there will be more */
  #changed(isMoving = true) {
    this.#version += 1;
    if (isMoving && this.#stage.isVisible) this.#stage.moved();
    else this.#stage.invalidate();
  }

  /** The element has come into view, has left it, or has another source. */
  see() {
    this.#ending.abort();
    const { isVisible } = this.#stage, source = this.#source;
    if (this.#isMine && isVisible && !matchMedia('(prefers-reduced-motion: reduce)').matches) source.play().catch(() => {}); // it stands still then
    else if (this.#isMine) source.pause();
    if (!isVisible || source === null) return;
    this.#ending = new AbortController();
    this.#listen(source, this.#ending.signal);
    if (this.#isAnchored) this.#watch(source, this.#ending.signal);
    if (source.tagName === 'VIDEO' || source.currentSrc !== this.#address) this.#changed(false); // while it was out of view
    this.#address = source.currentSrc;
  }

  /** Hears when it changes by itself. */
  #listen(source, signal) {
    const changed = () => signal.aborted || this.#changed();
    if (source.tagName === 'IMG') source.addEventListener('load', changed, { signal });
    if (source.tagName === 'CANVAS' && source.hasAttribute('layoutsubtree')) drawContent(source, changed, signal);
    if (source.tagName !== 'VIDEO') return;
    const goOn = (isFirst) => {
      if (!isFirst) changed();
      if (!signal.aborted) source.requestVideoFrameCallback(() => goOn(false));
    };
    if (source.requestVideoFrameCallback) goOn(true);
    for (const type of source.requestVideoFrameCallback ? ['loadeddata'] : ['loadeddata', 'timeupdate']) source.addEventListener(type, changed, { signal });
  }

  /** Hears when the element may come to lie over another part of its anchor. */
  #watch(anchor, signal) {
    const follow = () => {
      this.#left = followedFor;
      if (this.#frame === 0) this.#frame = requestAnimationFrame(step);
    };
    const look = () => {
      if (!this.#isElsewhere()) return;
      this.#stage.moved();
      follow();
    };
    const step = () => {
      this.#frame = 0;
      if (signal.aborted || --this.#left < 0) return;
      look();
      if (this.#frame === 0) this.#frame = requestAnimationFrame(step);
    };
    const looking = setInterval(look, lookedAfter);
    for (const type of signs) window.addEventListener(type, follow, { signal, capture: true, passive: true });
    const observers = [new ResizeObserver(follow), new MutationObserver(follow)];
    for (const element of [anchor, this.#host]) observers[0].observe(element);
    for (const root of [document, this.#host.getRootNode()]) observers[1].observe(root, { subtree: true, childList: true, attributeFilter: ['class', 'style', 'hidden'] });
    signal.addEventListener('abort', () => {
      clearInterval(looking);
      cancelAnimationFrame(this.#frame);
      this.#frame = 0;
      for (const observer of observers) observer.disconnect();
    });
    follow();
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
   * @param {object} glass settings of its frame
   * @returns {object} them, as they are with a backdrop
   */
  apply(viewer, glass) {
    if (!viewer.isFull) return glass;
    const before = this.#shown.get(viewer) ?? { address: 0, version: -1 };
    if (this.#source === null) {
      this.#tell('drawing', '');
      if (before.address === viewer.address) viewer.attempt('SetBackdrop', -1, ...everywhere);
      this.#shown.delete(viewer);
      return glass;
    }
    if (this.#isAnchored) this.#isElsewhere();
    const [width, height] = sizeOfSource(this.#source);
    const hasPicture = before.address === viewer.address; // else its context was lost in the meantime
    const isNew = width > 0 && !(hasPicture && before.version === this.#version);
    if (!isNew && !hasPicture) return glass; // it is yet to come
    const failed = isNew ? this.#upload(viewer, width, height) : '';
    const problem = viewer.attempt('SetBackdrop', failed ? -1 : this.#distance, ...this.#part) || failed;
    const lack = tracing.includes(glass.technique) ? '' : `technique ${glass.technique} shows no backdrop; exact and heightfield do`;
    this.#tell('drawing', problem || lack);
    if (problem) this.#shown.delete(viewer);
    else this.#shown.set(viewer, { address: viewer.address, version: this.#version });
    const isSeen = !this.#isAnchored && !this.#host.hasAttribute('background') && !problem && !lack;
    return isSeen ? { ...glass, background: { kind: 0, color: [0, 0, 0] } } : glass; // where no glass is
  }

  /** @returns {string} a sentence, or '' */
  #upload(viewer, width, height) {
    if (viewer.call('SizeBackdrop', width, height) === 0) return viewer.problem();
    const { gl } = viewer; // the texture is bound
    try {
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, gl.RGBA, gl.UNSIGNED_BYTE, this.#source);
    } catch {
      return 'backdrop: this page may not read the pixels of that picture; give it the attribute crossorigin, and have its server answer with Access-Control-Allow-Origin';
    }
    gl.generateMipmap(gl.TEXTURE_2D);
    return '';
  }
}

/** Where the browser can (HTML in canvas), such a canvas has its children drawn into it whenever they change, unless the page does so itself. */
function drawContent(canvas, changed, signal) {
  if (!('drawElementImage' in CanvasRenderingContext2D.prototype)) return;
  canvas.addEventListener('paint', () => {
    if (!canvas.onpaint) {
      const context = canvas.getContext('2d');
      context.reset();
      for (const child of canvas.children) context.drawElementImage(child, 0, 0);
    }
    changed();
  }, { signal });
  canvas.requestPaint();
}
