// How long a visitor waits, and for how many bytes: from navigation to the first frame of the same model, with
// <vitrine-viewer> and with a viewer made of three.js (MeshPhysicalMaterial with transmission, tree-shaken and
// minified), in turns in one Chromium, the cache off, files gzipped. Read the ratios.
//   node tests/bench/load.mjs [ROUNDS]       needs build/web and the packages of tests/
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';
import { launch, listen, typeOf } from '../browser-tools.mjs';

const root = resolve(dirname(fileURLToPath(import.meta.url)), '../..');
const site = join(root, 'build/bench');
const web = join(root, 'build/web');
const model = join(web, 'demo/assets/bunny.glb');
const rounds = Number(process.argv[2] ?? 5);
const side = 512;

const threeSource = `
  import { ACESFilmicToneMapping, Box3, MeshPhysicalMaterial, PerspectiveCamera, PMREMGenerator, Scene, Vector3,
    WebGLRenderer } from 'three';
  import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
  import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
  import { RoomEnvironment } from 'three/examples/jsm/environments/RoomEnvironment.js';
  const renderer = new WebGLRenderer({ antialias: true });
  renderer.setSize(${side}, ${side});
  document.body.append(renderer.domElement);
  const scene = new Scene();
  scene.environment = scene.background = new PMREMGenerator(renderer).fromScene(new RoomEnvironment()).texture;
  const camera = new PerspectiveCamera(45, 1, 0.01, 1000);
  new GLTFLoader().load('/model.glb', ({ scene: loaded }) => {
    const box = new Box3().setFromObject(loaded), centre = box.getCenter(new Vector3());
    const size = box.getSize(new Vector3()).length();
    loaded.traverse((node) => {
      if (!node.isMesh) return;
      node.geometry.computeVertexNormals();
      node.material = new MeshPhysicalMaterial({ transmission: 1, roughness: 0, ior: 1.5, thickness: 0.3 * size });
    });
    scene.add(loaded);
    camera.position.copy(centre).add(new Vector3(0.1, 0.1, 1).multiplyScalar(1.3 * size));
    const controls = new OrbitControls(camera, renderer.domElement);
    controls.target.copy(centre);
    controls.update();
    renderer.render(scene, camera);
    const gl = renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // finished
    window.firstFrame = performance.now();
  });
`;

const pages = {
  '/three': '<!doctype html><link rel="icon" href="data:,"><body><script type="module" src="/three.js"></script>',
  '/vitrine': `<!doctype html><link rel="icon" href="data:,"><script type="module" src="/vitrine.js"></script>
    <vitrine-viewer src="/model.glb" skybox-image ior="1.5" style="width:${side}px;height:${side}px"></vitrine-viewer>`,
};
const vitrineSource = `
  import '${join(web, 'element/vitrine-viewer.js')}';
  document.querySelector('vitrine-viewer').addEventListener('load', () => (window.firstFrame = performance.now()));
`;

async function bundle(name, contents) {
  await build({
    stdin: { contents, resolveDir: join(root, 'tests') },
    bundle: true, minify: true, format: 'esm', target: 'es2022', outfile: join(site, name), logLevel: 'error',
  });
}

function serve() {
  const cache = new Map();
  return listen((request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost');
    const file = pathname === '/model.glb' ? model : /^\/vitrine-(core\.wasm|shaders\.txt)$/.test(pathname) ? join(web, pathname) : join(site, pathname);
    if (!cache.has(pathname)) {
      const known = pages[pathname] ?? (existsSync(file) ? readFileSync(file) : null);
      cache.set(pathname, known && gzipSync(known, { level: 9 }));
    }
    const body = cache.get(pathname);
    if (!body) return response.writeHead(404).end();
    const type = pages[pathname] ? 'text/html' : typeOf(pathname);
    return response.writeHead(200, { 'content-type': type, 'content-encoding': 'gzip', 'cache-control': 'no-store' }).end(body);
  });
}

if (!existsSync(model)) {
  console.error('bench: build/web/demo/assets/bunny.glb is missing; run scripts/dependencies.sh and scripts/build-web.sh');
  process.exit(1);
}
mkdirSync(site, { recursive: true });
await bundle('three.js', threeSource);
await bundle('vitrine.js', vitrineSource);
const server = await serve();
const browser = await launch();

async function visit(path, screenshot) {
  const page = await browser.newPage({ viewport: { width: side, height: side } });
  let bytes = 0;
  const client = await page.context().newCDPSession(page);
  await client.send('Network.enable');
  client.on('Network.loadingFinished', ({ encodedDataLength }) => (bytes += encodedDataLength));
  await page.goto(server.address + path);
  await page.waitForFunction(() => window.firstFrame !== undefined, null, { timeout: 60000 });
  const time = await page.evaluate(() => window.firstFrame);
  if (screenshot) await page.screenshot({ path: join(site, `${path.slice(1)}.png`) });
  const renderer = await page.evaluate(() => {
    const gl = document.createElement('canvas').getContext('webgl2');
    return gl.getParameter(gl.getExtension('WEBGL_debug_renderer_info').UNMASKED_RENDERER_WEBGL);
  });
  await page.close();
  return { time, bytes, renderer };
}

const paths = Object.keys(pages);
const results = Object.fromEntries(paths.map((path) => [path, []]));
for (let round = -1; round < rounds; ++round) {
  for (const path of paths) {
    const result = await visit(path, round === 0);
    if (round >= 0) results[path].push(result); // the first round warms the browser up
    process.stderr.write('.');
  }
}
process.stderr.write('\n');
await browser.close();
server.close();

const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
const rows = paths.map((path) => ({
  name: path.slice(1),
  time: median(results[path].map(({ time }) => time)),
  bytes: median(results[path].map(({ bytes }) => bytes)),
}));
const table = `${results['/vitrine'][0].renderer}; ${rounds} rounds, medians; bunny.glb, ${side} x ${side}

| viewer | navigation to first frame | transferred, model included |
|---|---|---|
${rows.map(({ name, time, bytes }) => `| ${name} | ${time.toFixed(0)} ms (${(time / rows[0].time).toFixed(2)}) | ${(bytes / 1000).toFixed(0)} KB (${(bytes / rows[0].bytes).toFixed(2)}) |`).join('\n')}
`;
console.log(table);
writeFileSync(join(site, 'load.md'), table);
