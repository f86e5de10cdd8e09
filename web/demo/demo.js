// The demo page: a store of what is shown, viewers that show it, controls that change it, an address that keeps it.
import { VitrineViewer } from '../element/vitrine-viewer.js';
import { buildControls } from './controls.js';
import { PathOverlay } from './path.js';
import { Store, defaults, extraEnvironments, extraModels, loadExtraModels, objectsOf, peels, readState, reference, reliefState, scenes, techniqueFor, techniques, writeState } from './state.js';
import { Wipe } from './wipe.js';

const element = (id) => document.getElementById(id);
await loadExtraModels();
const { state: asked, problems } = readState(location.search);
const store = new Store(asked);
const files = new Map(); // names of the visitor's own files, by their object URLs
const before = new Map(); // what an object URL took the place of: shown again should the file be bad
let noteTimer = 0;

/** A sentence that says what was done, and goes away, or what is being done, and stays. @param {number} stays milliseconds */
function note(text, stays = 4000) {
  element('note').textContent = text;
  clearTimeout(noteTimer);
  if (stays < Infinity) noteTimer = setTimeout(() => (element('note').textContent = ''), stays);
}

function showError(text) {
  element('error').firstElementChild.textContent = text;
  element('error').hidden = text === '';
}

// ------------------------------------------------------------------------------------------------- viewers

/** What both viewers of a comparison have in common, as attributes; null: absent. */
function attributesOf(state) {
  const objects = objectsOf(state), isRelief = state.model === 'relief';
  return {
    src: objects === null && !isRelief ? (extraModels.get(state.model)?.url ?? state.model) : null,
    objects,
    relief: isRelief ? state.relief : null,
    'relief-depth': isRelief ? state.depth : null,
    'relief-slab': isRelief ? state.slab : null,
    'relief-smooth': isRelief && files.has(state.relief) ? state.smooth : null,
    'environment-image': extraEnvironments.get(state.environment)?.url ?? state.environment,
    'skybox-image': state.backdrop ? '' : null,
    ground: state.ground ? '' : null,
    ior: objects === null ? state.ior : null,
    roughness: state.roughness || null, // 0: as the objects are
    dispersion: state.dispersion || null,
    preset: state.preset,
    layers: state.layers || null,
    steps: state.steps || null,
    'max-events': state.events || null,
    exposure: Number((2 ** state.exposure).toPrecision(6)),
    'tone-mapping': state.tone,
    output: state.output,
    layer: state.layer,
    quality: state.quality,
    'camera-target': state.target,
    'field-of-view': `${state.fov}deg`,
  };
}

function setAttributes(viewer, attributes) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null) viewer.removeAttribute(name);
    else if (viewer.getAttribute(name) !== String(value)) viewer.setAttribute(name, value);
  }
}

const left = document.createElement('vitrine-viewer');
let cameraOrbit = null, cameraTarget = null; // as the camera itself told last: these need not be set
let placed = ''; // orbit and target as set last

function orbitText() {
  const { theta, phi, radius } = left.getCameraOrbit();
  const degrees = (radians) => Number(((radians * 180) / Math.PI).toFixed(3));
  return `${degrees(theta)}deg ${degrees(phi)}deg ${Number(radius.toPrecision(6))}m`;
}

function targetText() {
  const target = left.getCameraTarget?.();
  return target ? [target.x, target.y, target.z].map((value) => `${Number(value.toPrecision(6))}m`).join(' ') : store.state.target;
}

/**
 * The distance at which the whole object is seen with some room around it, in % of the one that fills the stage.
 * @param {number} fov degrees
 */
function roomyDistance(fov) {
  const { width, height } = element('stage').getBoundingClientRect();
  const half = Math.tan((fov * Math.PI) / 360);
  const up = 0.86;
  const widest = Math.min(1.35, width / height); // of the objects worth a thought
  const share = Math.min(up, width / height / widest);
  const sine = (tangent) => Math.sin(Math.atan(tangent));
  return Math.round((100 * sine(half)) / sine(share * half));
}

