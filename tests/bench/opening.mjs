// What a visitor waits for, beside rivals: from navigation to the first picture of the same glass model, bytes over the
// wire, and how the page is held up meanwhile and while the view is turned for some seconds afterwards. With
// <vitrine-viewer>, with <model-viewer>, and with a viewer made of three.js (MeshPhysicalMaterial with transmission,
// tree-shaken and minified); in turns, each page in a browser of its own, the cache cold, files gzipped. Read the ratios.
//   node tests/bench/opening.mjs [--gl llvmpipe|swiftshader|gpu] [--rounds N] [--seconds N] [--into FILE.md]   (--help: all)
// Needs build/web and the packages of tests/ and tests/bench/ (npm --prefix tests/bench ci).
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';
import { glb, gltf } from '../../scripts/glb.mjs';
import { gpus, launch, listen, openPage, typeOf } from '../browser-tools.mjs';
import { median } from './glass-report.mjs';

const root = resolve(dirname(fileURLToPath(import.meta.url)), '../..');
const site = join(root, 'build/bench/opening');
const web = join(root, 'build/web');
const npm = join(root, 'tests/bench/node_modules');
const help = {
  model: '.glb of glass; the bunny of npm without',
  gl: Object.keys(gpus).join(', '),
  size: 'side of the picture, pixels',
  rounds: 'pages opened of each, in turns; medians',
  seconds: 'for which the view is turned once the picture is there',
  into: 'Markdown file that gets the report between <!-- opening GL --> and <!-- end -->',
};
const defaults = { model: '', gl: 'llvmpipe', size: '512', rounds: '5', seconds: '5', into: '' };
const blocks = 50; // milliseconds from which on the browser calls a task long

const threeSource = (side) => `
  import { Box3, NeutralToneMapping, PerspectiveCamera, PMREMGenerator, Scene, Vector3, WebGLRenderer } from 'three';
  import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
  import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
  import { RoomEnvironment } from 'three/examples/jsm/environments/RoomEnvironment.js';
  const renderer = new WebGLRenderer({ antialias: true });
  renderer.toneMapping = NeutralToneMapping;
  renderer.setSize(${side}, ${side});
  document.body.append(renderer.domElement);
  const scene = new Scene(), camera = new PerspectiveCamera(45, 1, 0.01, 1000);
  scene.environment = scene.background = new PMREMGenerator(renderer).fromScene(new RoomEnvironment()).texture;
  new GLTFLoader().load('/model.glb', ({ scene: loaded }) => {
    const box = new Box3().setFromObject(loaded), centre = box.getCenter(new Vector3());
    const size = box.getSize(new Vector3()).length();
    scene.add(loaded);
    camera.position.copy(centre).add(new Vector3(0.1, 0.1, 1).multiplyScalar(1.3 * size));
    const controls = new OrbitControls(camera, renderer.domElement);
    controls.target.copy(centre);
    controls.enableDamping = true;
    renderer.setAnimationLoop(() => {
      controls.update();
      renderer.render(scene, camera);
      window.drawn?.();
    });
    window.drawn = () => {
      window.drawn = undefined;
      window.hasPicture(renderer.domElement);
    };
  });
`;
const sources = {
  vitrine: () => `
    import '${join(web, 'element/vitrine-viewer.js')}';
    document.querySelector('vitrine-viewer').addEventListener('load', () => window.hasPicture(null)); // it waits for the GPU`,
  // Two frames after its own word: its picture is there then at the earliest.
  'model-viewer': () => `
    import '${join(npm, '@google/model-viewer/dist/model-viewer.min.js')}';
    const viewer = document.querySelector('model-viewer');
    viewer.addEventListener('load', () => requestAnimationFrame(() => requestAnimationFrame(() => window.hasPicture(viewer.shadowRoot.querySelector('canvas')))));`,
  three: threeSource,
};
const titles = { vitrine: '`<vitrine-viewer>`', 'model-viewer': '`<model-viewer>`', three: 'three.js, `MeshPhysicalMaterial`' };
const bodies = (side) => ({
  vitrine: `<vitrine-viewer src="/model.glb" skybox-image camera-controls style="width:${side}px;height:${side}px"></vitrine-viewer>`,
  'model-viewer': `<model-viewer src="/model.glb" camera-controls interaction-prompt="none" style="width:${side}px;height:${side}px"></model-viewer>`,
  three: '',
});

/** In the page, before its scripts. */
function watch() {
  window.longTasks = [];
  new PerformanceObserver((list) => {
    for (const { startTime, duration } of list.getEntries()) window.longTasks.push({ startTime, duration });
  }).observe({ type: 'longtask', buffered: true });
  /** @param {HTMLCanvasElement|null} canvas of a frame that was asked for; null: it has been drawn */
  window.hasPicture = (canvas) => {
    const gl = canvas?.getContext('webgl2');
    if (gl) gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // answers once the frame is drawn
    else canvas?.getContext('2d')?.getImageData(0, 0, 1, 1);
    window.firstPicture ??= performance.now();
  };
}

