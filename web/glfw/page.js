// The page's half in JavaScript: controls, files, frames. Every number is checked by the core; what
// it says about a bad one is shown as it is, and the picture stays.
import { listenBeforeGlfw, listenToInput } from './input.js';
import { decodePicture, openInCore } from './element/picture.js';
import createVitrine from './vitrine.js';

const element = (id) => document.getElementById(id);
const canvas = element('canvas');
const panel = document.querySelector('.panel');
const sliders = ['layers', 'steps', 'ior'];
const outputPicture = 0, outputAnalysis = 1; // of vtOutput
const presetMedium = 1; // of vtPreset
const largestScale = 2; // canvas pixels per CSS pixel

const state = { model: 'knot', environment: 'studio' };
let settings = { technique: 'exact', layers: 0, steps: 0, ior: 0 }; // 0: as the preset or the model says
let core; // the module
let page, viewer; // handles in it
let stopped = false; // no context any more
let fitted; // canvas width, height, and the share of it that is free
let milliseconds = 0;
let drawing = false; // a frame is on the GPU

// ------------------------------------------------------------------------------------------ calls and words

function showError(text) {
  element('error').textContent = text ?? '';
}

function call(name, ...values) {
  const types = values.map((value) => (typeof value === 'string' ? 'string' : 'number'));
  return core.ccall(`vtViewer_${name}`, 'number', ['number', ...types], [viewer, ...values]);
}

/** A call that answers with a sentence, or nothing: the sentence is shown. True where all is well. */
function attempt(name, ...values) {
  const answer = call(name, ...values);
  showError(answer ? core.UTF8ToString(answer) : '');
  return answer === 0;
}

/** Frames the whole object within the part of the canvas that no panel covers. */
function resetView() {
  const [width, height, share] = fitted;
  call('ResetView', (share * width) / height);
}

function info() {
  return JSON.parse(core.UTF8ToString(call('Info')));
}

/** Controls and the line of information as the core has them. */
function showState() {
  const now = info();
  for (const id of sliders) {
    element(id).value = now[id];
    element(`${id}-value`).textContent = id === 'ior' ? now.ior.toFixed(2) : now[id];
  }
  const analysis = now.output === outputAnalysis;
  element('analysis').checked = analysis;
  element('legend').hidden = !analysis;
  const parts = [`${now.triangles.toLocaleString('en')} triangles`];
  if (now.layerWidth > 0) parts.push(`layers ${now.layerWidth} × ${now.layerHeight}`);
  if (milliseconds > 0) {
    parts.push(`${milliseconds.toFixed(milliseconds < 10 ? 1 : 0)} ms per frame`);
  }
  if (now.openEdges > 0) {
    parts.push(`not closed: ${now.openEdges} open edges`);
  }
  element('info').textContent = parts.join(' · ');
}

function keepInAddress() {
  const query = new URLSearchParams({ ior: info().ior });
  for (const [key, value] of Object.entries(settings)) {
    if (value !== 0 && value !== 'exact') query.set(key, value);
  }
  // A file of the visitor's own has no address.
  if (state.environment !== null) query.set('environment', state.environment);
  if (state.model !== null) query.set('model', state.model);
  history.replaceState(null, '', `?${query}`);
}

// ------------------------------------------------------------------------------------------------ settings

function setGlass(values) {
  const { output } = { ...info(), ...values };
  const wanted = Object.fromEntries(Object.entries(settings).map(([key, value]) => [key, values[key] ?? value]));
  const { technique, layers, steps, ior } = wanted;
  const done = attempt('SetGlass', technique, ior, presetMedium, layers, steps, 0, output, 0, 0, 0, 1, 0, 1);
  if (done) settings = wanted;
  showState();
  return done;
}

/** A built-in model or environment; the choice falls back where the core knows no such name. */
function choose(kind, name) {
  const done = attempt(kind === 'model' ? 'SetShape' : 'SetEnvironment', name);
  if (done) {
    if (kind === 'model') resetView();
    state[kind] = name;
    element(kind).querySelector('.file')?.remove();
  }
  element(kind).value = state[kind] ?? '';
  showState();
  return done;
}

async function openFile(file, kind) {
  let done = false;
  try {
    const bytes = new Uint8Array(await file.arrayBuffer());
    const [call, contents] = kind === 'model' ? ['OpenModel', bytes] : ['OpenEnvironment', await decodePicture(bytes)];
    const { GLctx } = core.GL.currentContext;
    done = openInCore(core, GLctx, call, contents, (name, ...values) => attempt(name, ...values, file.name));
    if (done === null) throw new Error('it is too large for the memory of this page');
  } catch (reason) {
    showError(`${file.name}: cannot be read: ${reason.message}`);
  }
  if (!done) return;
  if (kind === 'model') {
    setGlass({ ior: 0 }); // the file's
    resetView();
  }
  const select = element(kind);
  select.querySelector('.file')?.remove();
  select.append(new Option(file.name, ''));
  select.lastChild.className = 'file';
  select.value = '';
  state[kind] = null;
  showState();
  keepInAddress();
}

function fillSelect(kind, nameOf) {
  for (let i = 0; nameOf(i) !== 0; ++i) {
    element(kind).append(new Option(core.UTF8ToString(nameOf(i))));
  }
  element(kind).addEventListener('change', (event) => choose(kind, event.target.value) && keepInAddress());
}

