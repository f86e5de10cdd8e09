// The panel and the gallery: everything a visitor can set, in step with the store.
import { environments, extraEnvironments, extraModels, glassOf, glasses, outputs, patterns, peels, presets, qualities, reliefState, scenes, shapes, techniqueFor, techniques, tones } from './state.js';

const element = (id) => document.getElementById(id);
const capital = (text) => text[0].toUpperCase() + text.slice(1);
const outputNames = { picture: 'Picture', analysis: 'Paths', 'layer-depth': 'Depth', 'layer-normal': 'Normals' };
const toneNames = { none: 'None', neutral: 'Neutral', aces: 'ACES', agx: 'AgX' };
const themeNames = { auto: 'System', dark: 'Dark', light: 'Light' };

/** Colours of present.frag, in words. */
const legends = {
  analysis: [['two', 'two refractions'], ['more', 'more'], ['total', 'total reflection'], ['lost', 'lost']],
  'layer-depth': [['near', 'near'], ['far', 'far'], ['none', 'no surface']],
};

const sliders = {
  depth: (value) => value.toFixed(3),
  slab: (value) => value.toFixed(2),
  smooth: (value) => `${value} samples`,
  ior: (value) => value.toFixed(3),
  roughness: (value) => value.toFixed(2),
  dispersion: (value) => value.toFixed(2),
  layers: String,
  steps: String,
  events: String,
  layer: (value) => String(value + 1),
  exposure: (value) => `${value > 0 ? '+' : ''}${value.toFixed(1)} EV`,
  fov: (value) => `${Math.round(value)}°`,
};
const checks = ['backdrop', 'ground', 'rotate'];

function create(name, properties, ...children) {
  const node = Object.assign(document.createElement(name), properties);
  node.append(...children);
  return node;
}

/** Radio buttons that look like one control. */
function addSegment(id, value, name, onChoose) {
  const input = create('input', { type: 'radio', name: id, value });
  input.addEventListener('change', () => onChoose(value));
  element(id).append(create('label', { className: 'segment' }, input, create('span', { textContent: name })));
  return input;
}

function choose(id, value) {
  for (const input of element(id).querySelectorAll('input')) input.checked = input.value === value;
}

function addShape(url, name, picture, onChoose, title = name) {
  const image = picture ? create('img', { src: picture, alt: '', width: 56, height: 56, draggable: false }) : create('span', { className: 'blank', textContent: '.glb' });
  const button = create('button', { type: 'button', className: 'shape' }, image, create('span', { className: 'name', textContent: name }));
  button.setAttribute('aria-label', title); // low windows show the picture alone
  if (title !== name) button.title = title;
  button.dataset.url = url;
  button.addEventListener('click', () => onChoose(url));
  element('gallery').append(button);
  return button;
}

/**
 * @param {import('./state.js').Store} store
 * @param {object} page what the buttons do, and what the viewer can
 */
