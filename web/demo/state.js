// What the page shows, as one flat object, and the same as an address. Only what differs from the defaults is
// written, so that a link stays short; every value read is checked, and a bad one is answered with a sentence.

/** The ladder, as `vitrine list` has it; `uses` names the sliders that a technique heeds. */
export const techniques = [
  { id: 'kay-linear', name: 'Kay, linear', year: 1979, uses: ['layers'], summary: 'Surfaces blended back to front, the same transmittance everywhere. No refraction.' },
  { id: 'kay-nonlinear', name: 'Kay, nonlinear', year: 1979, uses: ['layers'], summary: 'Less transparent where the surface turns away, with highlights. No refraction.' },
  { id: 'kay-thickness', name: 'Kay, thickness', year: 1979, uses: ['layers', 'ior'], summary: 'Every surface is a thin wall that shifts what lies behind it.' },
  { id: 'single', name: 'Single interface', year: 2003, uses: ['ior'], summary: 'One refraction at the first surface, then the surroundings. What most engines ship.' },
  { id: 'wyman', name: 'Wyman', year: 2005, uses: ['ior'], summary: 'Two refractions, the distance between them guessed from two known ones.' },
  { id: 'oliveira', name: 'Oliveira & Brauwers', year: 2007, uses: ['ior', 'steps'], summary: 'Two refractions, the back side found by a search in its depth.' },
  { id: 'layered', name: 'Layered', year: 2014, uses: ['ior', 'layers', 'steps', 'events'], summary: 'Peeled layers searched for every refraction and total reflection.' },
  { id: 'exact', name: 'Exact', year: 2026, uses: ['ior', 'roughness', 'dispersion', 'events'], summary: 'Rays walk a hierarchy of the triangles: every meeting with the glass is where it is, reflections included.' },
  { id: 'heightfield', name: 'Height field', year: 2008, uses: ['ior', 'roughness', 'dispersion', 'events'], summary: 'As exact, but a relief by its heights alone: no triangles.' },
];

/** Whether a technique peels layers from the eye, which can be shown. */
export const peels = (id) => !['single', 'exact', 'heightfield'].includes(id);

export const shapes = ['knot', 'sphere', 'torus', 'goblet', 'bottle', 'diamond'];

/**
 * Scenes of several objects, by id. `name` is what the gallery has room for; an object with an index of refraction is
 * glass and gets a slider; `state`: what else choosing the scene sets.
 */
export const scenes = new Map([
  ['behind', {
    title: 'Knot behind a cube', name: 'Behind', picture: 'pictures/behind.png', // Wang & Chi 2014, figure 3.33
    objects: [{ name: 'Cube', spec: 'cube', ior: 1.5 }, { name: 'Knot', spec: 'knot:at=0,0,-2', ior: 1.5 }],
    state: { environment: 'studio', orbit: '12deg 82deg auto', target: '0m -0.15m auto' },
  }],
  ['tumbler', {
    title: 'Water in a tumbler', name: 'Tumbler', picture: 'pictures/tumbler.png',
    objects: [{ name: 'Tumbler', spec: 'tumbler', ior: 1.5 }, { name: 'Water', spec: 'water', ior: 1.333 }, { name: 'Backdrop', spec: 'plane:checker=24,scale=4,at=0,0,-3' }],
    state: { environment: 'studio', orbit: '10deg 76deg auto' },
  }],
  ['relief', { title: 'Relief glass', name: 'Relief', picture: 'pictures/relief.png', state: { environment: 'sky', orbit: '-14deg 80deg auto' } }],
]);

/** Built-in reliefs with their own depths, as `vitrine list` and vtReliefPatternDepth have them. */
export const patterns = [
  { id: 'ripples', name: 'Ripples', depth: 0.05 },
  { id: 'hammered', name: 'Hammered', depth: 0.05 },
  { id: 'fluted', name: 'Fluted', depth: 0.04 },
  { id: 'lens-array', name: 'Lenses', depth: 0.06 },
];

/** What of the state says something to relief glass only. */
export const reliefKeys = ['relief', 'depth', 'slab', 'smooth'];
const depthOf = (relief) => patterns.find(({ id }) => id === relief)?.depth ?? 0.1;

