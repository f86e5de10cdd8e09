// A scene of three.js's with glass in it, drawn by Vitrine or by three.js itself.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { RoomEnvironment } from 'three/addons/environments/RoomEnvironment.js';
import { createGlass } from './index.js';

const canvas = document.querySelector('canvas'), time = document.querySelector('output'), choice = document.querySelector('#vitrine'), turning = document.querySelector('#turning');
const renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
renderer.toneMapping = THREE.NeutralToneMapping;
renderer.shadowMap.enabled = true;
const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(35, 1, 0.1, 60);
camera.position.set(2.4, 1.5, 6.4);
const controls = new OrbitControls(camera, canvas);
scene.background = new THREE.Color(0x8fa3b5);
scene.environment = new THREE.PMREMGenerator(renderer).fromScene(new RoomEnvironment(), 0.02).texture;
scene.environmentIntensity = 0.8;

function add(geometry, material, x, y, z) {
  const mesh = new THREE.Mesh(geometry, material);
  mesh.position.set(x, y, z);
  mesh.castShadow = material.transmission === undefined;
  mesh.receiveShadow = true;
  scene.add(mesh);
  return mesh;
}

function squares() {
  const board = Object.assign(document.createElement('canvas'), { width: 256, height: 256 }), pen = board.getContext('2d');
  for (let i = 0; i < 64; ++i) {
    pen.fillStyle = (i + (i >> 3)) % 2 ? '#d8cdb8' : '#6b4a36';
    pen.fillRect(32 * (i % 8), 32 * (i >> 3), 32, 32);
  }
  return Object.assign(new THREE.CanvasTexture(board), { colorSpace: THREE.SRGBColorSpace, anisotropy: 8 });
}

/** Profile of a goblet, turned about its axis: outside up, inside down. */
const goblet = [[0, -1], [0.5, -1], [0.5, -0.95], [0.08, -0.85], [0.06, -0.3], [0.3, -0.1], [0.45, 0.2], [0.42, 0.7], [0.39, 0.7], [0.41, 0.2], [0.27, -0.04], [0, -0.15]];
const opaque = (color, more) => new THREE.MeshStandardMaterial({ color, roughness: 0.5, ...more });
const glassOf = (more) => new THREE.MeshPhysicalMaterial({ transmission: 1, thickness: 0.5, roughness: 0, ...more });

const floor = add(new THREE.PlaneGeometry(14, 14), opaque(0xffffff, { map: squares() }), 0, -1, 0);
floor.rotation.x = -Math.PI / 2;
add(new THREE.BoxGeometry(0.7, 0.7, 0.7), opaque(0xd03030), -1.5, -0.65, -1.6);
add(new THREE.SphereGeometry(0.5, 48, 24), opaque(0x30a040), 1.3, -0.5, -1.9);
add(new THREE.CylinderGeometry(0.07, 0.07, 2.4, 24), opaque(0xf0c020), 0.75, 0.2, 1.3);
const knot = add(new THREE.TorusKnotGeometry(0.55, 0.19, 220, 32), glassOf({ ior: 1.5 }), 0, 0.1, 0);
const ring = add(new THREE.TorusGeometry(0.95, 0.06, 16, 64), opaque(0x3060ff), 0, 0.1, 0);
ring.rotation.y = Math.PI / 2;
const diamond = add(new THREE.LatheGeometry([[0, -0.5], [0.5, 0.1], [0.3, 0.28], [0, 0.28]].map((at) => new THREE.Vector2(...at)), 8), glassOf({ ior: 2.4, flatShading: true }), 1.7, -0.45, 0.5);
add(new THREE.LatheGeometry(goblet.map((at) => new THREE.Vector2(...at)), 48), glassOf({ ior: 1.52, attenuationColor: new THREE.Color(0.6, 0.9, 0.8), attenuationDistance: 0.8 }), -1.6, 0, 0.6);
scene.add(new THREE.HemisphereLight(0xffffff, 0x886655, 0.6));
const sun = new THREE.DirectionalLight(0xffffff, 2);
sun.position.set(3, 5, 2);
sun.castShadow = true;
scene.add(sun);

const glass = await createGlass(renderer).catch(({ message }) => void (time.textContent = message));

function draw(now) {
  if (turning.checked) {
    knot.rotation.y = 0.0004 * now;
    ring.rotation.z = 0.0006 * now;
    diamond.rotation.y = 0.0008 * now;
  }
  const { clientWidth: width, clientHeight: height } = canvas;
  camera.aspect = width / height;
  camera.updateProjectionMatrix();
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  renderer.setSize(width, height, false);
  controls.update();
  const start = performance.now();
  if (choice.checked && glass) glass.render(scene, camera);
  else renderer.render(scene, camera);
  renderer.getContext().finish();
  if (glass) time.textContent = `${(performance.now() - start).toFixed(1)} ms`;
}
renderer.setAnimationLoop(draw);
Object.assign(window, { renderer, scene, camera, glass }); // for the console
