// The scene of three.test.mjs, by three.js of whatever version the page's import map names.
import * as THREE from 'three';
import { RoomEnvironment } from 'three/addons/environments/RoomEnvironment.js';
import { EffectComposer } from 'three/addons/postprocessing/EffectComposer.js';
import { OutputPass } from 'three/addons/postprocessing/OutputPass.js';
import { Pass } from 'three/addons/postprocessing/Pass.js';
import { createGlass } from '/site/three/index.js';

const opaque = (color) => new THREE.MeshStandardMaterial({ color, roughness: 0.6 });

/** A floor of squares, a box and a ball behind, a post before the glass, a ring through it, shadows; no glass yet. */
function makeScene() {
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0x203040);
  const squares = new Uint8Array(8 * 8 * 4).map((_, i) => (i % 4 === 3 ? 255 : (i >> 2) + (i >> 5) & 1 ? 220 : 90));
  const map = new THREE.DataTexture(squares, 8, 8);
  map.colorSpace = THREE.SRGBColorSpace;
  map.needsUpdate = true;
  const add = (geometry, material, x, y, z) => {
    const mesh = new THREE.Mesh(geometry, material);
    mesh.position.set(x, y, z);
    mesh.castShadow = mesh.receiveShadow = true;
    scene.add(mesh);
    return mesh;
  };
  const floor = add(new THREE.PlaneGeometry(14, 14), new THREE.MeshStandardMaterial({ map }), 0, -1.15, 0);
  floor.rotation.x = -Math.PI / 2;
  add(new THREE.BoxGeometry(0.7, 0.7, 0.7), opaque(0xd03030), -1.2, -0.75, -1.2);
  add(new THREE.SphereGeometry(0.5, 32, 16), opaque(0x30a040), 0.9, -0.6, -1.6);
  const post = add(new THREE.CylinderGeometry(0.09, 0.09, 2.4, 24), opaque(0xf0c020), 0.55, 0.05, 1.1);
  const ring = add(new THREE.TorusGeometry(0.9, 0.07, 16, 64), opaque(0x3060ff), 0, 0, 0);
  ring.rotation.y = Math.PI / 2;
  const sun = new THREE.DirectionalLight(0xffffff, 2.5);
  sun.position.set(2, 3, 2);
  sun.castShadow = true;
  scene.add(new THREE.HemisphereLight(0xffffff, 0x666655, 1), sun);
  return { scene, add, post, ring, sun };
}

function makeRenderer({ side = 192, ...parameters } = {}) {
  const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true, ...parameters });
  renderer.setSize(side, side, false);
  renderer.shadowMap.enabled = true;
  document.body.append(renderer.domElement);
  return renderer;
}

const glassMaterial = (more) => new THREE.MeshPhysicalMaterial({ transmission: 1, thickness: 1, roughness: 0, ...more });

/** RGBA of the canvas, the lowest row first. */
function pixelsOf(renderer) {
  const gl = renderer.getContext(), { width, height } = renderer.domElement;
  const pixels = new Uint8Array(4 * width * height);
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  renderer.resetState();
  return pixels;
}

function makeCamera() {
  const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 60);
  camera.position.set(1.6, 1.1, 4.6);
  camera.lookAt(0, 0, 0);
  return camera;
}

/** Surroundings whose colour is 0.5 + 0.5 times their direction. */
function directionsTexture(width = 512, height = 256) {
  const numbers = new Float32Array(4 * width * height).fill(1);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const around = ((x + 0.5) / width - 0.5) * 2 * Math.PI, up = ((y + 0.5) / height - 0.5) * Math.PI;
      const direction = [Math.cos(up) * Math.cos(around), Math.sin(up), Math.cos(up) * Math.sin(around)];
      numbers.set(direction.map((part) => 0.5 + 0.5 * part), 4 * (y * width + x));
    }
  }
  const texture = new THREE.DataTexture(numbers, width, height, THREE.RGBAFormat, THREE.FloatType, THREE.EquirectangularReflectionMapping,
    THREE.RepeatWrapping, THREE.ClampToEdgeWrapping, THREE.LinearFilter, THREE.LinearFilter);
  texture.needsUpdate = true;
  return texture;
}

/** Unit direction after a surface of normal n against it; null: total internal reflection. */
function refract(direction, n, eta) {
  const c = -direction.dot(n), k = 1 - eta * eta * (1 - c * c);
  return k < 0 ? null : direction.clone().multiplyScalar(eta).addScaledVector(n, eta * c - Math.sqrt(k));
}