async function savePicture() {
  const { width, height } = canvas;
  const pixels = image(width, height);
  if (pixels === null) return;
  const copy = Object.assign(document.createElement('canvas'), { width, height });
  copy.getContext('2d').putImageData(new ImageData(pixels, width, height), 0, 0);
  const link = document.createElement('a');
  link.href = URL.createObjectURL(await new Promise((resolve) => copy.toBlob(resolve)));
  link.download = `${state.model ?? 'vitrine'}.png`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** The present view at another size: RGBA bytes, top row first; null, and a sentence, where it fails. */
function image(width, height) {
  const place = call('Image', width, height);
  if (place === 0) showError(core.UTF8ToString(call('Error')));
  return place === 0 ? null : new Uint8ClampedArray(core.HEAPU8.slice(place, place + 4 * width * height));
}

// ------------------------------------------------------------------------------------------------- controls

function listenToControls() {
  for (const id of sliders) {
    element(id).addEventListener('input', (event) => setGlass({ [id]: Number(event.target.value) }));
    element(id).addEventListener('change', keepInAddress);
  }
  element('analysis').addEventListener('change', (event) => setGlass({ output: event.target.checked ? outputAnalysis : outputPicture }));
  element('reset').addEventListener('click', resetView);
  element('save').addEventListener('click', savePicture);
  for (const [id, kind] of [['model-file', 'model'], ['image-file', 'environment']]) {
    element(id).addEventListener('change', async ({ target }) => {
      if (target.files.length > 0) await openFile(target.files[0], kind);
      target.value = ''; // the same file can be chosen again
    });
  }
  document.addEventListener('dragover', (event) => event.preventDefault());
  for (const type of ['dragenter', 'dragover', 'dragleave', 'drop']) {
    document.addEventListener(type, () => document.body.classList.toggle('dropping', type.match(/enter|over/) !== null));
  }
  document.addEventListener('drop', (event) => {
    event.preventDefault();
    const file = event.dataTransfer.files[0];
    if (file) openFile(file, /\.(hdr|png|jpe?g)$/i.test(file.name) ? 'environment' : 'model');
  });
}

// ----------------------------------------------------------------------------------------------------- frames

function canvasSize() {
  const scale = Math.min(window.devicePixelRatio, largestScale);
  return [canvas.clientWidth, canvas.clientHeight].map((side) => Math.max(1, Math.round(side * scale)));
}

/** Size, pixel ratio or panel may have changed; a canvas of a new size is empty until the tick that follows. */
function fitCanvas() {
  const covered = getComputedStyle(panel).position === 'fixed' ? panel.offsetWidth + 32 : 0;
  const fit = [...canvasSize(), Math.max(0.5, 1 - (2 * covered) / canvas.clientWidth)];
  if (String(fit) === String(fitted)) return;
  [canvas.width, canvas.height] = fitted = fit;
  const answer = call('Resize', canvas.width, canvas.height);
  if (answer) showError(core.UTF8ToString(answer));
}

/** Waits for the frame without holding the page up; the next one starts after it. */
function awaitFrame(gl, fence, start) {
  if (gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.UNSIGNALED && !gl.isContextLost()) {
    setTimeout(awaitFrame, 1, gl, fence, start);
    return;
  }
  gl.deleteSync(fence);
  milliseconds = performance.now() - start;
  drawing = false;
  showState();
}

function onFrame() {
  if (stopped) return;
  requestAnimationFrame(onFrame);
  if (drawing) return;
  fitCanvas();
  const start = performance.now();
  const drawn = core._vtPage_Tick(page);
  if (drawn < 0) showError(core.UTF8ToString(call('Error')));
  if (drawn !== 1) return;
  drawing = true;
  const gl = canvas.getContext('webgl2');
  const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
  gl.flush();
  awaitFrame(gl, fence, start);
}

async function main() {
  listenBeforeGlfw(canvas, call);
  canvas.addEventListener('webglcontextlost', (event) => {
    event.preventDefault();
    stopped = true;
    showError('The graphics context was lost; the page starts again as soon as the browser gives it back.');
  });
  canvas.addEventListener('webglcontextrestored', () => location.reload());

  core = await createVitrine({ canvas });
  page = core._vtPage_Start(...canvasSize());
  showError(core.UTF8ToString(core._vtPage_Error(page)));
  viewer = core._vtPage_Viewer(page);
  if (element('error').textContent !== '') {
    element('info').textContent = 'No picture.';
    element('controls').inert = true;
    return;
  }

  fitCanvas();
  fillSelect('model', core._vtShapeName);
  fillSelect('environment', core._vtEnvironmentName);
  choose('model', state.model);
  choose('environment', state.environment);
  const asked = new URLSearchParams(location.search);
  const sentences = [];
  const keep = (done) => done || sentences.push(element('error').textContent);
  for (const kind of ['model', 'environment']) {
    if (asked.has(kind)) keep(choose(kind, asked.get(kind)));
  }
  if (asked.has('technique')) keep(setGlass({ technique: asked.get('technique') }));
  for (const id of sliders) {
    if (asked.has(id)) keep(setGlass({ [id]: Number(asked.get(id)) }));
  }
  showError(sentences.join('. '));

  listenToInput(canvas, call, resetView);
  listenToControls();
  requestAnimationFrame(onFrame);
  const setView = (...numbers) => attempt('SetView', ...numbers); // eye x, y, z, target x, y, z, degrees
  window.vitrine = { image, info, setView, isIdle: () => !drawing }; // for the console and the tests
}

main().catch((reason) => showError(`The renderer cannot be loaded: ${reason.message}`));
