// The command line of glass.mjs.
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { gpus } from '../browser-tools.mjs';

const root = resolve(dirname(fileURLToPath(import.meta.url)), '../..');
const peers = ['physical', 'physical-double', 'transmission', 'transmission-default', 'transmission-backside', 'refraction'];
const defaults = {
  model: join(root, 'build/web/demo/assets/bunny.glb'),
  environment: join(root, 'build/web/demo/assets/city.hdr'),
  peers: 'physical,transmission,transmission-default,refraction',
  techniques: 'layered,exact,exact-plain',
  gl: 'llvmpipe',
  size: '512',
  rounds: '10',
  ior: '1.5',
  camera: '',
  target: '',
  fov: '45',
  thickness: '',
  samples: '64',
  out: join(root, 'build/bench/glass'),
  into: '',
};
const help = {
  model: 'closed mesh, .glb',
  environment: 'equirectangular .hdr',
  peers: `of ${peers.join(', ')}; may be empty`,
  techniques: "of 'vitrine list', with -plain: without Fresnel reflection; one that is not there is left out with a note",
  gl: 'llvmpipe, swiftshader or gpu',
  size: 'side of the picture, pixels',
  rounds: 'frames of each, in turns',
  ior: 'index of refraction',
  camera: 'position of the eye; else the one of 0.36,0.3,3.05 before a model that reaches from -1 to 1',
  target: "what it looks at; else the model's centre",
  fov: 'vertical field of view, degrees',
  thickness: 'of the screen-space materials; else what suits each best of five (FLIP)',
  samples: 'paths a pixel of the reference with reflection',
  out: 'folder',
  into: 'Markdown file that gets the report between <!-- glass MODEL --> and <!-- end -->',
};

/** Those of the command line. @throws {Error} a sentence */
export function readOptions() {
  const options = Object.fromEntries(Object.keys(defaults).map((name) => [name, { type: 'string', default: defaults[name] }]));
  const { values } = parseArgs({ options: { ...options, help: { type: 'boolean', short: 'h' } } });
  if (values.help) {
    for (const [name, text] of Object.entries(help)) {
      const value = defaults[name].replace(`${root}/`, '');
      console.log(`  --${name.padEnd(12)} ${text}${value && ` (${value})`}`);
    }
    process.exit(0);
  }
  const vector = (name) => {
    if (values[name] === '') return null;
    const numbers = values[name].split(',').map(Number);
    if (numbers.length !== 3 || numbers.some(Number.isNaN)) throw new Error(`--${name} is '${values[name]}'; give three numbers, as 0,0,3`);
    return numbers;
  };
  const number = (name, least) => {
    const value = Number(values[name]);
    if (!(value >= least)) throw new Error(`--${name} is '${values[name]}'; it must be a number of at least ${least}`);
    return value;
  };
  const list = (name) => values[name].split(',').filter(Boolean);
  const stranger = list('peers').find((name) => !peers.includes(name));
  if (stranger !== undefined) throw new Error(`--peers names '${stranger}'; there are ${peers.join(', ')}`);
  if (!(values.gl in gpus)) throw new Error(`--gl is '${values.gl}'; it must be one of ${Object.keys(gpus).join(', ')}`);
  return {
    ...values,
    peers: list('peers'), techniques: list('techniques'),
    size: number('size', 16), rounds: number('rounds', 1), ior: number('ior', 1), samples: number('samples', 1),
    thickness: values.thickness === '' ? null : number('thickness', 0),
    eye: vector('camera'), target: vector('target'), fov: number('fov', 1),
    out: resolve(values.out),
  };
}