/** What choosing a relief sets; steps of 8 bits show in glass unless they are smoothed. @param {string} name of a file */
export const reliefState = (relief, name = relief) => ({ relief, depth: depthOf(relief), smooth: /\.(hdr|pfm)$/i.test(name) ? 0 : 2 });

/** `exact` draws models as `heightfield` does reliefs: one takes the place of the other, any other technique stays. */
const usualTechnique = (model) => (model === 'relief' ? 'heightfield' : 'exact');
export const techniqueFor = (model, technique) => (['exact', 'heightfield'].includes(technique) ? usualTechnique(model) : technique);

/** The glass of a scene with the indices in force, in order. @returns {{name: string, ior: number}[]} */
export function glassOf({ model, iors }) {
  const own = iors === '' ? [] : iors.split(',').map(Number);
  const glass = scenes.get(model)?.objects?.filter(({ ior }) => ior !== undefined) ?? [];
  return glass.map(({ name, ior }, i) => ({ name, ior: own[i] ?? ior }));
}

/** A scene as the attribute `objects` takes it; null: the model is none. */
export function objectsOf(state) {
  const glass = glassOf(state);
  const write = ({ spec, ior }) => (ior === undefined ? spec : `${spec}${spec.includes(':') ? ',' : ':'}ior=${glass.shift().ior}`);
  return scenes.get(state.model)?.objects?.map(write).join('; ') ?? null;
}

export const environments = ['studio', 'sky', 'checker'];
export const qualities = ['auto', 'high', 'medium', 'low'];
export const outputs = ['picture', 'analysis', 'layer-depth', 'layer-normal'];
export const tones = ['none', 'neutral', 'aces', 'agx'];
export const presets = ['low', 'medium', 'high'];
/** Some of those that `vitrine list` has; dispersion is 20 over the Abbe number. */
export const glasses = [
  { id: 'water', name: 'Water', ior: 1.333, dispersion: 20 / 55.76 },
  { id: 'crown', name: 'Crown glass', ior: 1.517, dispersion: 20 / 64.17 },
  { id: 'flint', name: 'Flint', ior: 1.62, dispersion: 20 / 36.37 },
  { id: 'sapphire', name: 'Sapphire', ior: 1.768, dispersion: 20 / 72.31 },
  { id: 'diamond', name: 'Diamond', ior: 2.417, dispersion: 20 / 55.3 },
].map((glass) => ({ ...glass, dispersion: Number(glass.dispersion.toFixed(3)) }));

/** The stored picture, and the scene it was traced from (pictures/make.sh). */
export const reference = {
  url: 'pictures/reference.png',
  scene: { model: 'knot', environment: 'sky', backdrop: true, ground: false, ior: 1.5, iors: '', roughness: 0, dispersion: 0, exposure: 0, tone: 'none', fov: 45, orbit: '30deg 72deg 3.4m', target: '0m 0m 0m', rotate: false, output: 'picture' },
};

export const defaults = {
  model: 'knot', relief: 'ripples', depth: 0.05, slab: 0.1, smooth: 2, environment: 'sky', backdrop: true, ground: false,
  technique: 'exact', compare: 'none', wipe: 50,
  ior: 1.5, iors: '', roughness: 0, dispersion: 0, preset: 'medium', layers: 0, steps: 0, events: 0, quality: 'auto', // 0: as the preset says
  output: 'picture', layer: 0, exposure: 0, tone: 'neutral', fov: 45, rotate: false,
  orbit: 'auto auto auto', target: 'auto auto auto', theme: 'auto',
};

/** Two of them follow what is shown. */
const defaultsOf = ({ model, relief }) => ({ ...defaults, depth: depthOf(relief), technique: usualTechnique(model) });

