// How much of the picture is computed while it moves, so that a weak GPU keeps up.
const slow = 33, fast = 12; // milliseconds a frame: above, a step down; below, a step up
const slowFrames = 2, fastFrames = 8; // in a row, before a step

/**
 * Parts of the resolution; `lessened`: settings at most those of preset low, which makes a pixel of layered up to twice
 * as fast, and of exact as docs/method.md#what-presets-spend says. Each step costs at most 2.7 times the next: up and down do not alternate.
 */
export const levels = [
  { scale: 1, lessened: false },
  { scale: 0.75, lessened: false },
  { scale: 0.5, lessened: false },
  { scale: 0.43, lessened: true },
  { scale: 0.35, lessened: true },
  { scale: 0.25, lessened: true },
];
const fixed = { high: 0, medium: 1, low: 2 };

export class Quality {
  /** @type {'auto'|'high'|'medium'|'low'} */
  mode = 'auto';
  moving = false;
  #level = 0; // of motion
  #slow = 0;
  #fast = 0;

  get level() {
    return fixed[this.mode] ?? (this.moving ? this.#level : 0);
  }

  /** Why it is at that level. */
  get reason() {
    if (this.mode !== 'auto') return 'quality';
    return this.moving ? 'frame-time' : 'still';
  }

  /** A frame in motion took that long, milliseconds. Returns whether the level changed. */
  note(milliseconds) {
    if (this.mode !== 'auto') return false;
    this.#slow = milliseconds > slow ? this.#slow + 1 : 0;
    this.#fast = milliseconds < fast ? this.#fast + 1 : 0;
    const step = this.#slow >= slowFrames ? 1 : this.#fast >= fastFrames ? -1 : 0;
    const level = Math.max(0, Math.min(levels.length - 1, this.#level + step));
    if (step !== 0) this.#slow = this.#fast = 0;
    if (level === this.#level) return false;
    this.#level = level;
    return true;
  }

  /** Whether less is computed for a pixel, too. */
  get lessened() {
    return this.mode === 'auto' && levels[this.level].lessened; // else only the resolution
  }

  get scale() {
    return levels[this.level].scale;
  }
}
