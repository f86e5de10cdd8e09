// The page of glass.mjs: every contestant has a canvas and a context of its own, outside the document so that nothing
// is composited. The peers are drei's and three.js's own components, driven by React Three Fiber one frame at a time;
// Vitrine is driven by the calls that <vitrine-viewer> makes.
import { MeshRefractionMaterial } from '@react-three/drei/core/MeshRefractionMaterial.js';
import { MeshTransmissionMaterial } from '@react-three/drei/core/MeshTransmissionMaterial.js';
import { createRoot, extend } from '@react-three/fiber';
import { createElement, useLayoutEffect } from 'react';
import * as THREE from 'three';
import { HDRLoader } from 'three/examples/jsm/loaders/HDRLoader.js';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { mergeGeometries, mergeVertices } from 'three/examples/jsm/utils/BufferGeometryUtils.js';
import { Viewer, loadCore } from 'vitrine-core'; // build/web/element/core.js

extend(THREE);

// three 0.187 has no such chunk any more; drei 10.7.9's MeshRefractionMaterial includes it and uses nothing of it.
THREE.ShaderChunk.cube_uv_reflection_fragment ??= '';

const smooth = { chromaticAberration: 0, anisotropicBlur: 0 }; // the scene has neither dispersion nor roughness

/** Each gets { ior, thickness, reflects, environment } and returns its material. */
const peers = {
  physical: ({ ior, thickness, reflects }) =>
    createElement('meshPhysicalMaterial', { transmission: 1, roughness: 0, ior, thickness, specularIntensity: Number(reflects) }),
  'physical-double': ({ ior, thickness, reflects }) =>
    createElement('meshPhysicalMaterial', { transmission: 1, roughness: 0, ior, thickness, specularIntensity: Number(reflects), side: THREE.DoubleSide }),
  transmission: ({ ior, thickness, reflects }) =>
    createElement(MeshTransmissionMaterial, { ...smooth, ior, thickness, specularIntensity: Number(reflects) }),
  'transmission-default': ({ ior, thickness, reflects }) =>
    createElement(MeshTransmissionMaterial, { ior, thickness, specularIntensity: Number(reflects) }),
  'transmission-backside': ({ ior, thickness, reflects }) =>
    createElement(MeshTransmissionMaterial, { ...smooth, ior, thickness, backside: true, backsideThickness: thickness, specularIntensity: Number(reflects) }),
  refraction: ({ ior, environment }) => createElement(MeshRefractionMaterial, { ior, bounces: 4, envMap: environment }),
};

const fetchBytes = async (url) => new Uint8Array(await (await fetch(url)).arrayBuffer());

function base64(array) {
  const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
  let text = '';
  for (let i = 0; i < bytes.length; i += 0x8000) text += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
  return btoa(text);
}

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

/** An environment whose colour says its direction: 0.5 + 0.5 d, half floats, bottom row first. */
function directionTexture() {
  const width = 2048, height = 1024;
  const data = new Uint16Array(4 * width * height);
  for (let j = 0; j < height; ++j) {
    const elevation = ((j + 0.5) / height - 0.5) * Math.PI;
    for (let i = 0; i < width; ++i) {
      const azimuth = ((i + 0.5) / width - 0.5) * 2 * Math.PI;
      const direction = [Math.cos(elevation) * Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation) * Math.sin(azimuth)];
      direction.forEach((value, k) => (data[4 * (j * width + i) + k] = THREE.DataUtils.toHalfFloat(0.5 + 0.5 * value)));
      data[4 * (j * width + i) + 3] = THREE.DataUtils.toHalfFloat(1);
    }
  }
  const texture = new THREE.DataTexture(data, width, height, THREE.RGBAFormat, THREE.HalfFloatType);
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.wrapS = THREE.RepeatWrapping;
  texture.mapping = THREE.EquirectangularReflectionMapping;
  texture.needsUpdate = true;
  return texture;
}

function Scene({ geometry, name, ready, settings }) {
  useLayoutEffect(ready);
  return createElement('mesh', { geometry }, peers[name](settings));
}

class Peer {
  #root;
  #store;
  #time = 0;
  #environments;

  constructor(name, shared) {
    this.name = name;
    this.shared = shared;
    this.canvas = document.createElement('canvas');
  }

