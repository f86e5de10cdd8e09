// Plays the animations of the files that an element shows. A page loads this only for such files.

/**
 * One for an element. Time goes on only while frames are drawn: not off screen. `autoplay` is not heeded where the
 * visitor prefers reduced motion; play() is.
 */
export class Animation {
  #stage;
  #tell;
  #all = []; // {name, duration} of the files shown
  #wanted = ''; // animation-name
  #isAuto = false; // autoplay, and motion is welcome
  #isPlaying = false;
  #seconds = 0;
  #last = 0; // milliseconds, of the frame before; 0: none

  /** @param {import('./stage.js').Stage} stage @param {(type: 'play'|'pause'|'loop') => void} tell */
  constructor(stage, tell) {
    this.#stage = stage;
    this.#tell = tell;
  }

  /** Names of the animations, each once. */
  get names() {
    return [...new Set(this.#all.map(({ name }) => name))];
  }

  get paused() {
    return !this.#isPlaying;
  }

  /** Seconds of the one that is played: the one of animation-name, else each file's first. */
  get duration() {
    const named = this.#all.filter(({ name, isFirst }) => (this.#wanted === '' ? isFirst : name === this.#wanted));
    return Math.max(0, ...named.map(({ duration }) => duration));
  }

  get currentTime() {
    return this.#seconds;
  }

  set currentTime(seconds) {
    if (!Number.isFinite(seconds)) throw new TypeError(`currentTime is ${seconds}; it must be a number of seconds`);
    this.#seconds = Math.min(Math.max(seconds, 0), this.duration);
    this.#show();
  }

  play() {
    if (this.#isPlaying || this.duration === 0) return;
    this.#isPlaying = true;
    this.#last = 0;
    this.#stage.motion = (time) => this.#advance(time);
    this.#tell('play');
  }

  pause() {
    if (!this.#isPlaying) return;
    this.#isPlaying = false;
    this.#stage.motion = null;
    this.#tell('pause');
  }

  /** The files shown are others. @param {{name: string, duration: number, isFirst: boolean}[]} all */
  reset(all) {
    this.pause();
    this.#all = all;
    this.#seconds = 0;
    if (this.#isAuto) this.play();
  }

  /** @param {{autoplay: boolean, animationName: string}} values of attributes @param {boolean} isReduced motion is unwelcome @returns {string} a sentence where nothing has that name, or '' */
  update({ autoplay, animationName }, isReduced) {
    const isAuto = autoplay && !isReduced;
    if (animationName !== this.#wanted) {
      this.#wanted = animationName;
      this.#seconds = 0;
      this.#show();
    }
    if (isAuto && !this.#isAuto) this.play();
    if (!isAuto && this.#isAuto) this.pause();
    this.#isAuto = isAuto;
    if (animationName === '' || this.#all.length === 0 || this.names.includes(animationName)) return '';
    return `animation-name is '${animationName}'; the files have ${this.names.map((name) => `'${name}'`).join(', ')}`;
  }

  #advance(time) {
    const passed = this.#last === 0 ? 0 : Math.min(0.2, (time - this.#last) / 1000); // nothing is missed off screen
    const { duration } = this;
    this.#last = time;
    this.#seconds += passed;
    if (this.#seconds > duration) {
      this.#seconds %= duration;
      this.#tell('loop');
    }
    this.#show();
  }

  #show() {
    if (this.#all.length > 0) this.#stage.pose = { name: this.#wanted, seconds: this.#seconds };
  }
}