/** Where light that comes along `d` from `o` leaves the unit ball of index 1.5; null: near its rim, undefined: beside it. */
function throughBall(o, d) {
  const b = o.dot(d), q = b * b - o.dot(o) + 1;
  if (q < 0) return undefined;
  const into = o.clone().addScaledVector(d, -b - Math.sqrt(q)), inside = refract(d, into, 1 / 1.5);
  const out = into.clone().addScaledVector(inside, -2 * into.dot(inside));
  return q < 0.02 ? null : refract(inside, out.negate(), 1.5);
}

/** A knot without normals of its own before surroundings that tell directions: its triangles, and the direction at each pixel, lowest row first. */
async function traceKnot(side = 128) {
  const renderer = makeRenderer({ side }), scene = new THREE.Scene(), camera = makeCamera();
  scene.environment = scene.background = directionsTexture(2048, 1024);
  const geometry = new THREE.TorusKnotGeometry(0.9, 0.3, 160, 24).deleteAttribute('normal');
  scene.add(new THREE.Mesh(geometry, glassMaterial({ ior: 1.5 })));
  const glass = await createGlass(renderer, { fresnel: false });
  const target = new THREE.WebGLRenderTarget(side, side, { type: THREE.FloatType }), numbers = new Float32Array(4 * side * side);
  renderer.setRenderTarget(target);
  await glass.compileAsync(scene, camera);
  renderer.readRenderTargetPixels(target, 0, 0, side, side, numbers);
  glass.dispose();
  const { position } = geometry.attributes;
  return { positions: [...position.array], indices: [...geometry.index.array], seen: [...numbers].map((value) => 2 * value - 1), eye: camera.position.toArray() };
}

/** Cameras that look otherwise than straight and in perspective. */
const cameras = {
  straight: () => new THREE.PerspectiveCamera(40, 1, 0.1, 60),
  orthographic: () => new THREE.OrthographicCamera(-1.3, 1.3, 1.3, -1.3, 0.1, 60),
  'off its axis': () => {
    const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 60);
    camera.setViewOffset(300, 300, 110, 90, 128, 128);
    return camera;
  },
};

/** Directions in which light leaves a ball, beside the closed form; for each turn of the surroundings. */
async function measureBall(turns, seenBy = 'straight', side = 128) {
  const renderer = makeRenderer({ side }), scene = new THREE.Scene(), camera = cameras[seenBy]();
  camera.position.set(1, 0.5, 3.2);
  camera.lookAt(0, 0, 0);
  scene.environment = scene.background = directionsTexture();
  scene.add(new THREE.Mesh(new THREE.IcosahedronGeometry(1, 40), glassMaterial({ ior: 1.5 })));
  const glass = await createGlass(renderer, { fresnel: false });
  const target = new THREE.WebGLRenderTarget(side, side, { type: THREE.FloatType }), numbers = new Float32Array(4 * side * side);
  const answers = [];
  for (const turn of turns) {
    scene.environmentRotation.set(...turn);
    scene.backgroundRotation.set(...turn);
    // Three.js's matrix from the world to the surroundings, back.
    const angles = new THREE.Euler(...(Number.parseInt(THREE.REVISION, 10) >= 184 ? turn : turn.map((angle) => -angle)));
    const back = new THREE.Matrix4().makeRotationFromEuler(angles);
    if (Number.parseInt(THREE.REVISION, 10) < 184) back.transpose();
    renderer.setRenderTarget(target);
    await glass.compileAsync(scene, camera);
    renderer.readRenderTargetPixels(target, 0, 0, side, side, numbers);
    const answer = { pixels: 0, off: 0, besides: 0, besidesOff: 0, error: renderer.getContext().getError() };
    for (let i = 0; i < side * side; ++i) {
      const [near, far] = [-1, 0.5].map((z) => new THREE.Vector3(((i % side) + 0.5) / side * 2 - 1, (Math.floor(i / side) + 0.5) / side * 2 - 1, z).unproject(camera));
      const d = far.sub(near).normalize();
      const seen = new THREE.Vector3(...[0, 1, 2].map((part) => 2 * numbers[4 * i + part] - 1)).normalize().applyMatrix4(back);
      const out = throughBall(near, d);
      if (out === null) continue;
      const isOff = Number(!(seen.angleTo(out ?? d) < Math.PI / 180));
      answer[out ? 'pixels' : 'besides'] += 1;
      answer[out ? 'off' : 'besidesOff'] += isOff;
    }
    answers.push(answer);
  }
  renderer.setRenderTarget(null);
  glass.dispose();
  return answers;
}