function readOptions() {
  const options = Object.fromEntries(Object.entries(defaults).map(([name, value]) => [name, { type: 'string', default: value }]));
  const { values } = parseArgs({ options: { ...options, help: { type: 'boolean', short: 'h' } } });
  if (values.help) {
    for (const [name, text] of Object.entries(help)) console.log(`  --${name.padEnd(8)} ${text} (${defaults[name] || 'none'})`);
    process.exit(0);
  }
  for (const name of ['size', 'rounds', 'seconds']) {
    if (!(Number(values[name]) >= 1)) throw new Error(`--${name} is '${values[name]}'; it must be a number of at least 1`);
    values[name] = Number(values[name]);
  }
  if (!(values.gl in gpus)) throw new Error(`--gl is '${values.gl}'; it must be one of ${Object.keys(gpus).join(', ')}`);
  const needed = { 'scripts/build-web.sh': join(web, 'vitrine-core.wasm'), 'npm --prefix tests/bench ci': join(npm, '@google/model-viewer'), ...(values.model && { 'another --model': values.model }) };
  for (const [remedy, file] of Object.entries(needed)) if (!existsSync(file)) throw new Error(`${file} is missing; run or give ${remedy}`);
  return values;
}

/** The bunny as a body of glass, with normals as means of its triangles'. */
function glassBunny() {
  const { positions: points, cells } = createRequire(join(root, 'tests/package.json'))('bunny');
  const normals = points.map(() => [0, 0, 0]);
  for (const cell of cells) {
    const [a, b, c] = cell.map((i) => points[i]);
    const [u, v] = [b, c].map((p) => p.map((x, i) => x - a[i]));
    const cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    for (const i of cell) normals[i] = normals[i].map((x, k) => x + cross[k]);
  }
  const made = gltf({ positions: points.flat(), normals: normals.flatMap((n) => n.map((x) => x / Math.hypot(...n))), indices: cells.flat(), ior: 1.5 });
  made.json.extensionsUsed.push('KHR_materials_transmission', 'KHR_materials_volume');
  Object.assign(made.json.materials[0], { pbrMetallicRoughness: { metallicFactor: 0, roughnessFactor: 0 } });
  Object.assign(made.json.materials[0].extensions, { KHR_materials_transmission: { transmissionFactor: 1 }, KHR_materials_volume: { thicknessFactor: 3.5 } });
  return glb(made);
}

async function makeSite({ size, model }) {
  mkdirSync(site, { recursive: true });
  const files = new Map([['/model.glb', model ? readFileSync(model) : glassBunny()]]);
  for (const name of ['vitrine-core.wasm', 'vitrine-full.wasm', 'vitrine-shaders.txt']) files.set(`/${name}`, readFileSync(join(web, name)));
  for (const [name, body] of Object.entries(bodies(size))) {
    const outfile = join(site, `${name}.js`);
    // three of tests/bench is what model-viewer's own bundle is compared with; the larger core is not needed.
    await build({
      stdin: { contents: sources[name](size), resolveDir: join(root, 'tests/bench') },
      bundle: true, minify: true, format: 'esm', target: 'es2022', outfile, logLevel: 'error', legalComments: 'none',
      external: ['../vitrine-full.js', './unpack.js', './animation.js', './exr.js', './draco.js', './meshopt.js', './basis.js', './hotspots.js', './prompt.js', './backdrop.js'],
    });
    files.set(`/${name}.js`, readFileSync(outfile));
    files.set(`/${name}`, Buffer.from(`<!doctype html><link rel="icon" href="data:,"><style>body { margin: 0 }</style><body>${body}<script type="module" src="/${name}.js"></script>`));
  }
  const packed = new Map([...files].map(([name, bytes]) => [name, gzipSync(bytes, { level: 9 })]));
  let sent = 0;
  const server = await listen((request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost');
    if (!packed.has(pathname)) return response.writeHead(404).end();
    sent += packed.get(pathname).length;
    const type = pathname.includes('.') ? typeOf(pathname) : 'text/html';
    return response.writeHead(200, { 'content-type': type, 'content-encoding': 'gzip', 'cache-control': 'no-store' }).end(packed.get(pathname));
  });
  /** Bytes of the files that have been sent since the last call. */
  const takeSent = () => {
    const bytes = sent;
    sent = 0;
    return bytes;
  };
  return { ...server, takeSent };
}

const sumOf = (tasks) => tasks.reduce((sum, { duration }) => sum + duration, 0);
const longestOf = (tasks) => Math.max(0, ...tasks.map(({ duration }) => duration));

