// What a visitor waits for: the time to the first picture of <vitrine-viewer>, how long the page is held up until then,
// and how often the GPU is asked for an answer that JavaScript must wait for, until the first picture and afterwards.
//   node tests/bench/first-picture.mjs [--src knot|FILE.glb|...] [--gl llvmpipe|swiftshader|gpu] ...   (--help: all)
// Needs build/web and the packages of tests/. One line of JSON with --json. Fails where no picture comes.
import { existsSync } from 'node:fs';
import { basename, dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { answerWithFile, gpus, launch, listen, openPage } from '../browser-tools.mjs';
import { median } from './glass-report.mjs';

const root = resolve(dirname(fileURLToPath(import.meta.url)), '../..');
const web = resolve(process.env.VITRINE_WEB ?? join(root, 'build/web'));
const help = {
  src: 'built-in shape, or a .glb',
  technique: "of the element; '': its usual one",
  gl: Object.keys(gpus).join(', '),
  size: 'side of the picture, pixels',
  rounds: 'pages opened, each in a browser of its own; medians',
  frames: 'later frames, the view turned before each',
};
const defaults = { src: join(web, 'demo/assets/bunny.glb'), technique: '', gl: 'llvmpipe', size: '512', rounds: '3', frames: '10' };

/** In the page, before its scripts: counts, and watches the main thread. */
function watch() {
  const queries = ['getError', 'getProgramParameter', 'getShaderParameter', 'getProgramInfoLog', 'getShaderInfoLog', 'getParameter',
    'getUniformLocation', 'getAttribLocation', 'getActiveUniform', 'getUniformBlockIndex', 'checkFramebufferStatus', 'readPixels',
    'getBufferSubData', 'clientWaitSync', 'getSyncParameter', 'finish'];
  const watched = { counts: {}, longest: 0, longTasks: [], first: null };
  window.watched = watched;
  const type = WebGL2RenderingContext.prototype;
  for (const name of queries) {
    const real = type[name];
    type[name] = function (...values) {
      const key = values.at(-1) === 0x91B1 ? 'COMPLETION_STATUS' : name; // KHR_parallel_shader_compile: waits for nothing
      watched.counts[key] = (watched.counts[key] ?? 0) + 1;
      return real.apply(this, values);
    };
  }
  let last = performance.now();
  const timer = setInterval(() => {
    const now = performance.now();
    watched.longest = Math.max(watched.longest, now - last - 10);
    last = now;
  }, 10);
  new PerformanceObserver((list) => {
    for (const { startTime, duration } of list.getEntries()) watched.longTasks.push({ startTime, duration });
  }).observe({ type: 'longtask', buffered: true });
  document.addEventListener('load', (event) => {
    if (event.target.localName !== 'vitrine-viewer') return;
    const now = performance.now();
    clearInterval(timer);
    watched.longest = Math.max(watched.longest, now - last - 10);
    watched.first = { milliseconds: now, counts: { ...watched.counts } };
  }, true);
}

function readOptions() {
  const options = Object.fromEntries(Object.entries(defaults).map(([name, value]) => [name, { type: 'string', default: value }]));
  const { values } = parseArgs({ options: { ...options, json: { type: 'boolean' }, help: { type: 'boolean', short: 'h' } } });
  if (values.help) {
    for (const [name, text] of Object.entries(help)) console.log(`  --${name.padEnd(10)} ${text} (${defaults[name].replace(`${root}/`, '')})`);
    process.exit(0);
  }
  for (const name of ['size', 'rounds', 'frames']) {
    if (!(Number(values[name]) >= (name === 'frames' ? 0 : 1))) throw new Error(`--${name} is '${values[name]}'; it must be a number of at least ${name === 'frames' ? 0 : 1}`);
    values[name] = Number(values[name]);
  }
  if (!(values.gl in gpus)) throw new Error(`--gl is '${values.gl}'; it must be one of ${Object.keys(gpus).join(', ')}`);
  for (const file of [join(web, 'vitrine-core.wasm'), ...(/[./]/.test(values.src) ? [values.src] : [])]) {
    if (!existsSync(file)) throw new Error(`${file} is missing; give --src, or run scripts/dependencies.sh and scripts/build-web.sh`);
  }
  return values;
}

async function visit(address, { gl, size, frames }) {
  const browser = await launch(gl, { env: { ...process.env, ...(gl === 'llvmpipe' && { LIBGL_ALWAYS_SOFTWARE: '1' }) } });
  try {
    const page = await openPage(browser, { viewport: { width: size, height: size } });
    const problems = [];
    page.on('pageerror', (reason) => problems.push(reason.message));
    await page.addInitScript(watch);
    await page.goto(address);
    await page.waitForFunction(() => window.watched.first !== null || window.problem);
    const problem = await page.evaluate(() => window.problem);
    if (problem || problems.length > 0) throw new Error(problem || problems.join('; '));
    const found = await page.evaluate(async (count) => {
      const viewer = document.querySelector('vitrine-viewer');
      const { watched } = window;
      await new Promise((done) => setTimeout(done, 100)); // the observer tells of the task that the picture came in
      const { milliseconds, counts } = watched.first;
      const longTasks = watched.longTasks.filter(({ startTime }) => startTime < milliseconds).map(({ duration }) => duration);
      watched.counts = {};
      const times = [];
      for (let i = 0; i < count; ++i) {
        const shown = new Promise((done) => viewer.addEventListener('frame', done, { once: true }));
        viewer.setAttribute('camera-orbit', `${10 * i + 5}deg 80deg auto`);
        times.push((await shown).detail.milliseconds);
      }
      const later = { ...watched.counts };
      const gl = document.createElement('canvas').getContext('webgl2');
      const renderer = gl.getParameter(gl.getExtension('WEBGL_debug_renderer_info').UNMASKED_RENDERER_WEBGL);
      return { milliseconds, longestBlock: watched.longest, longestTask: Math.max(0, ...longTasks), longTasks: longTasks.length, counts, later, times, renderer };
    }, frames);
    return { ...found, browser: browser.version() };
  } finally {
    await browser.close();
  }
}

const polls = ['COMPLETION_STATUS', 'getSyncParameter', 'clientWaitSync']; // Chromium answers at once
const sum = (counts) => Object.entries(counts).filter(([name]) => !polls.includes(name)).reduce((total, [, count]) => total + count, 0);
const list = (counts, frames = 1) => Object.entries(counts).sort((a, b) => polls.includes(a[0]) - polls.includes(b[0]) || b[1] - a[1])
  .map(([name, count]) => `${polls.includes(name) ? '(poll) ' : ''}${name} ${Number((count / frames).toFixed(2))}`).join(', ') || 'none';

async function main() {
  const options = readOptions();
  const { size, frames, gl } = options;
  const isFile = /[./]/.test(options.src);
  const src = isFile ? '/model.glb' : options.src;
  const technique = options.technique && `technique="${options.technique}"`;
  const html = `<!doctype html><link rel="icon" href="data:,"><style>body { margin: 0 } vitrine-viewer { width: ${size}px; height: ${size}px }</style>
    <script type="module" src="/element/vitrine-viewer.js"></script>
    <script>document.addEventListener('error', ({ detail }) => (window.problem = detail?.sourceError?.message), true)</script>
    <vitrine-viewer src="${src}" ${technique} samples="1" quality="high" skybox-image></vitrine-viewer>`;
  const server = await listen((request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost');
    if (pathname === '/') response.writeHead(200, { 'content-type': 'text/html' }).end(html);
    else if (pathname === '/model.glb') answerWithFile(dirname(resolve(options.src)), `/${basename(options.src)}`, response);
    else answerWithFile(web, pathname, response);
  });
  try {
    const visits = [];
    for (let round = 0; round < options.rounds; ++round) visits.push(await visit(`${server.address}/`, options));
    const middle = (name) => median(visits.map((one) => one[name]));
    const [{ renderer, browser, counts, later }] = visits;
    const report = {
      src: basename(options.src), technique: options.technique, gl, size, rounds: options.rounds, frames, renderer, browser,
      firstPicture: middle('milliseconds'), longestBlock: middle('longestBlock'), longestTask: middle('longestTask'), longTasks: middle('longTasks'),
      queries: sum(counts), counts, laterQueries: frames > 0 ? sum(later) / frames : null, later,
      frame: frames > 0 ? median(visits.flatMap(({ times }) => times)) : null,
    };
    if (options.json) {
      console.log(JSON.stringify(report));
      return;
    }
    const ms = (value) => `${value.toFixed(0)} ms`;
    console.log(`${report.renderer}; Chromium ${report.browser}; ${report.src}, ${size} × ${size}; ${report.rounds} pages, medians`);
    console.log(`first picture            ${ms(report.firstPicture)} after navigation`);
    console.log(`longest block until then ${ms(report.longestBlock)} (timer of 10 ms), ${ms(report.longestTask)} (longest of ${report.longTasks} long tasks)`);
    console.log(`queries until then       ${report.queries}: ${list(counts)}`);
    if (frames > 0) {
      console.log(`a later frame            ${ms(report.frame)}, queries ${Number(report.laterQueries.toFixed(2))}: ${list(later, frames)}`);
    }
  } finally {
    server.close();
  }
}

main().catch((reason) => {
  console.error(`bench: ${reason.message}`);
  process.exitCode = 1;
});
