// Where a camera is, and what follows from that. Angles in radians, lengths in the model's unit (metres in glTF); azimuth
// theta is 0 towards +Z and grows towards +X, phi is the angle from +Y.

/** Of a class with theta, phi, distance, target (x, y, z) and fieldOfView (vertical, degrees). */
export class View {
  get eye() {
    const { theta, phi, distance, target } = this;
    const direction = [Math.sin(phi) * Math.sin(theta), Math.cos(phi), Math.sin(phi) * Math.cos(theta)];
    return target.map((value, i) => value + distance * direction[i]);
  }

  /** Unit vectors of the picture's right and up. */
  axes() {
    const { theta, phi } = this;
    const across = [Math.cos(theta), 0, -Math.sin(theta)];
    const upwards = [-Math.cos(phi) * Math.sin(theta), Math.sin(phi), -Math.cos(phi) * Math.cos(theta)];
    return { across, upwards };
  }

  /** Where a world point is seen: x and y from -1 to 1 within the picture, right and up. */
  project(point, aspect) {
    const { eye, target, distance } = this;
    const { across, upwards } = this.axes();
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
}