export function buildControls(store, page) {
  const chooseModel = (model) => {
    const technique = techniqueFor(model, store.state.technique);
    store.set({ model, technique, iors: '', orbit: 'auto auto auto', target: 'auto auto auto', ...scenes.get(model)?.state });
  };
  for (const { id, name } of patterns) addSegment('relief', id, name, (relief) => store.set(reliefState(relief)));
  for (const shape of shapes) addShape(shape, capital(shape), `pictures/${shape}.png`, chooseModel);
  for (const [id, { title, name, picture }] of scenes) addShape(id, name, picture, chooseModel, title);
  for (const [id, { title, picture }] of extraModels) addShape(id, title, picture, chooseModel);
  for (const { id, name, ior, dispersion } of glasses) {
    const button = create('button', { type: 'button', className: 'chip', textContent: name });
    button.dataset.glass = id;
    button.addEventListener('click', () => store.set({ ior, dispersion }));
    element('glasses').append(button);
  }
  fillTechniques(store, page);
  for (const value of presets) addSegment('preset', value, capital(value), (preset) => store.set({ preset, layers: 0, steps: 0, events: 0 }));
  for (const value of qualities) addSegment('quality', value, capital(value), (quality) => store.set({ quality }));
  const named = [...environments.map((id) => [id, capital(id)]), ...[...extraEnvironments].map(([id, { title }]) => [id, title])];
  for (const [value, title] of named) addSegment('environment', value, title, (environment) => store.set({ environment }));
  for (const value of outputs) {
    const input = addSegment('output', value, outputNames[value], (output) => showOutput(output, store, page));
    input.disabled = value !== 'picture' && !page.canShow.output;
  }
  for (const value of tones) addSegment('tone', value, toneNames[value], (tone) => store.set({ tone }));
  for (const [value, name] of Object.entries(themeNames)) addSegment('theme', value, name, (theme) => store.set({ theme }));

  for (const id of Object.keys(sliders)) {
    element(id).addEventListener('input', ({ target }) => store.set({ [id]: Number(target.value) }));
  }
  for (const id of checks) element(id).addEventListener('change', ({ target }) => store.set({ [id]: target.checked }));
  element('trace').disabled = !page.canShow.path;
  const buttons = { reset: page.resetView, save: page.savePicture, link: page.copyLink, keep: page.keepPicture, trace: page.trace };
  for (const [id, act] of Object.entries(buttons)) element(id).addEventListener('click', act);
  const pickers = {
    'model-file': (file) => page.openFile(file, 'model'),
    'image-file': (file) => page.openFile(file, 'environment'),
    'relief-file': (file) => page.openFile(file, 'relief'),
    'picture-file': page.comparePicture,
  };
  for (const [id, act] of Object.entries(pickers)) {
    element(id).addEventListener('change', ({ target }) => {
      if (target.files.length > 0) act(target.files[0]);
      target.value = ''; // the same file can be chosen again
    });
  }
  showMoreOf(element('gallery'));
  element('fold').addEventListener('click', () => fold(element('fold').getAttribute('aria-expanded') === 'true'));
  element('controls').addEventListener('submit', (event) => event.preventDefault());
  store.subscribe((state) => show(state, page.files, chooseModel, store));
  document.body.classList.add('ready');
}

/** Buttons at both ends of a strip that is wider than its place, each while there is more on its side. */
function showMoreOf(strip) {
  const [left, right] = ['left', 'right'].map((side) => strip.parentElement.querySelector(`.onward.${side}`));
  const update = () => {
    left.hidden = strip.scrollLeft < 2;
    right.hidden = strip.scrollLeft + strip.clientWidth > strip.scrollWidth - 2;
  };
  for (const [button, step] of [[left, -0.7], [right, 0.7]]) {
    button.addEventListener('click', () => strip.scrollBy({ left: step * strip.clientWidth }));
  }
  strip.addEventListener('scroll', update);
  new ResizeObserver(update).observe(strip);
  new MutationObserver(update).observe(strip, { childList: true });
}

/** A slider for each object of glass, where there are several. */
function showGlass(state, store) {
  const list = element('objects'), glass = glassOf(state);
  list.hidden = glass.length === 0;
  element('one-glass').hidden = glass.length > 0;
  if (list.dataset.model !== state.model) {
    list.dataset.model = state.model;
    list.replaceChildren(create('legend', { textContent: 'Index of refraction' }), ...glass.map(({ name }, i) => {
      const id = `object-${i}`;
      const input = create('input', { id, type: 'range', min: 1, max: 2.6, step: 0.001 });
      input.addEventListener('input', () => {
        const iors = glassOf(store.state).map(({ ior }, k) => (k === i ? Number(input.value) : ior));
        store.set({ iors: iors.join() });
      });
      const label = create('label', { htmlFor: id, textContent: name });
      return create('div', { className: 'slider' }, label, create('output', { id: `${id}-value`, htmlFor: id }), input);
    }));
  }
  glass.forEach(({ ior }, i) => {
    const input = element(`object-${i}`), text = sliders.ior(ior);
    if (Number(input.value) !== ior) input.value = ior;
    element(`object-${i}-value`).textContent = text;
    input.setAttribute('aria-valuetext', text);
    input.style.setProperty('--share', shareOf(input, ior));
  });
}

/** Where a slider's value lies between its ends. */
function shareOf({ min, max }, value) {
  return Math.max(0, (Math.min(max, value) - min) / (max - min || 1)).toFixed(4);
}

const isLayer = (output) => output.startsWith('layer');

function showOutput(output, store, page) {
  const { technique } = store.state;
  const isElsewhere = isLayer(output) && !peels(technique);
  const isBack = !isLayer(output) && page.techniqueBefore && technique === 'layered';
  store.set({ output, technique: isElsewhere ? 'layered' : isBack ? page.techniqueBefore : technique });
  if (isElsewhere || isBack) page.techniqueBefore = isElsewhere ? technique : null;
  if (isElsewhere) page.note('The technique is now Layered, whose layers these are');
}