/** As the element takes it: the page's own idea of an automatic distance. */
function orbitAttribute({ orbit, fov }) {
  return orbit.endsWith('auto') ? orbit.replace(/auto$/, `${roomyDistance(fov)}%`) : orbit;
}

function showLeft(state) {
  const attributes = { ...attributesOf(state), technique: state.technique, 'auto-rotate': state.rotate ? '' : null };
  attributes.alt = state.model === 'relief' ? `${files.get(state.relief) ?? state.relief} as relief glass`
    : `${files.get(state.model) ?? scenes.get(state.model)?.title ?? state.model}, in glass`;
  const isPlaced = state.orbit !== cameraOrbit || state.target !== cameraTarget;
  if (isPlaced) attributes['camera-orbit'] = orbitAttribute(state);
  else delete attributes['camera-target'];
  setAttributes(left, attributes);
  if (!isPlaced || `${state.orbit} ${state.target}` === placed) return;
  placed = `${state.orbit} ${state.target}`;
  queueMicrotask(() => left.resetView()); // the attribute may be as it was, with the camera elsewhere
}

/** Where the camera is, for the viewer that follows; an automatic distance is the same for both. */
function followedOrbit(state) {
  if (!left.loaded) return orbitAttribute(state);
  return state.orbit.endsWith('auto') ? orbitText().replace(/\S+$/, orbitAttribute(state).split(' ')[2]) : orbitText();
}

const wipe = new Wipe({ stage: element('stage'), right: element('right'), cut: element('cut'), divider: element('divider'), store });
const path = new PathOverlay({ svg: element('path'), list: element('path-list'), hint: element('path-hint'), viewer: left, stage: element('stage') });

function showComparison(state) {
  const technique = techniques.find(({ id }) => id === state.compare);
  if (technique) {
    const orbit = followedOrbit(state);
    wipe.showViewer((viewer) => setAttributes(viewer, {
      ...attributesOf(state), technique: technique.id, output: state.output.startsWith('layer') && !peels(technique.id) ? 'picture' : state.output,
      'camera-orbit': orbit, alt: `The same, ${technique.name}`,
    }));
  } else if (state.compare !== 'none') {
    wipe.showPicture(state.compare === 'reference' ? reference.url : state.compare);
  } else {
    wipe.hide();
  }
  const leftName = techniques.find(({ id }) => id === state.technique);
  const rightName = technique ? `${technique.name} ${technique.year}` : state.compare === 'reference' ? 'Ray-traced reference' : files.get(state.compare);
  element('left-name').textContent = `${leftName.name} ${leftName.year}`;
  const taken = pictureViews.get(state.compare);
  const isElsewhere = taken !== undefined && Object.keys(taken).some((key) => taken[key] !== state[key]);
  element('right-name').textContent = `${rightName ?? ''}${isElsewhere ? ', another view' : ''}`;
}

/** What a stored picture was taken of; Reset goes to its view while it is compared. */
const pictureViews = new Map([['reference', reference.scene]]);

function resetView() {
  const { orbit, target, fov } = pictureViews.get(store.state.compare) ?? defaults;
  store.set({ orbit, target, fov });
}

left.addEventListener('camera-change', ({ detail }) => {
  frames = 0;
  path.cameraChanged();
  if (detail?.source === 'user-interaction') {
    [cameraOrbit, cameraTarget, placed] = [orbitText(), targetText(), ''];
    store.set({ orbit: cameraOrbit, target: cameraTarget });
  }
  if (left.loaded) wipe.follow(followedOrbit(store.state), targetText(), store.state.quality);
});
left.addEventListener('load', () => {
  wipe.follow(followedOrbit(store.state), targetText(), store.state.quality);
  path.clear();
});
left.addEventListener('progress', ({ detail }) => {
  element('progress').value = detail.totalProgress;
  element('progress').classList.toggle('done', detail.totalProgress >= 1);
});
let scale = null; // detail of the last render-scale

