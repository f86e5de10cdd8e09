// The page of glass.mjs: every contestant has a canvas and a context of its own, outside the document so that nothing
// is composited. The peers are in glass-peers.js, which is loaded where one takes part; Vitrine is driven by the calls
// that <vitrine-viewer> makes.
import * as THREE from 'three';
import { HDRLoader } from 'three/examples/jsm/loaders/HDRLoader.js';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { mergeGeometries, mergeVertices } from 'three/examples/jsm/utils/BufferGeometryUtils.js';
import { Viewer, loadCore } from 'vitrine-core'; // build/web/element/core.js

const fetchBytes = async (url) => new Uint8Array(await (await fetch(url)).arrayBuffer());

/** Blocks until the GPU has drawn the frame: the answer of readPixels needs it. (gl.finish only flushes in Chromium.) */
function finish(gl) {
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  const pixel = new Uint8Array(4);
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  return pixel;
}

/** Means of the normals of the triangles at a vertex, weighted by their angles there: as Vitrine computes them. */
function smoothNormals(geometry) {
  const { index } = geometry, positions = geometry.getAttribute('position');
  const normals = Array.from({ length: positions.count }, () => new THREE.Vector3());
  const corners = [0, 1, 2].map(() => new THREE.Vector3());
  for (let i = 0; i < index.count; i += 3) {
    const vertices = [0, 1, 2].map((k) => index.getX(i + k));
    vertices.forEach((vertex, k) => corners[k].fromBufferAttribute(positions, vertex));
    const [a, b, c] = corners;
    const normal = b.clone().sub(a).cross(c.clone().sub(a)).normalize();
    vertices.forEach((vertex, k) => {
      const there = corners[(k + 1) % 3].clone().sub(corners[k]), back = corners[(k + 2) % 3].clone().sub(corners[k]);
      normals[vertex].addScaledVector(normal, there.angleTo(back) || 0);
    });
  }
  const flat = normals.flatMap((normal) => normal.normalize().toArray());
  geometry.setAttribute('normal', new THREE.Float32BufferAttribute(flat, 3));
}

/** All triangles of the file's scene as one geometry, and 4 V / S: the mean chord of a convex body (Cauchy). */
async function loadGeometry(url) {
  const { scene } = await new GLTFLoader().loadAsync(url);
  scene.updateMatrixWorld(true);
  const parts = [];
  scene.traverse((node) => {
    if (!node.isMesh) return;
    const part = node.geometry.clone().applyMatrix4(node.matrixWorld);
    for (const name of Object.keys(part.attributes)) if (!['position', 'normal'].includes(name)) part.deleteAttribute(name);
    parts.push(part);
  });
  const hasNormals = parts.every((part) => part.hasAttribute('normal'));
  if (!hasNormals) parts.forEach((part) => part.deleteAttribute('normal'));
  const isIndexed = parts.every((part) => part.index !== null);
  const merged = mergeGeometries(isIndexed ? parts : parts.map((part) => part.toNonIndexed()));
  const geometry = hasNormals && merged.index !== null ? merged : mergeVertices(merged, 0);
  if (!hasNormals) smoothNormals(geometry);

  const { index } = geometry, positions = geometry.getAttribute('position');
  const [a, b, c] = [0, 1, 2].map(() => new THREE.Vector3());
  let volume = 0, area = 0;
  for (let i = 0; i < index.count; i += 3) {
    [a, b, c].forEach((corner, k) => corner.fromBufferAttribute(positions, index.getX(i + k)));
    volume += a.dot(b.clone().cross(c)) / 6;
    area += b.clone().sub(a).cross(c.clone().sub(a)).length() / 2;
  }
  return { geometry, triangles: index.count / 3, hasNormals, meanChord: (4 * Math.abs(volume)) / area };
}

/** A technique as by default, or, named with -plain, never reflecting. */
class VitrineContestant {
  constructor(name, shared) {
    this.name = name;
    this.technique = name.replace(/-plain$/, '');
    this.canReflect = this.technique === name;
    this.shared = shared;
    this.canvas = document.createElement('canvas');
  }

  samples = 1;

  async open() {
    const { size, files, core } = this.shared;
    this.canvas.width = this.canvas.height = size;
    this.viewer = new Viewer(core, { lost() {}, restored() {}, crowded: () => false });
    this.#must(this.viewer.attemptFile('OpenModel', { name: 'model.glb', contents: files.model }));
    this.#setGlass(true);
    this.#must(this.viewer.attempt('Resize', size, size));
    await this.show({ reflects: true, what: 'picture' });
  }

  get gl() {
    return this.viewer.gl;
  }