function fillTechniques(store, page) {
  const option = ({ id, name, year }) => new Option(`${name} · ${year}`, id);
  element('technique').append(...techniques.map(option).reverse());
  const ladder = create('optgroup', { label: 'Another technique' }, ...techniques.map(option).reverse());
  const pictures = create('optgroup', { label: 'A stored picture', id: 'pictures' }, new Option('Ray-traced reference', 'reference'));
  element('compare').append(new Option('Nothing', 'none'), ladder, pictures);
  element('technique').addEventListener('change', ({ target: { value } }) => {
    page.techniqueBefore = null;
    store.set({ technique: value, output: isLayer(store.state.output) && !peels(value) ? 'picture' : store.state.output });
  });
  element('compare').addEventListener('change', ({ target }) => {
    if (target.value === 'reference') page.chooseReference();
    else store.set({ compare: target.value });
  });
}

function fold(isFolded) {
  document.body.classList.toggle('folded', isFolded);
  element('fold').setAttribute('aria-expanded', String(!isFolded));
}

/** The visitor's own file among the choices of a segment. */
function addFile(id, state, files, onChoose) {
  const url = state[id];
  if (!files.has(url) || element(id).querySelector(`[value="${url}"]`)) return;
  element(id).querySelector('.file')?.remove();
  addSegment(id, url, files.get(url), onChoose).parentElement.classList.add('file');
}

function showRelief({ model, relief }, files) {
  const isRelief = model === 'relief';
  element('relief-glass').hidden = !isRelief;
  element('smooth').parentElement.hidden = !files.has(relief); // patterns are smooth
  element('drop-hint').textContent = isRelief ? 'or a picture to see it as relief glass' : 'or a .hdr to light it';
}

function show(state, files, chooseModel, store) {
  if (files.has(state.model) && !element('gallery').querySelector(`[data-url="${state.model}"]`)) {
    addShape(state.model, files.get(state.model), null, chooseModel);
  }
  for (const button of element('gallery').children) button.setAttribute('aria-pressed', String(button.dataset.url === state.model));
  addFile('environment', state, files, (environment) => store.set({ environment }));
  addFile('relief', state, files, (relief) => store.set(reliefState(relief, files.get(relief))));
  if (files.has(state.compare) && !element('compare').querySelector(`[value="${state.compare}"]`)) {
    element('pictures').append(new Option(files.get(state.compare), state.compare));
  }

  for (const { id, ior } of glasses) {
    element('glasses').querySelector(`[data-glass=${id}]`).setAttribute('aria-pressed', String(Math.abs(ior - state.ior) < 0.0005));
  }
  element('layer').max = (state.layers || state.resolved.layers) - 1;
  for (const [id, word] of Object.entries(sliders)) {
    const input = element(id);
    const isOfPreset = state[id] === 0 && Object.hasOwn(state.resolved, id);
    const value = isOfPreset ? state.resolved[id] : state[id];
    const text = isOfPreset ? `${word(value)} (preset)` : word(value);
    if (Number(input.value) !== value) input.value = value;
    element(`${id}-value`).textContent = text;
    input.setAttribute('aria-valuetext', text);
    input.style.setProperty('--share', shareOf(input, value));
  }
  showGlass(state, store);
  showRelief(state, files);
  for (const id of checks) element(id).checked = state[id];
  for (const id of ['relief', 'quality', 'environment', 'tone', 'output', 'theme']) choose(id, state[id]);
  choose('preset', state.layers || state.steps || state.events ? '' : state.preset); // none: the visitor's own numbers
  element('technique').value = state.technique;
  element('compare').value = state.compare;

  const shown = techniques.filter(({ id }) => id === state.technique || id === state.compare);
  element('summary').textContent = techniques.find(({ id }) => id === state.technique).summary;
  for (const id of ['ior', 'roughness', 'dispersion', 'layers', 'steps', 'events']) {
    const isUsed = shown.some(({ uses }) => uses.includes(id)) || (id === 'layers' && isLayer(state.output));
    element(id).disabled = !isUsed;
    element(id).parentElement.classList.toggle('unused', !isUsed);
  }
  element('layer').parentElement.hidden = !isLayer(state.output);
  const legend = legends[state.output] ?? [];
  element('legend').hidden = legend.length === 0;
  element('legend').replaceChildren(...legend.map(([className, textContent]) => create('span', { className, textContent })));
  if (state.theme === 'auto') document.documentElement.removeAttribute('data-theme');
  else document.documentElement.dataset.theme = state.theme;
}