function showScale() {
  if (scale === null) return;
  const { pixelWidth, pixelHeight, preset, layers, steps, maxEvents, renderedDpr, reportedDpr } = scale;
  const share = Math.round((100 * renderedDpr) / Math.min(2, reportedDpr ?? window.devicePixelRatio));
  const { uses } = techniques.find(({ id }) => id === store.state.technique);
  const search = Object.entries({ layers, steps, events: maxEvents }).filter(([id]) => uses.includes(id)).slice(0, 2).map(([id, count]) => ` · ${count} ${id}`).join('');
  element('size').textContent = `${pixelWidth} × ${pixelHeight}${share < 100 ? ` (${share} %)` : ''}${search}`;
  element('size').title = `preset ${preset}, ${maxEvents} events`;
}

left.addEventListener('render-scale', ({ detail }) => {
  const { layers, steps, maxEvents, reason } = (scale = detail);
  showScale();
  const { resolved } = store.state;
  const isSame = resolved.layers === layers && resolved.steps === steps && resolved.events === maxEvents;
  if (reason !== 'frame-time' && !isSame) store.set({ resolved: { layers, steps, events: maxEvents } });
});
left.addEventListener('frame', ({ detail }) => {
  if (detail?.milliseconds > 0) element('time').textContent = `${detail.milliseconds.toFixed(detail.milliseconds < 100 ? 1 : 0)} ms`;
});
left.addEventListener('error', ({ detail }) => {
  let sentence = detail.sourceError.message;
  for (const [url, name] of files) {
    const id = url.split('/').pop();
    if (!sentence.includes(id)) continue;
    sentence = sentence.replaceAll(id, name);
    note('');
    if (detail.type !== 'loadfailure') continue;
    store.set(before.get(url) ?? {});
    forgetFile(url);
  }
  element('progress').classList.add('done');
  showError(sentence);
});

// --------------------------------------------------------------------------------------------------- files

/** What a dropped file is: a picture is the relief while relief glass is shown, else the surroundings. */
function kindOf({ name, type }) {
  if (/\.pfm$/i.test(name)) return 'relief';
  const isPicture = type.startsWith('image/') || /\.(hdr|png|jpe?g)$/i.test(name);
  return !isPicture ? 'model' : store.state.model === 'relief' ? 'relief' : 'environment';
}

/** A file that was refused is no choice. */
function forgetFile(url) {
  files.delete(url);
  for (const choice of document.querySelectorAll(`[data-url="${url}"], [value="${url}"]`)) (choice.closest('label') ?? choice).remove();
}

function openFile(file, kind = kindOf(file)) {
  const url = URL.createObjectURL(file);
  files.set(url, file.name);
  showError('');
  const { state } = store;
  if (kind === 'model') {
    before.set(url, { model: state.model, technique: state.technique, iors: state.iors, orbit: state.orbit, target: state.target });
    store.set({ model: url, technique: techniqueFor(url, state.technique), iors: '', orbit: defaults.orbit, target: defaults.target });
  } else if (kind === 'relief') {
    const { model, technique, relief, depth, smooth } = state;
    before.set(url, { model, technique, relief, depth, smooth });
    store.set({ model: 'relief', technique: model === 'relief' ? technique : techniqueFor('relief', technique), ...reliefState(url, file.name) });
  } else {
    before.set(url, { environment: state.environment });
    store.set({ environment: url });
  }
  note(kind === 'relief' ? `${file.name} is the relief` : `Opened ${file.name}`);
}

async function comparePicture(blob, name) {
  const isPicture = await createImageBitmap(blob).then(() => true, () => false);
  showError(isPicture ? '' : `${name}: no picture that this browser can decode; save it as PNG, JPEG or WebP`);
  if (!isPicture) return;
  const url = URL.createObjectURL(blob);
  files.set(url, name);
  const { model, relief, depth, slab, smooth, environment, ior, iors, roughness, dispersion, exposure, tone, orbit, target, fov } = store.state;
  pictureViews.set(url, { model, relief, depth, slab, smooth, environment, ior, iors, roughness, dispersion, exposure, tone, orbit, target, fov });
  store.set({ compare: url });
}

