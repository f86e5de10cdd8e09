// Bodies of triangles, closed and smooth: turned on a lathe, rods along curves, rings.

export const add = (a, b) => a.map((value, i) => value + b[i]);
export const scale = (a, factor) => a.map((value) => value * factor);
const subtract = (a, b) => a.map((value, i) => value - b[i]);
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const unit = (a) => scale(a, 1 / Math.hypot(...a));

export class Body {
  positions = [];
  indices = [];
  #vertices = new Map();

  /** Vertices at one place are one, so poles and seams close. */
  #vertex(point) {
    const key = point.map((value) => Math.round(value * 1e5)).join();
    if (!this.#vertices.has(key)) {
      this.#vertices.set(key, this.positions.length / 3);
      this.positions.push(...point);
    }
    return this.#vertices.get(key);
  }

  /** A surface of so many cells. `place(row, column)`: of a corner; the last row and column are there, too. */
  grid(rows, columns, place) {
    for (let row = 0; row < rows; ++row) {
      for (let column = 0; column < columns; ++column) {
        const [a, b, c, d] = [[0, 0], [1, 0], [1, 1], [0, 1]].map(([down, right]) => this.#vertex(place(row + down, column + right)));
        for (const triangle of [[a, b, c], [a, c, d]]) {
          if (new Set(triangle).size === 3) this.indices.push(...triangle);
        }
      }
    }
    return this;
  }

  /** Of the vertices: of the triangles around each, by their areas. */
  get normals() {
    const corner = (list, vertex) => list.slice(3 * vertex, 3 * vertex + 3);
    const sums = this.positions.map(() => 0);
    for (let i = 0; i < this.indices.length; i += 3) {
      const triangle = this.indices.slice(i, i + 3), [a, b, c] = triangle.map((vertex) => corner(this.positions, vertex));
      const normal = cross(subtract(b, a), subtract(c, a));
      for (const vertex of triangle) normal.forEach((value, axis) => (sums[3 * vertex + axis] += value));
    }
    return Array.from({ length: sums.length / 3 }, (_, vertex) => unit(corner(sums, vertex))).flat();
  }
}

/** A point of the uniform cubic B-spline (de Boor 1978) over control points; `mirror` continues it past its ends. */
function spline(points, parameter, mirror = (beyond, end) => end.map((value, i) => 2 * value - beyond[i])) {
  const last = points.length - 1, span = Math.min(Math.floor(parameter), last - 1), t = parameter - span, s = 1 - t;
  const control = (i) => (i < 0 ? mirror(points[1], points[0]) : i > last ? mirror(points[last - 1], points[last]) : points[i]);
  const weights = [s ** 3 / 6, (4 - 6 * t * t + 3 * t ** 3) / 6, (4 - 6 * s * s + 3 * s ** 3) / 6, t ** 3 / 6];
  return weights.map((weight, i) => scale(control(span - 1 + i), weight)).reduce(add);
}

/**
 * Turned about +Y. Control points of the profile, from the axis below to the axis above: radius, height, and how square
 * the section is there, from 0, a circle, to 1, a superellipse of exponent 7.
 */
export function lathe(points, columns = 128, steps = 5) {
  const overAxis = ([radius, height, square]) => [-radius, height, square];
  const rings = Array.from({ length: steps * (points.length - 1) + 1 }, (_, i) => spline(points.map(([r, y, q = 0]) => [r, y, q]), i / steps, overAxis));
  return new Body().grid(rings.length - 1, columns, (row, column) => {
    const [radius, height, square] = rings[row], angle = (2 * Math.PI * (column % columns)) / columns;
    const [x, z] = [Math.cos(angle), Math.sin(angle)];
    const wide = radius * (1 - square + square / (Math.abs(x) ** 7 + Math.abs(z) ** 7) ** (1 / 7));
    return [wide * x, height, wide * z];
  });
}

/** A round rod along a spline whose control points are x, y, z, radius; its ends are half balls. */
export function rod(body, points, around = 20, steps = 10) {
  const centres = Array.from({ length: steps * (points.length - 1) + 1 }, (_, i) => spline(points, i / steps));
  const along = (i) => unit(subtract(centres[Math.min(i + 1, centres.length - 1)], centres[Math.max(i - 1, 0)]).slice(0, 3));
  const ball = 6, rows = centres.length + 2 * ball;
  body.grid(rows - 1, around, (row, column) => {
    const i = Math.max(0, Math.min(centres.length - 1, row - ball)), [x, y, z, radius] = centres[i];
    const beyond = row < ball ? row - ball : Math.max(0, row - ball - centres.length + 1);
    const tilt = (Math.PI / 2) * (beyond / ball), turn = (2 * Math.PI * (column % around)) / around;
    const forward = along(i), right = unit(cross(forward, Math.abs(forward[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0])), up = cross(right, forward);
    const out = add(scale(right, Math.cos(turn)), scale(up, Math.sin(turn)));
    return add([x, y, z], add(scale(out, radius * Math.cos(tilt)), scale(forward, radius * Math.sin(tilt))));
  });
}

/** A ring of elliptic section. `place(angle, out, aside)`: of a point so far outside and beside of its middle line. */
export function hoop(body, thick, wide, place, around = 160, section = 32) {
  body.grid(around, section, (row, column) => {
    const angle = (2 * Math.PI * (row % around)) / around, turn = (2 * Math.PI * (column % section)) / section;
    return place(angle, thick * Math.cos(turn), wide * Math.sin(turn));
  });
}
