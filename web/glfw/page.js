// The page's half in JavaScript: the canvas, its size, its frames. The page shows GLFW's port, a window with its input and
// the viewer in it; what a viewer can be told is the demo's to show.
import { listenBeforeGlfw, listenToInput } from './input.js';
import createVitrine from './vitrine.js';

const canvas = document.getElementById('canvas');
const largestScale = 2; // canvas pixels per CSS pixel

let core; // the module
let page, viewer; // handles in it
let stopped = false; // no context any more
let drawing = false; // a frame is on the GPU

function showError(text) {
  document.getElementById('error').textContent = text;
}

function call(name, ...values) {
  const types = values.map((value) => (typeof value === 'string' ? 'string' : 'number'));
  return core.ccall(`vtViewer_${name}`, 'number', ['number', ...types], [viewer, ...values]);
}

/** A call that answers with a sentence, or nothing: the sentence is shown. */
function attempt(name, ...values) {
  const answer = call(name, ...values);
  if (answer !== 0) showError(core.UTF8ToString(answer));
}

/** The present view at another size: RGBA bytes, top row first; null, and a sentence, where it fails. */
function image(width, height) {
  const place = call('Image', width, height);
  if (place === 0) showError(core.UTF8ToString(call('Error')));
  return place === 0 ? null : new Uint8ClampedArray(core.HEAPU8.slice(place, place + 4 * width * height));
}

function canvasSize() {
  const scale = Math.min(window.devicePixelRatio, largestScale);
  return [canvas.clientWidth, canvas.clientHeight].map((side) => Math.max(1, Math.round(side * scale)));
}

/** Size or pixel ratio may have changed; a canvas of a new size is empty until the tick that follows. */
function fitCanvas() {
  const [width, height] = canvasSize();
  if (canvas.width === width && canvas.height === height) return;
  [canvas.width, canvas.height] = [width, height];
  attempt('Resize', width, height);
}

/** Waits for the frame without holding the page up; the next one starts after it. */
function awaitFrame(gl, fence) {
  if (gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.UNSIGNALED && !gl.isContextLost()) {
    setTimeout(awaitFrame, 1, gl, fence);
    return;
  }
  gl.deleteSync(fence);
  drawing = false;
}

function onFrame() {
  if (stopped) return;
  requestAnimationFrame(onFrame);
  if (drawing) return;
  fitCanvas();
  const drawn = core._vtPage_Tick(page);
  if (drawn < 0) showError(core.UTF8ToString(call('Error')));
  if (drawn !== 1) return;
  drawing = true;
  const gl = canvas.getContext('webgl2');
  const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
  gl.flush();
  awaitFrame(gl, fence);
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
  const problem = core.UTF8ToString(core._vtPage_Error(page));
  if (problem !== '') {
    showError(problem);
    return;
  }
  viewer = core._vtPage_Viewer(page);
  const resetView = () => call('ResetView', canvas.width / canvas.height);
  attempt('SetShape', 'knot');
  attempt('SetEnvironment', 'studio');
  fitCanvas();
  resetView();
  listenToInput(canvas, call, resetView);
  requestAnimationFrame(onFrame);
  const info = () => JSON.parse(core.UTF8ToString(call('Info')));
  const setView = (...numbers) => attempt('SetView', ...numbers); // eye x, y, z, target x, y, z, degrees
  window.vitrine = { image, info, setView, isIdle: () => !drawing }; // for the console and the tests
}

main().catch((reason) => showError(`The renderer cannot be loaded: ${reason.message}`));