function listenToDrops() {
  const { body } = document;
  let depth = 0; // dragenter and dragleave come for every child
  const drag = (step) => (event) => {
    event.preventDefault();
    depth = step === 0 ? 0 : depth + step;
    body.classList.toggle('dropping', depth > 0);
  };
  document.addEventListener('dragenter', drag(1));
  document.addEventListener('dragleave', drag(-1));
  document.addEventListener('dragover', (event) => event.preventDefault());
  document.addEventListener('drop', (event) => {
    drag(0)(event);
    const [file] = event.dataTransfer.files;
    if (file) openFile(file);
  });
}

const samplesSaved = 16; // the element draws those that are missing at once, and the page would stand still
let frames = 0; // with nothing changed between them: samples of one picture
left.addEventListener('frame', () => ++frames);

/** Until the picture at rest has its samples; not where none come. */
async function awaitSamples() {
  const wanted = Math.min(samplesSaved, left.samples);
  const patience = 5000; // milliseconds for one
  const isComing = () => frames < wanted && store.state.output === 'picture' && !store.state.rotate && !document.hidden;
  for (let last = frames, since = performance.now(); isComing() && performance.now() - since < patience;) {
    element('progress').value = frames / wanted;
    await new Promise((done) => setTimeout(done, 50));
    if (frames !== last) [last, since] = [frames, performance.now()];
  }
}

async function savePicture() {
  const progress = element('progress'), button = element('save');
  note('Drawing the picture…', Infinity);
  progress.setAttribute('aria-label', 'Saving');
  progress.classList.remove('done');
  button.disabled = true;
  try {
    await awaitSamples();
    progress.value = 1;
    await new Promise((done) => setTimeout(done, 50)); // it is seen
    const link = document.createElement('a');
    link.href = URL.createObjectURL(await left.toBlob());
    const { model, relief } = store.state, shown = model === 'relief' ? relief : model;
    link.download = `vitrine-${(files.get(shown) ?? shown).replace(/\.\w+$/, '')}.png`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    note(`Saved ${link.download}`);
  } catch (reason) {
    note('');
    showError(`The picture cannot be saved: ${reason.message}`);
  }
  progress.setAttribute('aria-label', 'Loading');
  progress.classList.add('done');
  button.disabled = false;
}

// ------------------------------------------------------------------------------------------------- address

let addressTimer = 0;

function keepAddress() {
  clearTimeout(addressTimer);
  addressTimer = 0;
  history.replaceState(null, '', writeState(store.state));
}

async function copyLink() {
  keepAddress();
  const { model, relief, environment } = store.state;
  const own = files.has(model) || files.has(environment) || (model === 'relief' && files.has(relief));
  try {
    await navigator.clipboard.writeText(location.href);
    note(own ? 'Link copied, without your own file' : 'Link copied');
  } catch {
    note('The link is in the address bar');
  }
}

// --------------------------------------------------------------------------------------------------- start

buildControls(store, {
  files,
  note,
  canShow: { output: 'output' in VitrineViewer.prototype, path: 'pathAt' in VitrineViewer.prototype },
  openFile,
  resetView,
  savePicture,
  copyLink,
  trace: () => path.traceCentre(),
  keepPicture: async () => comparePicture(await left.toBlob(), 'Kept picture'),
  comparePicture: (file) => comparePicture(file, file.name),
  chooseReference: () => store.set({ ...reference.scene, technique: techniqueFor(reference.scene.model, store.state.technique), compare: 'reference' }),
});
store.subscribe((state, changed) => {
  frames = 0;
  showLeft(state);
  showComparison(state);
  if (changed.has('technique')) showScale();
  if (!['orbit', 'target', 'wipe', 'theme', 'compare', 'resolved'].some((key) => changed.has(key) && changed.size <= 2)) path.clear();
  if (!addressTimer) addressTimer = setTimeout(keepAddress, 300); // browsers allow few changes a second
});
left.toggleAttribute('camera-controls', true);
left.setAttribute('touch-action', 'none');
element('left').append(left);
listenToDrops();
new ResizeObserver(() => {
  if (store.state.orbit.endsWith('auto')) left.setAttribute('camera-orbit', orbitAttribute(store.state));
}).observe(element('stage'));
element('error').lastElementChild.addEventListener('click', () => showError(''));
if (problems.length > 0) showError(problems.join('. '));
