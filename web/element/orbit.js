// The camera: about a target, in the words of model-viewer. Angles in radians, lengths in the model's unit
// (metres in glTF); azimuth theta is 0 towards +Z and grows towards +X, phi is the angle from +Y.
const lowestPhi = Math.PI / 90;
const nearest = 0.25, farthest = 4; // of the distance that shows the whole object
const lengths = { m: 1, cm: 0.01, mm: 0.001 };

function quantity(text, units) {
  const [, digits, unit] = /^([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)([a-z%]*)$/i.exec(text) ?? [];
  return digits !== undefined && Object.hasOwn(units, unit) ? Number(digits) * units[unit] : NaN;
}

const angle = (text) => quantity(text, { deg: Math.PI / 180, rad: 1 });
const words = (text, count, name) => {
  const list = text.trim().split(/\s+/);
  if (list.length === count) return list;
  throw new Error(`${name} is '${text}'; it must have ${count} parts`);
};

/**
 * @param {string} text of camera-orbit
 * @returns {{theta: number|null, phi: number|null, radius: {value: number, unit: 'm'|'%'}}} null: auto
 * @throws {Error} a sentence
 */
export function parseOrbit(text) {
  const [theta, phi, radius] = words(text, 3, 'camera-orbit');
  const percent = radius === 'auto' ? 100 : quantity(radius, { '%': 1 });
  const orbit = {
    theta: theta === 'auto' ? null : angle(theta),
    phi: phi === 'auto' ? null : angle(phi),
    radius: Number.isNaN(percent) ? { value: quantity(radius, lengths), unit: 'm' } : { value: percent, unit: '%' },
  };
  if ([orbit.theta, orbit.phi, orbit.radius.value].some(Number.isNaN) || orbit.radius.value <= 0) {
    throw new Error(`camera-orbit is '${text}'; it must be like '30deg 75deg 100%': deg or rad twice, then m, cm, mm or % above 0, or auto`);
  }
  return orbit;
}

/** @returns {(number|null)[]} x, y, z; null: auto */
export function parseTarget(text) {
  const target = words(text, 3, 'camera-target').map((word) => (word === 'auto' ? null : quantity(word, lengths)));
  if (target.some(Number.isNaN)) throw new Error(`camera-target is '${text}'; it must be like '0m 0.5m 0m': m, cm or mm, or auto`);
  return target;
}

/** @returns {number|null} degrees; null: auto */
export function parseFieldOfView(text) {
  if (text.trim() === 'auto') return null;
  const degrees = (angle(text.trim()) * 180) / Math.PI;
  if (degrees >= 1 && degrees <= 170) return degrees;
  throw new Error(`field-of-view is '${text}'; it must be 1deg to 170deg, in deg or rad, or auto`);
}

export const usualFieldOfView = 45; // degrees

/** Where the camera is. What is auto follows `framed`, the view that shows the whole object. */
export class Orbit {
  framed = { theta: 0, phi: Math.PI / 2, distance: 1, target: [0, 0, 0], fieldOfView: usualFieldOfView };
  wantedFieldOfView = null; // vertical, degrees; null: auto

  constructor() {
    this.place(parseOrbit('auto auto auto'));
    this.aim([null, null, null]);
  }

  place({ theta, phi, radius }) {
    this.wanted = { theta, phi };
    this.radius = { ...radius };
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
    return this.wantedFieldOfView ?? this.framed.fieldOfView;
  }

  get theta() {
    return this.wanted.theta ?? this.framed.theta;
  }

  get phi() {
    return Math.min(Math.PI - lowestPhi, Math.max(lowestPhi, this.wanted.phi ?? this.framed.phi));
  }

  get distance() {
    return this.radius.unit === '%' ? (this.framed.distance * this.radius.value) / 100 : this.radius.value;
  }

  get target() {
    return this.wantedTarget.map((value, i) => value ?? this.framed.target[i]);
  }

  get eye() {
    const { theta, phi, distance, target } = this;
    const direction = [Math.sin(phi) * Math.sin(theta), Math.cos(phi), Math.sin(phi) * Math.cos(theta)];
    return target.map((value, i) => value + distance * direction[i]);
  }

  /** The eye goes right and up. */
  turn(right, up) {
    const phi = Math.min(Math.PI - lowestPhi, Math.max(lowestPhi, this.phi - up));
    this.wanted = { theta: this.theta + right, phi };
  }

  /** Nearer with a factor below 1; within a quarter and four times the framed distance. */
  zoom(factor) {
    const { distance, framed } = this;
    const low = Math.min(distance, nearest * framed.distance), high = Math.max(distance, farthest * framed.distance);
    this.radius.value *= Math.min(high, Math.max(low, distance * factor)) / distance;
  }

  /** The target goes right and up by parts of the picture's height. */
  pan(right, up) {
    const { target } = this;
    const height = 2 * this.distance * Math.tan((this.fieldOfView * Math.PI) / 360);
    const { across, upwards } = this.#axes();
    this.wantedTarget = target.map((value, i) => value + height * (right * across[i] + up * upwards[i]));
  }

  /** Unit vectors of the picture's right and up. */
  #axes() {
    const { theta, phi } = this;
    const across = [Math.cos(theta), 0, -Math.sin(theta)];
    const upwards = [-Math.cos(phi) * Math.sin(theta), Math.sin(phi), -Math.cos(phi) * Math.cos(theta)];
    return { across, upwards };
  }

  /** Where a world point is seen: x and y from -1 to 1 within the picture, right and up. */
  project(point, aspect) {
    const { eye, target, distance } = this;
    const { across, upwards } = this.#axes();
    const dot = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);
    const offset = point.map((value, i) => value - eye[i]);
    const depth = Math.max(1e-6 * distance, dot(offset, target.map((value, i) => (value - eye[i]) / distance)));
    const tangent = Math.tan((this.fieldOfView * Math.PI) / 360);
    return [dot(offset, across) / (depth * tangent * aspect), dot(offset, upwards) / (depth * tangent)];
  }

  /** As camera-orbit would have it. */
  toString() {
    return `${this.theta}rad ${this.phi}rad ${this.distance}m`;
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
