// An app of React Three Fiber whose glass is Vitrine's; bundled by three.test.mjs.
import { Canvas } from '@react-three/fiber';
import { createElement } from 'react';
import { createRoot } from 'react-dom/client';
import { Glass } from 'vitrine-viewer/fiber';

const locateFile = (name) => `/site/${name}`;
const onReady = (glass) => (window.glass = glass);
const onError = ({ message }) => (window.problem = message);

const knot = createElement('mesh', {}, createElement('torusKnotGeometry', { args: [0.6, 0.2, 100, 16] }),
  createElement('meshPhysicalMaterial', { transmission: 1, thickness: 1, roughness: 0 }));
const wall = createElement('mesh', { position: [0, 0, -2] }, createElement('planeGeometry', { args: [4, 1] }), createElement('meshBasicMaterial', { color: 'red' }));
const scene = createElement(Canvas, { frameloop: 'demand', gl: { preserveDrawingBuffer: true } }, knot, wall, createElement(Glass, { locateFile, onReady, onError }));

const place = document.createElement('div');
place.style.cssText = 'width: 96px; height: 96px';
document.body.append(place);
createRoot(place).render(scene);
window.isReady = true;
