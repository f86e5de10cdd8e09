// Where the camera shall be: about a target, in the words of model-viewer.
import { View } from './view.js';

const lowestPhi = Math.PI / 90;
const nearest = 0.25, farthest = 4; // of the distance that shows the whole object
const lengths = { m: 1, cm: 0.01, mm: 0.001 };
const least = 1e-9, most = 1e9; // of what the core's floats can still compute with, as --object has them

function quantity(text, units) {
  const [, digits, unit] = /^([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)([a-z%]*)$/i.exec(text) ?? [];
  const value = digits !== undefined && Object.hasOwn(units, unit) ? Number(digits) * units[unit] : NaN;
  return Math.abs(value) <= most ? value : NaN;
}

export const angle = (text) => quantity(text, { deg: Math.PI / 180, rad: 1 });
export const words = (text, count, name) => {
  const list = text.trim().split(/\s+/);
  if (list.length === count) return list;
  throw new Error(`${name} is '${text}'; it must have ${count} parts`);
};

/**
 * @param {string} text of camera-orbit, or of its limits
 * @returns {{theta: number|null, phi: number|null, radius: {value: number, unit: 'm'|'%'}|null}} null: auto
 * @throws {Error} a sentence
 */
export function parseOrbit(text, name = 'camera-orbit') {
  const [theta, phi, radius] = words(text, 3, name);
  const percent = quantity(radius, { '%': 1 });
  const orbit = {
    theta: theta === 'auto' ? null : angle(theta),
    phi: phi === 'auto' ? null : angle(phi),
    radius: radius === 'auto' ? null : Number.isNaN(percent) ? { value: quantity(radius, lengths), unit: 'm' } : { value: percent, unit: '%' },
  };
  if ([orbit.theta, orbit.phi, orbit.radius?.value].some(Number.isNaN) || orbit.radius?.value < least) {
    throw new Error(`${name} is '${text}'; it must be like '30deg 75deg 100%': deg or rad twice, then m, cm, mm or % above 0, or auto`);
  }
  return orbit;
}

/** @returns {(number|null)[]} x, y, z; null: auto */
export function parseTarget(text) {
  const target = words(text, 3, 'camera-target').map((word) => (word === 'auto' ? null : quantity(word, lengths)));
  if (target.some(Number.isNaN)) throw new Error(`camera-target is '${text}'; it must be like '0m 0.5m 0m': m, cm or mm, or auto`);
  return target;
}

/**
 * Where a model lies, as keys of `objects`. Turned by YXZ, as model-viewer does; those keys turn by ZYX.
 * @returns {string} '': as it is @throws {Error} a sentence
 */
export function parsePlacement(orientation, scale) {
  const angles = words(orientation, 3, 'orientation').map(angle);
  const factors = scale.trim().split(/\s+/).map(Number);
  if (angles.some(Number.isNaN)) throw new Error(`orientation is '${orientation}'; it must be like '0deg 90deg 0deg': deg or rad thrice`);
  if (![1, 3].includes(factors.length) || !factors.every((factor) => factor > 0 && factor < Infinity)) throw new Error(`scale is '${scale}'; it must be one or three numbers above 0`);
  const [[sz, sx, sy], [cz, cx, cy]] = [angles.map(Math.sin), angles.map(Math.cos)];
  const turns = [Math.atan2(cy * sx * cz + sy * sz, cx * cy), Math.asin(Math.max(-1, Math.min(1, sy * cz - cy * sx * sz))), Math.atan2(cx * sz, cy * cz + sy * sx * sz)];
  const keys = [turns.some((turn) => turn !== 0) && `rotate=${turns.map((turn) => (turn * 180) / Math.PI)}`, factors.some((factor) => factor !== 1) && `scale=${factors}`];
  return keys.filter(Boolean).join();
}

/** @returns {number|null} degrees; null: auto */
export function parseFieldOfView(text, name = 'field-of-view') {
  if (text.trim() === 'auto') return null;
  const degrees = (angle(text.trim()) * 180) / Math.PI;
  if (degrees >= 1 && degrees <= 170) return degrees;
  throw new Error(`${name} is '${text}'; it must be 1deg to 170deg, in deg or rad, or auto`);
}

export const usualFieldOfView = 45; // degrees

const clamp = (value, low, high) => Math.min(high ?? Infinity, Math.max(low ?? -Infinity, value));
const none = { theta: null, phi: null, radius: null };

/** What is auto follows `framed`, the view that shows the whole object. */
export class Orbit extends View {
  framed = { theta: 0, phi: Math.PI / 2, distance: 1, target: [0, 0, 0], fieldOfView: usualFieldOfView };
  wantedFieldOfView = null; // vertical, degrees; null: auto
  wantedTarget = [null, null, null];
  /** As parseOrbit and parseFieldOfView give them; null: none. */
  limits = { low: none, high: none, lowFieldOfView: null, highFieldOfView: null };

  constructor() {
    super();
    this.place(none);
  }

  place({ theta, phi, radius }) {
    this.wanted = { theta, phi };
    this.radius = radius === null ? { value: 100, unit: '%' } : { ...radius };
  }

  aim(target) {
    this.wantedTarget = target;
  }

  /** Takes over the view that shows the whole object, or the file's camera. */
  frame(eye, target, fieldOfView) {
    const [x, y, z] = eye.map((value, i) => value - target[i]);
    const distance = Math.hypot(x, y, z);
    this.framed = { theta: Math.atan2(x, z), phi: Math.acos(y / distance), distance, target, fieldOfView };
  }

  get fieldOfView() {
    return this.limitFieldOfView(this.wantedFieldOfView ?? this.framed.fieldOfView);
  }

  limitFieldOfView(degrees) {
    return clamp(degrees, this.limits.lowFieldOfView, this.limits.highFieldOfView);
  }

  get theta() {
    const { low, high } = this.limits;
    return clamp(this.wanted.theta ?? this.framed.theta, low.theta, high.theta);
  }

  get phi() {
    const { low, high } = this.limits;
    return clamp(clamp(this.wanted.phi ?? this.framed.phi, low.phi, high.phi), lowestPhi, Math.PI - lowestPhi);
  }

  get distance() {
    const { low, high } = this.limits;
    return clamp(this.#lengthOf(this.radius), this.#lengthOf(low.radius), this.#lengthOf(high.radius));
  }

  #lengthOf(radius) {
    return radius?.unit === '%' ? (this.framed.distance * radius.value) / 100 : radius?.value;
  }

  get target() {
    return this.wantedTarget.map((value, i) => value ?? this.framed.target[i]);
  }

  /** The eye goes right and up. */
  turn(right, up) {
    this.wanted = { theta: this.theta + right, phi: this.phi - up };
    this.wanted = { theta: this.theta, phi: this.phi }; // within the limits
  }

  /** Nearer with a factor below 1; within the limits, else a quarter and four times the framed distance. */
  zoom(factor) {
    const { distance, framed, limits } = this;
    const low = limits.low.radius ? 0 : Math.min(distance, nearest * framed.distance);
    const high = limits.high.radius ? Infinity : Math.max(distance, farthest * framed.distance);
    this.radius.value *= clamp(distance * factor, low, high) / this.#lengthOf(this.radius);
    this.radius.value *= this.distance / this.#lengthOf(this.radius);
  }

  /** The target goes right and up by parts of the picture's height. */
  pan(right, up) {
    const { target } = this;
    const height = 2 * this.distance * Math.tan((this.fieldOfView * Math.PI) / 360);
    const { across, upwards } = this.axes();
    this.wantedTarget = target.map((value, i) => value + height * (right * across[i] + up * upwards[i]));
  }

  /** For those who cannot see it. */
  describe() {
    const sides = ['the front', 'the front right', 'the right', 'the back right', 'the back', 'the back left', 'the left', 'the front left'];
    const side = sides[((Math.round((this.theta * 4) / Math.PI) % 8) + 8) % 8];
    const degrees = 90 - (this.phi * 180) / Math.PI;
    const heights = [[60, 'from far above'], [30, 'from above'], [8, 'from slightly above'], [-8, 'level'], [-30, 'from slightly below'], [-60, 'from below']];
    const height = heights.find(([least]) => degrees >= least)?.[1] ?? 'from far below';
    return `Seen from ${side}, ${height}, at ${Math.round((100 * this.distance) / this.framed.distance)} % of the usual distance.`;
  }
}
