// The view that is drawn, on its way to where it shall be: each number is a critically damped spring, solved exactly.
import { View } from './view.js';

const settled = 1e-4; // radians, parts of the distance, degrees

/** Azimuth, angle from +Y, logarithm of the distance, target, field of view. */
const numbersOf = ({ theta, phi, distance, target, fieldOfView }) => [theta, phi, Math.log(distance), ...target, fieldOfView];

export class Motion extends View {
  #goal;
  #numbers = null; // null: as the goal
  #speeds = [0, 0, 0, 0, 0, 0, 0]; // a millisecond

  /** @param {View} goal */
  constructor(goal) {
    super();
    this.#goal = goal;
  }

  get #now() {
    return this.#numbers ?? numbersOf(this.#goal);
  }

  get theta() {
    return this.#now[0];
  }

  get phi() {
    return this.#now[1];
  }

  get distance() {
    return Math.exp(this.#now[2]);
  }

  get target() {
    return this.#now.slice(3, 6);
  }

  get fieldOfView() {
    return this.#now[6];
  }

  get isMoving() {
    return this.#numbers !== null;
  }

  /** The goal is reached. */
  jump() {
    this.#numbers = null;
    this.#speeds.fill(0);
  }

  /** From here on the goal may be elsewhere, but no more than half a turn. */
  depart() {
    this.#numbers = numbersOf(this.#goal);
  }

  /** The view turns with its goal. */
  turn(right) {
    if (this.#numbers !== null) this.#numbers[0] += right;
  }

  /** The shorter way round to a goal that was set, not turned to. */
  unwind() {
    if (this.#numbers !== null) this.#numbers[0] += 2 * Math.PI * Math.round((this.#goal.theta - this.#numbers[0]) / (2 * Math.PI));
  }

  /** @param {number} decay milliseconds: of the spring's frequency one part @returns {boolean} the goal is not reached yet */
  step(milliseconds, decay) {
    if (decay === 0) this.jump();
    if (this.#numbers === null) return false;
    const goal = numbersOf(this.#goal);
    const shrink = Math.exp(-milliseconds / decay);
    let isMoving = false;
    goal.forEach((end, i) => {
      const away = this.#numbers[i] - end;
      const speed = this.#speeds[i] + away / decay;
      const next = (away + speed * milliseconds) * shrink;
      this.#numbers[i] = end + next;
      this.#speeds[i] = (speed - (away + speed * milliseconds) / decay) * shrink;
      const size = i > 2 && i < 6 ? this.#goal.distance : 1;
      isMoving ||= Math.abs(next) + Math.abs(this.#speeds[i]) * decay > settled * size;
    });
    if (!isMoving) this.jump();
    return isMoving;
  }
}
