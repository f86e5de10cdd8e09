// How much of the picture is computed while it moves, so that a weak GPU keeps up.
const slow = 33, fast = 12; // milliseconds a frame: above, a step down; below, a step up
const slowFrames = 2, fastFrames = 8; // in a row, before a step

/** Parts of resolution and settings. Each step costs at most 2.7 times the next: up and down do not alternate. */
export const levels = [
  { scale: 1, steps: 1, layers: 16, maxEvents: 64 },
  { scale: 0.75, steps: 1, layers: 16, maxEvents: 64 },
  { scale: 0.5, steps: 0.8, layers: 16, maxEvents: 64 },
  { scale: 0.35, steps: 0.6, layers: 3, maxEvents: 6 },
  { scale: 0.25, steps: 0.5, layers: 2, maxEvents: 4 },
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

  /** Settings of the next frame, from those of a full one. */
  reduce({ layers, steps, maxEvents, ...rest }) {
    if (this.mode !== 'auto') return { ...rest, layers, steps, maxEvents }; // only the resolution
    const level = levels[this.level];
    return {
      ...rest,
      layers: Math.min(layers, level.layers),
      steps: Math.max(1, Math.round(steps * level.steps)),
      maxEvents: Math.min(maxEvents, level.maxEvents),
    };
  }

  get scale() {
    return levels[this.level].scale;
  }
}
