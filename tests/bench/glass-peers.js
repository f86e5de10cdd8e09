// The peers of glass-page.js: drei's and three.js's own components, driven by React Three Fiber one frame at a time.
import { Caustics } from '@react-three/drei/core/Caustics.js';
import { MeshRefractionMaterial } from '@react-three/drei/core/MeshRefractionMaterial.js';
import { MeshTransmissionMaterial } from '@react-three/drei/core/MeshTransmissionMaterial.js';
import { createRoot, extend } from '@react-three/fiber';
import { createElement, useLayoutEffect } from 'react';
import * as THREE from 'three';

extend(THREE);

// three 0.187 has no such chunk any more; drei 10.7.9's MeshRefractionMaterial includes it and uses nothing of it.
THREE.ShaderChunk.cube_uv_reflection_fragment ??= '';

const smooth = { chromaticAberration: 0, anisotropicBlur: 0 }; // the scene has neither dispersion nor roughness

/** Its index grows by this share from red to blue: what Cauchy's formula gives for what red and blue see on average. */
const aberration = ({ ior, dispersion }) => ((ior - 1) * dispersion * 1.41) / (20 * ior);

/** Each gets { ior, thickness, reflects, environment, roughness, dispersion } and returns its material. */
const peers = {
  physical: ({ ior, thickness, reflects, roughness, dispersion }) =>
    createElement('meshPhysicalMaterial', { transmission: 1, roughness, dispersion, ior, thickness, specularIntensity: Number(reflects) }),
  'physical-double': ({ ior, thickness, reflects }) =>
    createElement('meshPhysicalMaterial', { transmission: 1, roughness: 0, ior, thickness, specularIntensity: Number(reflects), side: THREE.DoubleSide }),
  transmission: ({ ior, thickness, reflects, roughness, dispersion }) =>
    createElement(MeshTransmissionMaterial, { ...smooth, roughness, chromaticAberration: aberration({ ior, dispersion }), ior, thickness, specularIntensity: Number(reflects) }),
  'transmission-default': ({ ior, thickness, reflects }) =>
    createElement(MeshTransmissionMaterial, { ior, thickness, specularIntensity: Number(reflects) }),
  'transmission-backside': ({ ior, thickness, reflects }) =>
    createElement(MeshTransmissionMaterial, { ...smooth, ior, thickness, backside: true, backsideThickness: thickness, specularIntensity: Number(reflects) }),
  refraction: ({ ior, environment }) => createElement(MeshRefractionMaterial, { ior, bounces: 4, envMap: environment }),
};

function base64(array) {
  const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
  let text = '';
  for (let i = 0; i < bytes.length; i += 0x8000) text += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
  return btoa(text);
}

/** An environment whose colour says its direction: 0.5 + 0.5 d, half floats, bottom row first. */
export function directionTexture() {
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

/** A matt ground below, lit by the sun with a shadow map, and drei's caustics on it; all as large as their map of ours. */
function Ground({ ground: { low, color, sun, light }, ior, intensity, children }) {
  const far = 20, position = sun.map((value) => (value * far) / Math.hypot(...sun));
  const shadow = { left: -3, right: 3, top: 3, bottom: -3, near: 1, far: 2 * far };
  const lamp = createElement('directionalLight', { key: 'sun', position, color: new THREE.Color(...light), intensity: 1, castShadow: true, 'shadow-mapSize': [1024, 1024], ...Object.fromEntries(Object.entries(shadow).map(([side, at]) => [`shadow-camera-${side}`, at])) });
  const plane = createElement('mesh', { key: 'plane', position: [0, low, 0], rotation: [-Math.PI / 2, 0, 0], receiveShadow: true },
    createElement('planeGeometry', { args: [200, 200] }), createElement('meshPhysicalMaterial', { color: new THREE.Color(...color), roughness: 1, specularIntensity: 0 }));
  const caustics = createElement(Caustics, { key: 'caustics', position: [0, low + 0.001, 0], lightSource: sun, ior, intensity, worldRadius: 0.01, resolution: 1024, frames: Infinity, color: new THREE.Color(...color.map((value, k) => (value * light[k]) / 3)) },
    createElement('group', { position: [0, -low, 0] }, children));
  return [lamp, plane, caustics];
}

function Scene({ geometry, name, ready, settings }) {
  useLayoutEffect(ready);
  const glass = createElement('mesh', { geometry, castShadow: true }, peers[name](settings));
  return settings.ground ? createElement(Ground, settings, glass) : glass;
}

export class Peer {
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
      frameloop: 'never', flat: true, dpr: 1, shadows: true, // flat: no tone mapping
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
  async show({ thickness, reflects, what, intensity }) {
    const environment = this.#environments[what];
    const { geometry, name, shared: { ior, roughness = 0, dispersion = 0, stage } } = this;
    await new Promise((ready) => {
      this.#store = this.#root.render(createElement(Scene, { geometry, name, ready, settings: { ior, roughness, dispersion, thickness, reflects, environment, ground: stage, intensity } }));
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