  async open() {
    const { size, camera } = this.shared;
    const distance = Math.hypot(...camera.eye.map((value, k) => value - camera.target[k]));
    this.#root = createRoot(this.canvas);
    await this.#root.configure({
      frameloop: 'never', flat: true, dpr: 1, // flat: no tone mapping
      size: { width: size, height: size, top: 0, left: 0 },
      gl: { antialias: false, powerPreference: 'high-performance' }, // nobody here has antialiasing
      camera: { position: camera.eye, fov: camera.fov, near: 0.01 * distance, far: 10 * distance },
      onCreated: ({ camera: made }) => made.lookAt(...camera.target),
    });
    this.#environments = { picture: this.shared.environment.clone(), directions: this.shared.directions.clone() };
    for (const texture of Object.values(this.#environments)) texture.needsUpdate = true;
    this.geometry = this.shared.geometry.clone();
    await this.show({ thickness: 0, reflects: true, what: 'picture' });
  }

  get gl() {
    return this.#store.getState().gl.getContext();
  }

  /** what: 'picture' or 'directions'. reflects: with Fresnel's reflection of the environment, the material's default. */
  async show({ thickness, reflects, what }) {
    const environment = this.#environments[what];
    const { geometry, name, shared: { ior } } = this;
    await new Promise((ready) => {
      this.#store = this.#root.render(createElement(Scene, { geometry, name, ready, settings: { ior, thickness, reflects, environment } }));
    });
    const { scene } = this.#store.getState();
    scene.background = environment;
    scene.environment = reflects ? environment : null;
    this.draw();
    this.draw();
  }

  draw() {
    this.#time += 1 / 60;
    this.#store.getState().advance(this.#time);
  }

  /** What the last show has set up, as it is before the canvas makes bytes of it: RGBA floats, bottom row first. */
  read() {
    const { size } = this.shared;
    const { gl: renderer, scene, camera } = this.#store.getState();
    const target = new THREE.WebGLRenderTarget(size, size, { type: THREE.FloatType, colorSpace: THREE.LinearSRGBColorSpace });
    this.draw();
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    const pixels = new Float32Array(4 * size * size);
    renderer.readRenderTargetPixels(target, 0, 0, size, size, pixels);
    renderer.setRenderTarget(null);
    target.dispose();
    return base64(pixels);
  }
}

class VitrineContestant {
  constructor(technique, shared) {
    this.name = technique;
    this.shared = shared;
    this.canvas = document.createElement('canvas');
  }

  async open() {
    const { size, ior, files, core } = this.shared;
    this.canvas.width = this.canvas.height = size;
    this.viewer = new Viewer(core, this.canvas, () => false);
    this.#must(this.viewer.attemptFile('OpenModel', { name: 'model.glb', contents: files.model }));
    this.#must(this.viewer.setGlass({ technique: this.name, ior, preset: 'medium', output: 'picture', layer: 0, exposure: 0, transparent: false, samples: 1, lessened: false }));
    this.#must(this.viewer.attempt('Resize', size, size));
    await this.show({ what: 'picture' });
  }

  get gl() {
    return this.viewer.gl;
  }

  async show({ what }) {
    const { files } = this.shared;
    const contents = what === 'picture' ? files.environment : files.directions;
    this.#must(this.viewer.attemptFile('OpenEnvironment', { name: 'environment.hdr', contents }));
    this.draw();
  }

  draw() {
    const { eye, target, fov } = this.shared.camera;
    this.#must(this.viewer.attempt('SetView', ...eye, ...target, fov)); // as after a motion: everything anew
    if (this.viewer.call('Tick') < 0) throw new Error(this.viewer.problem());
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

window.bench = {
  /** Loads what all share. @returns what the report says about it */
  async open() {
    const [mesh, environment, model, hdr, directions, core] = await Promise.all([
      loadGeometry('/model.glb'), new HDRLoader().loadAsync('/environment.hdr'), fetchBytes('/model.glb'),
      fetchBytes('/environment.hdr'), fetchBytes('/directions.hdr'), loadCore({ locateFile: (name) => `/${name}` }),
    ]);
    environment.mapping = THREE.EquirectangularReflectionMapping;
    shared = { core, environment, directions: directionTexture(), geometry: mesh.geometry,
      files: { model, environment: hdr, directions } };
    const gl = document.createElement('canvas').getContext('webgl2');
    const { triangles, hasNormals, meanChord } = mesh;
    mesh.geometry.computeBoundingBox();
    const { boundingBox } = mesh.geometry;
    const extents = boundingBox.getSize(new THREE.Vector3()).toArray();
    return { triangles, hasNormals, meanChord, centre: boundingBox.getCenter(new THREE.Vector3()).toArray(), halfExtent: Math.max(...extents) / 2, three: THREE.REVISION,
      renderer: gl.getParameter(gl.getExtension('WEBGL_debug_renderer_info').UNMASKED_RENDERER_WEBGL) };
  },

  place(view) {
    Object.assign(shared, view);
  },

  /** @returns {Promise<string>} why it cannot take part, or '' */
  async add(kind, name) {
    try {
      const contestant = kind === 'empty' ? new Empty(shared) : kind === 'peer' ? new Peer(name, shared) : new VitrineContestant(name, shared);
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
