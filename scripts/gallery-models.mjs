// Makes the models of the gallery that are no built-in shapes: a ring's metal, a perfume bottle with its liquid, collar
// and cap, and the wine in the goblet. They are shapes only; scripts/gallery.sh says of what each is.
// Usage: node scripts/gallery-models.mjs FOLDER
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { Body, hoop, lathe, rod } from './bodies.mjs';
import { glb, gltf } from './glb.mjs';

/** Band of radius 1 about z, and a head of six prongs for a stone whose girdle has radius 0.5 and lies at y = 1.5. */
function ring() {
  const body = new Body();
  hoop(body, 0.07, 0.12, (angle, out, aside) => [(1 + out) * Math.cos(angle), (1 + out) * Math.sin(angle), aside]);
  const level = (radius, height) => (angle, out, aside) => [(radius + out) * Math.cos(angle), height + aside, (radius + out) * Math.sin(angle)];
  hoop(body, 0.028, 0.028, level(0.29, 1.21), 96);
  hoop(body, 0.028, 0.028, level(0.145, 1.06), 96);
  for (let prong = 0; prong < 6; ++prong) {
    const angle = (Math.PI * (prong + 0.5)) / 3;
    const profile = [[0.06, 0.98, 0.04], [0.16, 1.07, 0.04], [0.3, 1.22, 0.038], [0.43, 1.36, 0.036], [0.53, 1.48, 0.036], [0.525, 1.56, 0.036], [0.45, 1.605, 0.04], [0.4, 1.63, 0.042]];
    rod(body, profile.map(([radius, height, thick]) => [radius * Math.cos(angle), height, radius * Math.sin(angle), thick]));
  }
  return body;
}

// Perfume. The bottle's wall is 0.1 thick, its base 0.16; the liquid goes 0.03 into both.
const flacon = [
  [0, 0, 1], [0.3, 0, 1], [0.5, 0, 1], [0.53, 0, 1], [0.56, 0.01, 1], [0.57, 0.05, 1], [0.57, 0.2, 1], [0.57, 0.6, 1], [0.57, 0.95, 1],
  [0.57, 1.08, 1], [0.555, 1.13, 1], [0.5, 1.155, 1], [0.34, 1.17, 0.9], [0.23, 1.18, 0.3], [0.2, 1.2, 0], [0.19, 1.25, 0], [0.19, 1.36, 0], [0.185, 1.4, 0], [0.165, 1.41, 0],
  [0.14, 1.4, 0], [0.13, 1.35, 0], [0.13, 1.22, 0], [0.14, 1.13, 0], [0.2, 1.07, 0.4], [0.36, 1.05, 0.9], [0.43, 1.04, 1], [0.465, 1.01, 1], [0.47, 0.94, 1],
  [0.47, 0.6, 1], [0.47, 0.35, 1], [0.47, 0.22, 1], [0.46, 0.175, 1], [0.42, 0.16, 1], [0.25, 0.16, 1], [0, 0.16, 1],
];
const liquid = [
  [0, 0.13, 1], [0.25, 0.13, 1], [0.43, 0.13, 1], [0.485, 0.15, 1], [0.5, 0.2, 1], [0.5, 0.35, 1], [0.5, 0.6, 1], [0.5, 0.76, 1], [0.5, 0.8, 1], [0.5, 0.8, 1], [0.49, 0.8, 1], [0.3, 0.8, 1], [0, 0.8, 1],
];
const collar = [[0, 1.19], [0.2, 1.19], [0.235, 1.19], [0.24, 1.2], [0.24, 1.23], [0.24, 1.39], [0.24, 1.42], [0.235, 1.43], [0.2, 1.43], [0, 1.43]];
const cap = [
  [0, 1.44, 1], [0.2, 1.44, 1], [0.3, 1.44, 1], [0.325, 1.44, 1], [0.335, 1.45, 1], [0.335, 1.48, 1], [0.335, 1.7, 1], [0.335, 1.96, 1], [0.335, 2.01, 1], [0.32, 2.04, 1], [0.27, 2.045, 1], [0.15, 2.045, 1], [0, 2.045, 1],
];
// In the shape `goblet`, whose middle is at 0 and whose inner wall's control points are these: a third of its wall further out.
const wine = [
  [0, 0.915], [0.165, 0.936], [0.306, 1.013], [0.394, 1.166], [0.424, 1.356], [0.4235, 1.4], [0.422, 1.44], [0.422, 1.45], [0.421, 1.45], [0.41, 1.45], [0.25, 1.45], [0, 1.45],
].map(([radius, height]) => [radius, height - 1.001]);

const folder = process.argv[2];
if (folder === undefined) throw new Error('gallery-models.mjs: give the folder that the models are written to');
mkdirSync(folder, { recursive: true });
const bodies = { ring: ring(), flacon: lathe(flacon), liquid: lathe(liquid), collar: lathe(collar), cap: lathe(cap), wine: lathe(wine) };
for (const [name, body] of Object.entries(bodies)) writeFileSync(join(folder, `${name}.glb`), glb(gltf(body)));