/** A picture of two rows: RGB below, RGB above. */
function rowsTexture(below, above) {
  const texture = new THREE.DataTexture(Uint8Array.from([...below, 255, ...above, 255]), 1, 2);
  texture.needsUpdate = true;
  return texture;
}

/** What a pane with maps shows of a bright wall whose edge is behind its middle: the red and the steepest step in its lower and in its upper half. */
async function measureMaps(maps, more = {}) {
  const renderer = makeRenderer({ side: 96 }), scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(40, 1, 0.1, 60);
  camera.position.z = 4;
  scene.background = new THREE.Color(0x000000);
  const wall = new THREE.Mesh(new THREE.PlaneGeometry(4, 8), new THREE.MeshBasicMaterial({ color: 0xffffff }));
  wall.position.set(2, 0, -2);
  scene.add(wall, new THREE.Mesh(new THREE.BoxGeometry(2.4, 2.4, 0.1), glassMaterial({ ior: 1.3, ...maps, ...more })));
  const glass = await createGlass(renderer);
  await glass.compileAsync(scene, camera);
  const pixels = pixelsOf(renderer), { notes } = glass;
  const halves = [30, 66].map((y) => {
    const row = [...Array(96).keys()].map((x) => pixels[4 * (96 * y + x)]);
    return { bright: row[62], steepest: Math.max(...row.slice(31, 65).map((value, i) => Math.abs(value - row[i + 30]))), edge: row.findIndex((value) => value > 128) };
  });
  glass.dispose();
  renderer.dispose();
  return { halves, notes };
}

function makeSkinned(material) {
  const geometry = new THREE.CylinderGeometry(0.3, 0.3, 2, 16, 8), { position } = geometry.attributes;
  const indices = new Uint16Array(4 * position.count), weights = new Float32Array(4 * position.count);
  for (let i = 0; i < position.count; ++i) {
    const upper = Math.min(Math.max(position.getY(i) + 0.5, 0), 1);
    indices.set([0, 1, 0, 0], 4 * i);
    weights.set([1 - upper, upper, 0, 0], 4 * i);
  }
  geometry.setAttribute('skinIndex', new THREE.BufferAttribute(indices, 4));
  geometry.setAttribute('skinWeight', new THREE.BufferAttribute(weights, 4));
  const bones = [new THREE.Bone(), new THREE.Bone()], mesh = new THREE.SkinnedMesh(geometry, material);
  bones[0].add(bones[1]);
  mesh.add(bones[0]);
  mesh.bind(new THREE.Skeleton(bones));
  bones[1].rotation.z = 0.9;
  bones[0].position.x = 0.2;
  return mesh;
}

/** Meshes whose vertices are not where their geometry has them, of that material. */
const movingMeshes = {
  bones: makeSkinned,
  morphs: (material) => {
    const geometry = new THREE.SphereGeometry(0.5, 24, 12);
    geometry.morphAttributes.position = [new THREE.BufferAttribute(geometry.attributes.position.array.map((value, i) => (i % 3 === 0 ? 2 : 1) * value), 3)];
    const mesh = new THREE.Mesh(geometry, material);
    mesh.morphTargetInfluences[0] = 0.8;
    return mesh;
  },
  instances: (material) => {
    const mesh = new THREE.InstancedMesh(new THREE.SphereGeometry(0.3, 16, 8), material, 3);
    for (let i = 0; i < 3; ++i) mesh.setMatrixAt(i, new THREE.Matrix4().makeTranslation(0.7 * i - 0.7, 0.2 * i, 0));
    mesh.position.y = 0.3;
    return mesh;
  },
  groups: (material) => {
    const geometry = new THREE.BoxGeometry(1, 1, 1);
    const mesh = new THREE.Mesh(geometry, Array(6).fill(material));
    mesh.rotation.set(0.3, 0.4, 0);
    return mesh;
  },
  flat: (material) => {
    material.flatShading = true;
    return new THREE.Mesh(new THREE.TorusGeometry(0.7, 0.25, 8, 16), material);
  },
  mirrored: (material) => {
    const mesh = new THREE.Mesh(new THREE.ConeGeometry(0.5, 1.4, 24), material);
    mesh.scale.set(1, -1, 1.5);
    return mesh;
  },
};

Object.assign(window, { THREE, RoomEnvironment, EffectComposer, OutputPass, Pass, createGlass, makeScene, makeRenderer, makeCamera, glassMaterial, pixelsOf, measureBall, measureMaps, rowsTexture, traceKnot, movingMeshes });
window.isReady = true;