const ids = techniques.map(({ id }) => id);
const oneOf = (values) => (text) => (values.includes(text) ? [text] : [null, `must be one of ${values.join(', ')}`]);
const number = (min, max, whole = false) => (text) => {
  const value = text.trim() === '' ? NaN : Number(text);
  const fits = value >= min && value <= max && (!whole || Number.isInteger(value));
  return fits ? [value] : [null, `must be a ${whole ? 'whole ' : ''}number from ${min} to ${max}`];
};
const numbers = (min, max) => (text) => {
  const fits = text === '' || text.split(',').every((part) => number(min, max)(part)[1] === undefined);
  return fits ? [text] : [null, `must be numbers from ${min} to ${max} between commas`];
};
const flag = (text) => (/^[01]$/.test(text) ? [text === '1'] : [null, 'must be 0 or 1']);
const words = (unit) => (text) => {
  const word = String.raw`(auto|[-+]?\d*\.?\d+(e[-+]?\d+)?(${unit}))`;
  return new RegExp(`^${word} ${word} ${word}$`).test(text) ? [text] : [null, `must be three of auto or a number with ${unit.replaceAll('|', ', ')}`];
};
const readers = {
  model: (text) => oneOf([...shapes, ...scenes.keys(), ...extraModels.keys()])(text), environment: (text) => oneOf([...environments, ...extraEnvironments.keys()])(text), backdrop: flag, ground: flag,
  relief: oneOf(patterns.map(({ id }) => id)), depth: number(0, 10), slab: number(0.001, 10), smooth: number(0, 64),
  technique: oneOf(ids), compare: oneOf(['none', 'reference', ...ids]), wipe: number(0, 100),
  ior: number(1, 4), iors: numbers(1, 4), roughness: number(0, 1), dispersion: number(0, 20), preset: oneOf(presets), layers: number(0, 16, true), steps: number(0, 1000, true), events: number(0, 64, true), quality: oneOf(qualities),
  output: oneOf(outputs), layer: number(0, 15, true), exposure: number(-10, 10), tone: oneOf(tones), fov: number(1, 170), rotate: flag,
  orbit: words('deg|rad|m|cm|mm|%'), target: words('m|cm|mm'), theme: oneOf(['auto', 'dark', 'light']),
};

/** Models beside the built-in shapes, by id: {title, url, picture}. See models.mjs. */
export const extraModels = new Map();
export const extraEnvironments = new Map();

/** Fetches what the build made; a page built without goes without. */
export async function loadExtraModels() {
  const response = await fetch('assets/index.json').catch(() => null);
  if (!response?.ok) return;
  const { models, environments: more = [] } = await response.json();
  for (const { id, ...rest } of models) extraModels.set(id, rest);
  for (const { id, ...rest } of more) extraEnvironments.set(id, rest);
}

/**
 * `resolved`: what the settings are that the preset decides, as the viewer says.
 * @param {string} search of the address @returns {{state: object, problems: string[]}}
 */
export function readState(search) {
  const given = {}, problems = [];
  for (const [key, text] of new URLSearchParams(search)) {
    if (!Object.hasOwn(readers, key)) continue; // somebody else's
    const [value, problem] = readers[key](text);
    if (problem) problems.push(`${key} is '${text}'; it ${problem}`);
    else given[key] = value;
  }
  const state = { ...defaultsOf({ ...defaults, ...given }), ...given, resolved: { layers: 4, steps: 50, events: 8 } };
  if (state.output.startsWith('layer') && !peels(state.technique)) state.technique = 'layered';
  return { state, problems };
}

/** @returns {string} what readState makes the same state from; files of the visitor's own have no address */
export function writeState(state) {
  const query = new URLSearchParams();
  for (const [key, value] of Object.entries(defaultsOf(state))) {
    const now = state[key];
    if (now === value || (reliefKeys.includes(key) && state.model !== 'relief')) continue;
    const text = typeof now === 'boolean' ? String(Number(now)) : String(now);
    if (readers[key](text)[1] === undefined) query.set(key, text);
  }
  const text = query.toString();
  return text === '' ? location.pathname : `?${text}`;
}

/** Holds a state; whoever subscribes hears of changes, with the names of what changed. */
export class Store {
  #listeners = [];

  constructor(state) {
    this.state = state;
  }

  set(patch) {
    const changed = new Set(Object.keys(patch).filter((key) => patch[key] !== this.state[key]));
    if (changed.size === 0) return;
    this.state = { ...this.state, ...patch };
    for (const listener of this.#listeners) listener(this.state, changed);
  }

  subscribe(listener) {
    this.#listeners.push(listener);
    listener(this.state, new Set(Object.keys(this.state)));
  }
}