  #setGlass(reflects) {
    const { technique, canReflect, shared: { ior, roughness = -1, dispersion = -1, ground } } = this;
    const fresnel = reflects && canReflect ? 'on' : 'off'; // off: strict paths, whose directions can be compared
    this.#must(this.viewer.setGlass({ technique, ior, roughness, dispersion, ground, fresnel, preset: 'medium', output: 'picture', layer: 0, exposure: 0, 'tone-mapping': 'none', background: { kind: 0, color: [0, 0, 0] }, samples: this.samples, lessened: false }));
  }

  /** reflects: with Fresnel reflection, the default; what: 'picture' or 'directions'. */
  async show({ reflects, what, samples = 1 }) {
    const { files } = this.shared;
    this.samples = samples;
    this.#setGlass(reflects);
    const contents = what === 'picture' ? files.environment : files.directions;
    this.#must(this.viewer.attemptFile('OpenEnvironment', { name: 'environment.hdr', contents }));
    while (this.draw() === 2) { // its shaders are not loaded or not compiled yet
      if (this.viewer.lacksShaders) await this.viewer.loadShaders();
      else await new Promise((done) => setTimeout(done, 5));
    }
  }

  draw() {
    const { eye, target, fov } = this.shared.camera;
    this.#must(this.viewer.attempt('SetView', ...eye, ...target, fov)); // as after a motion: everything anew
    const drawn = this.viewer.draw(this.shared.size, this.shared.size);
    if (drawn < 0) throw new Error(this.viewer.problem());
    if (drawn === 1) this.viewer.showOn(this.canvas);
    return drawn;
  }

  /** Adds the samples that are missing. */
  async refine() {
    const { size } = this.shared;
    for (let drawn; (drawn = this.viewer.draw(size, size)) !== 0;) {
      if (drawn < 0) throw new Error(this.viewer.problem());
      if (drawn === 1) this.viewer.showOn(this.canvas);
      if (drawn === 2) await new Promise((done) => setTimeout(done, 5));
    }
  }

  #must(problem) {
    if (problem) throw new Error(problem);
  }
}

/** Nothing but a cleared canvas: what asking costs. */
class Empty {
  name = 'empty';

  constructor(shared) {
    this.canvas = Object.assign(document.createElement('canvas'), { width: shared.size, height: shared.size });
  }

  async open() {
    this.gl = this.canvas.getContext('webgl2', { antialias: false });
  }

  draw() {
    this.gl.clear(this.gl.COLOR_BUFFER_BIT);
  }
}

const contestants = new Map();
let shared;

async function makePeer(name) {
  const { Peer, directionTexture } = await import('./glass-peers.js');
  shared.directions ??= directionTexture();
  return new Peer(name, shared);
}

window.bench = {
  /** Loads what all share; hasGround: something is to stand on one. @returns what the report says about it */
  async open(hasGround = false) {
    const [mesh, environment, model, hdr, directions, core] = await Promise.all([
      loadGeometry('/model.glb'), new HDRLoader().loadAsync('/environment.hdr'), fetchBytes('/model.glb'),
      fetchBytes('/environment.hdr'), fetchBytes('/directions.hdr'), loadCore({ locateFile: (name) => `/${name}` }, hasGround),
    ]);
    environment.mapping = THREE.EquirectangularReflectionMapping;
    shared = { core, environment, geometry: mesh.geometry,
      files: { model, environment: hdr, directions } };
    const gl = document.createElement('canvas').getContext('webgl2');
    const { triangles, hasNormals, meanChord } = mesh;
    mesh.geometry.computeBoundingBox();
    const { boundingBox } = mesh.geometry;
    const extents = boundingBox.getSize(new THREE.Vector3()).toArray();
    return { triangles, hasNormals, meanChord, low: boundingBox.min.y, centre: boundingBox.getCenter(new THREE.Vector3()).toArray(), halfExtent: Math.max(...extents) / 2, three: THREE.REVISION,
      renderer: gl.getParameter(gl.getExtension('WEBGL_debug_renderer_info').UNMASKED_RENDERER_WEBGL) };
  },

  place(view) {
    Object.assign(shared, view);
  },

  /** @returns {Promise<string>} why it cannot take part, or '' */
  async add(kind, name) {
    try {
      const contestant = kind === 'empty' ? new Empty(shared) : kind === 'peer' ? await makePeer(name) : new VitrineContestant(name, shared);
      await contestant.open();
      contestants.set(`${kind}:${name}`, contestant);
      return '';
    } catch (reason) {
      return reason.message;
    }
  },

  /** The canvas as PNG, after show. */
  async picture(key, settings) {
    const contestant = contestants.get(key);
    await contestant.show(settings);
    contestant.draw();
    await contestant.refine?.();
    return contestant.canvas.toDataURL('image/png').split(',')[1];
  },

  async floats(key, settings) {
    const contestant = contestants.get(key);
    await contestant.show(settings);
    return contestant.read();
  },

  show: (key, settings) => contestants.get(key).show(settings),

  /** Milliseconds of one frame. */
  time(key) {
    const contestant = contestants.get(key);
    finish(contestant.gl);
    const start = performance.now();
    contestant.draw();
    finish(contestant.gl);
    return performance.now() - start;
  },
};