async function visit({ address, takeSent }, name, { gl, size, seconds }, screenshot) {
  const browser = await launch(gl, { env: { ...process.env, ...(gl === 'llvmpipe' && { LIBGL_ALWAYS_SOFTWARE: '1' }) } });
  try {
    const page = await openPage(browser, { viewport: { width: size, height: size } });
    const problems = [];
    page.on('pageerror', (reason) => problems.push(reason.message));
    takeSent();
    await page.addInitScript(watch);
    await page.goto(`${address}/${name}`);
    await page.waitForFunction(() => window.firstPicture !== undefined);
    if (problems.length > 0) throw new Error(`${name}: ${problems.join('; ')}`);
    await page.waitForTimeout(1500); // what was begun with the first picture is over
    const first = await page.evaluate(() => window.firstPicture), bytes = takeSent();
    if (screenshot) await page.screenshot({ path: join(site, `${name}-${gl}.png`) });
    const start = await page.evaluate(() => performance.now());
    const [middle, reach] = [size / 2, size / 4];
    await page.mouse.move(middle, middle);
    await page.mouse.down();
    for (const end = Date.now() + 1000 * seconds; Date.now() < end;) {
      const angle = (end - Date.now()) / 400;
      await page.mouse.move(middle + reach * Math.cos(angle), middle + reach * Math.sin(angle) / 4);
      await page.waitForTimeout(30);
    }
    await page.mouse.up();
    await page.waitForTimeout(200);
    const { tasks, renderer } = await page.evaluate(() => {
      const context = document.createElement('canvas').getContext('webgl2');
      return { tasks: window.longTasks, renderer: context.getParameter(context.getExtension('WEBGL_debug_renderer_info').UNMASKED_RENDERER_WEBGL) };
    });
    const opening = tasks.filter(({ startTime }) => startTime < first), later = tasks.filter(({ startTime }) => startTime >= start);
    return {
      first, bytes, renderer, version: browser.version(),
      count: opening.length, longest: longestOf(opening), blocked: sumOf(opening), laterCount: later.length, laterLongest: longestOf(later),
    };
  } finally {
    await browser.close();
  }
}

function insert(page, gl, report) {
  const start = `<!-- opening ${gl} -->\n`, end = '<!-- end -->';
  const from = page.indexOf(start), to = page.indexOf(end, from);
  if (from < 0 || to < 0) throw new Error(`no marks '${start.trim()}' and '${end}' in the file of --into`);
  return `${page.slice(0, from + start.length)}\n${report}\n${page.slice(to)}`;
}

async function main() {
  const options = readOptions();
  const server = await makeSite(options);
  const names = Object.keys(titles), results = Object.fromEntries(names.map((name) => [name, []]));
  try {
    for (let round = 0; round < options.rounds; ++round) {
      for (const name of names) {
        results[name].push(await visit(server, name, options, round === 0));
        process.stderr.write('.');
      }
    }
  } finally {
    server.close();
    process.stderr.write('\n');
  }
  const middle = (name, what) => median(results[name].map((one) => one[what]));
  const [{ renderer, version }] = results.vitrine;
  const packages = ['three', '@google/model-viewer'].map((name) => `${name} ${JSON.parse(readFileSync(join(npm, name, 'package.json'))).version}`).join(', ');
  const ratio = (name, what) => (middle(name, what) / middle('three', what)).toFixed(2);
  const rows = names.map((name) => {
    const of = (what) => middle(name, what);
    const opening = of('count') === 0 ? 'none' : `${of('count')}, longest ${of('longest').toFixed(0)} ms, together ${of('blocked').toFixed(0)} ms`;
    const later = of('laterCount') === 0 ? 'none' : `${of('laterCount')}, longest ${of('laterLongest').toFixed(0)} ms`;
    return `| ${titles[name]} | ${(of('bytes') / 1000).toFixed(0)} KB (${ratio(name, 'bytes')}) | ${of('first').toFixed(0)} ms (${ratio(name, 'first')}) | ${opening} | ${later} |`;
  });
  const report = `${renderer}; Chromium ${version}; ${options.size} × ${options.size}, ${options.model || 'the bunny of npm'}; ${options.rounds} rounds in turns, medians; ratios to three.js. Packages: ${packages}.

| viewer | over the wire | first picture | tasks above ${blocks} ms until then | while turned for ${options.seconds} s |
|---|---|---|---|---|
${rows.join('\n')}
`;
  console.log(report);
  if (options.into) writeFileSync(options.into, insert(readFileSync(options.into, 'utf8'), options.gl, report));
}

main().catch((reason) => {
  console.error(`bench: ${reason.message}`);
  process.exitCode = 1;
});
