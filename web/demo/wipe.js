// Two pictures on top of each other and a divider between them: the one on the right is a second viewer that
// follows the first one's camera, or a stored picture.
const restAfter = 300; // milliseconds

export class Wipe {
  #viewer = null;
  #picture = null;
  #parts;
  #rest = 0;

  /** @param {{stage: HTMLElement, right: HTMLElement, cut: HTMLElement, divider: HTMLElement, store: object}} parts */
  constructor(parts) {
    this.#parts = parts;
    const { divider, store, stage } = parts;
    const set = (value) => store.set({ wipe: Math.round(10 * Math.min(100, Math.max(0, value))) / 10 });
    const moveTo = (event) => {
      const { left, right } = stage.getBoundingClientRect();
      set((100 * (event.clientX - left)) / (right - left));
    };
    divider.addEventListener('pointerdown', (event) => {
      if (event.button !== 0) return;
      divider.setPointerCapture(event.pointerId);
      divider.focus({ preventScroll: true });
      event.preventDefault();
      moveTo(event);
    });
    divider.addEventListener('pointermove', (event) => divider.hasPointerCapture(event.pointerId) && moveTo(event));
    const keys = { ArrowLeft: -2, ArrowDown: -2, ArrowRight: 2, ArrowUp: 2, PageDown: -10, PageUp: 10, Home: -100, End: 100 };
    divider.addEventListener('keydown', (event) => {
      if (!Object.hasOwn(keys, event.key) || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      set(store.state.wipe + keys[event.key]);
    });
    store.subscribe(({ wipe }, changed) => {
      if (!changed.has('wipe')) return;
      stage.style.setProperty('--wipe', wipe / 100);
      divider.setAttribute('aria-valuenow', Math.round(wipe));
      divider.setAttribute('aria-valuetext', `${Math.round(wipe)} % of the width shows the left picture`);
    });
  }

  #show(isShown) {
    this.#parts.right.hidden = this.#parts.cut.hidden = !isShown;
  }

  #drop(name) {
    if (name !== 'viewer') {
      this.#viewer?.remove();
      this.#viewer = null;
    }
    if (name !== 'picture') {
      this.#picture?.remove();
      this.#picture = null;
    }
  }

  hide() {
    this.#drop();
    this.#show(false);
  }

  /** @param {(viewer: HTMLElement) => void} dress sets its attributes */
  showViewer(dress) {
    this.#drop('viewer');
    const isNew = this.#viewer === null;
    if (isNew) {
      this.#viewer = document.createElement('vitrine-viewer');
      this.#viewer.interpolationDecay = 0; // it follows
      this.#viewer.inert = true; // gestures go to the one below
    }
    dress(this.#viewer);
    if (isNew) this.#parts.right.append(this.#viewer);
    this.#show(true);
  }

  /** A picture of the same field of view, in the middle of the stage. */
  showPicture(url) {
    this.#drop('picture');
    if (this.#picture === null) {
      this.#picture = Object.assign(document.createElement('div'), { className: 'picture', role: 'img', ariaLabel: 'The stored picture' });
      this.#parts.right.append(this.#picture);
    }
    if (this.#picture.dataset.url !== url) {
      this.#picture.dataset.url = url;
      this.#picture.style.backgroundImage = `url("${url}")`;
    }
    this.#show(true);
  }

  /** The first viewer's camera moved; the second one draws less until it rests. */
  follow(orbit, target, quality) {
    const viewer = this.#viewer;
    if (viewer === null || (viewer.getAttribute('camera-orbit') === orbit && viewer.getAttribute('camera-target') === target)) return;
    viewer.setAttribute('camera-orbit', orbit);
    viewer.setAttribute('camera-target', target);
    if (quality !== 'auto') return;
    viewer.setAttribute('quality', 'low');
    clearTimeout(this.#rest);
    this.#rest = setTimeout(() => viewer.setAttribute('quality', quality), restAfter);
  }
}
