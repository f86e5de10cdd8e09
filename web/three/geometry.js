// Geometry of three.js's as the core has it: given once, refitted where vertices move, and forgotten when disposed.
import { numbersOf } from './numbers.js';
import { hasPoseChanged, poseKey, poseOf } from './pose.js';

const kept = 300; // frames that the pose of a mesh outlives its last drawing

const versionOf = (attribute) => (attribute ? `${attribute.id ?? attribute.data?.uuid}:${attribute.version ?? attribute.data.version}:${attribute.count}` : '');
const identityOf = (attribute) => (attribute ? `${attribute.count}` : '');

/** What makes a new hierarchy necessary, and what only moves vertices. */
function versionsOf({ index, attributes: { position, normal, uv, uv1, color } }, { start, count }) {
  return {
    topology: [versionOf(index), identityOf(position), identityOf(normal), versionOf(uv), versionOf(uv1), versionOf(color), start, count].join(),
    shape: `${versionOf(position)},${versionOf(normal)}`,
  };
}

/** Indices of a range of the geometry; null: all vertices as they come. */
function indicesOf({ index, attributes: { position } }, { start, count }) {
  const all = index?.count ?? position.count;
  const end = Math.min(all, start + count);
  if (!index && start === 0 && end === all) return null;
  const first = Math.min(start, end), indices = new Uint32Array(end - first - ((end - first) % 3));
  for (let i = 0; i < indices.length; ++i) indices[i] = index ? index.getX(first + i) : first + i;
  return indices;
}

/** Each triangle with corners of its own. */
function part(numbers, size, indices) {
  if (!numbers) return null;
  const parted = new Float32Array(size * indices.length);
  for (let i = 0; i < indices.length; ++i) parted.set(numbers.subarray(size * indices[i], size * indices[i] + size), size * i);
  return parted;
}

function flatNormals(positions) {
  const normals = new Float32Array(positions.length);
  for (let i = 0; i < positions.length; i += 9) {
    const [ax, ay, az, bx, by, bz] = [0, 1, 2, 3, 4, 5].map((k) => positions[i + 3 + k] - positions[i + (k % 3)]);
    const normal = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
    for (let corner = 0; corner < 9; corner += 3) normals.set(normal, i + corner);
  }
  return normals;
}

/** What the core takes, of a mesh in its pose. */
function shapeOf({ mesh, range, flat }) {
  const { geometry } = mesh;
  const { position, normal } = geometry.attributes;
  let { positions, normals } = poseOf(mesh) ?? { positions: numbersOf(position, 3), normals: numbersOf(normal, 3) };
  let indices = indicesOf(geometry, range);
  if (flat) {
    indices ??= Uint32Array.from({ length: position.count - (position.count % 3) }, (_, i) => i);
    positions = part(positions, 3, indices);
    normals = flatNormals(positions);
    return { positions, normals, indices: null, order: indices };
  }
  return { positions, normals, indices, order: null };
}

/** Geometry in one core. */
export class Geometries {
  #core;
  #ofGeometry = new Map(); // BufferGeometry -> Map of a key -> entry
  #frame = 0;

  constructor(core) {
    this.#core = core;
  }

  #add(entry) {
    const { geometry } = entry.mesh;
    const { uv, uv1, color, position } = geometry.attributes;
    const { positions, normals, indices, order } = shapeOf(entry);
    const more = (attribute, size) => (order ? part(numbersOf(attribute, size), size, order) : numbersOf(attribute, size));
    const place = (numbers) => this.#core.place(numbers);
    const vertexCount = order ? order.length : position.count;
    const indexCount = indices ? indices.length : vertexCount - (vertexCount % 3);
    entry.number = this.#core.call('AddGeometry', entry.name, vertexCount, indexCount, place(positions), place(normals),
      place(more(uv, 2)), place(more(uv1, 2)), place(more(color, 3)), place(indices));
    entry.isReady = false;
    entry.problem = entry.number === 0 ? this.#core.problem() : '';
  }

  #move(entry) {
    const { positions, normals } = shapeOf(entry);
    this.#core.attempt('UpdateGeometry', entry.number, this.#core.place(positions), this.#core.place(normals));
  }

  #remove(entry) {
    if (entry.number !== 0) this.#core.call('RemoveGeometry', entry.number);
  }

  #entriesOf(geometry) {
    let entries = this.#ofGeometry.get(geometry);
    if (!entries) {
      entries = new Map();
      this.#ofGeometry.set(geometry, entries);
      const forget = () => {
        geometry.removeEventListener('dispose', forget);
        this.#ofGeometry.delete(geometry);
        for (const entry of entries.values()) this.#remove(entry);
      };
      geometry.addEventListener('dispose', forget);
      entries.forget = forget;
    }
    return entries;
  }

  /**
   * A mesh's geometry in its present pose, as far as it is there.
   * @param {import('three').Mesh} mesh @param {{start: number, count: number}} range of its indices or vertices @param {boolean} flat each triangle has its own normal
   * @param {number} until performance.now() at which building it is to be left for the next frame
   * @returns {{number: number, isReady: boolean, problem: string}}
   */
  use(mesh, range, flat, until) {
    const { geometry } = mesh;
    const entries = this.#entriesOf(geometry);
    const isPosed = mesh.isSkinnedMesh || (mesh.morphTargetInfluences?.length > 0 && geometry.morphAttributes.position);
    const key = `${range.start} ${range.count} ${flat} ${isPosed ? mesh.uuid : ''}`;
    let entry = entries.get(key);
    const { topology, shape } = versionsOf(geometry, range);
    if (entry?.topology !== topology) {
      if (entry) this.#remove(entry);
      entry = { mesh, range, flat, topology, shape, pose: isPosed ? poseKey(mesh) : null, isPosed, name: mesh.name || geometry.name || 'a mesh without a name', number: 0 };
      entries.set(key, entry);
      this.#add(entry);
    }
    entry.mesh = mesh;
    entry.frame = this.#frame;
    this.#build(entry, until);
    if (entry.isReady && !entry.problem) {
      const isMoved = entry.shape !== shape || (isPosed && hasPoseChanged(mesh, entry.pose));
      if (isMoved) {
        entry.shape = shape;
        this.#move(entry);
      }
    }
    return entry;
  }

  #build(entry, until) {
    while (!entry.isReady && !entry.problem && performance.now() < until) {
      const answer = this.#core.call('Build', entry.number, 20000); // a few milliseconds
      entry.isReady = answer === 1;
      entry.problem = answer < 0 ? this.#core.problem() : '';
    }
  }

  /** Forgets poses of meshes that are gone. */
  sweep() {
    if (++this.#frame % kept !== 0) return;
    for (const entries of this.#ofGeometry.values()) {
      for (const [key, entry] of entries) {
        if (!entry.isPosed || this.#frame - entry.frame < kept) continue;
        this.#remove(entry);
        entries.delete(key);
      }
    }
  }

  /** What is held. */
  get count() {
    let sum = 0;
    for (const entries of this.#ofGeometry.values()) sum += entries.size;
    return sum;
  }

  /** Forgets all; the core may be gone already. @param {boolean} isLost */
  dispose(isLost) {
    for (const [geometry, { forget }] of [...this.#ofGeometry]) {
      if (isLost) geometry.removeEventListener('dispose', forget);
      else forget();
    }
    this.#ofGeometry.clear();
  }
}
