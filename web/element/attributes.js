// The one table of what can be written on the element. Observed attributes, properties with reflection, checks
// and their sentences, and the documentation and types (scripts) all come from it. Attributes that are settings
// of a frame have the ranges and words of the core's table; tests/cli.test.mjs compares them.

/**
 * A row of the table.
 * @typedef {object} Attribute
 * @property {string} attribute as written in HTML
 * @property {string} property as named in JavaScript
 * @property {'string'|'number'|'boolean'|'enum'} type
 * @property {string|number|boolean|null} default null: `defaultText` says what then holds
 * @property {string} [defaultText]
 * @property {number} [min] of a number
 * @property {number} [max] of a number
 * @property {boolean} [integer] of a number
 * @property {string[]} [values] of an enum
 * @property {string} description one sentence
 */

/** Names that the core knows by itself; anything else in `src`, `relief` or `environment-image` is a URL. */
export const shapes = ['sphere', 'torus', 'knot', 'goblet', 'bottle', 'diamond', 'cube', 'plane', 'tumbler', 'water', 'panel'];
/** Built-in reliefs, which `src` and `objects` know, too. */
export const patterns = ['ripples', 'hammered', 'fluted', 'lens-array'];
export const environments = ['studio', 'sky', 'checker'];

const techniques = ['exact', 'heightfield', 'layered', 'oliveira', 'wyman', 'single', 'kay-thickness', 'kay-nonlinear', 'kay-linear'];

const string = (attribute, description, more) => ({ attribute, type: 'string', default: '', description, ...more });
const boolean = (attribute, description) => ({ attribute, type: 'boolean', default: false, description });
const oneOf = (attribute, values, description, more) => ({ attribute, type: 'enum', default: values[0], values, description, ...more });
const number = (attribute, min, max, value, description, more) =>
  ({ attribute, type: 'number', default: value, min, max, description, ...more });
const ofPreset = { integer: true, defaultText: "the preset's" };

/** @type {Attribute[]} */
export const attributes = [
  string('src', `URL of a .glb or .gltf, or a built-in shape: ${shapes.join(', ')}.`),
  string('relief', `In place of src: relief glass, a slab whose front is a height field: a built-in one, ${patterns.join(', ')}, or URL of a picture, black the lowest, white the highest; .hdr and .pfm hold more than 256 heights.`),
  number('relief-depth', 0, 10, null, 'From black to white; the longer side is 2.', { defaultText: "0.1, a built-in relief's own" }),
  number('relief-slab', 0.001, 10, 0.1, 'Thickness of the glass behind black.'),
  number('relief-smooth', 0, 64, null, 'Samples that the heights are smoothed over.', { defaultText: '2 for pictures of 8 bits, else 0' }),
  string('objects', 'More objects, or all, between ; or line breaks: NAME or NAME:key=value,key=value, NAME as in src; the keys are those of --object, see `vitrine --help`.'),
  string('alt', 'What the picture shows, for those who cannot see it.'),
  string('poster', 'URL of a picture that stands until the first frame.'),
  oneOf('loading', ['auto', 'lazy', 'eager'], 'eager: fetches at once; auto and lazy: when the element comes into view.'),
  oneOf('reveal', ['auto', 'manual'], 'manual: the poster stays until dismissPoster() is called.'),
  boolean('camera-controls', 'The view follows mouse, touch, pen and keys.'),
  string('camera-orbit', 'Azimuth (0: from +Z), angle from +Y, and distance: deg or rad, then m, cm, mm or % of the distance that shows the whole object; each may be auto.', { default: 'auto auto auto' }),
  string('camera-target', 'The point looked at, "x y z" in m, cm or mm; auto: the centre of the object.', { default: 'auto auto auto' }),
  string('field-of-view', 'Vertical, deg or rad, 1 to 170 degrees; auto: 45deg, or that of the camera.', { default: 'auto' }),
  string('min-camera-orbit', 'Least azimuth, angle and distance, as camera-orbit has them; auto: no limit but the usual.', { default: 'auto auto auto' }),
  string('max-camera-orbit', 'Greatest azimuth, angle and distance.', { default: 'auto auto auto' }),
  string('min-field-of-view', 'Least field of view.', { default: 'auto' }),
  string('max-field-of-view', 'Greatest field of view.', { default: 'auto' }),
  number('interpolation-decay', 0, 10000, 50, 'How slowly the view follows the visitor and the attributes, milliseconds; 0, or where the visitor prefers reduced motion: at once.'),
  oneOf('interaction-prompt', ['none', 'auto'], 'auto: a hand shows, with camera-controls and until somebody touches it, that the view can be turned; slot interaction-prompt takes its place.'),
  number('interaction-prompt-threshold', 0, 600000, 3000, 'When it does so after the model is shown, milliseconds.'),
  number('camera-index', 0, 255, null, 'The camera of the file that is looked through, where camera-orbit, camera-target and field-of-view are auto.', { integer: true, defaultText: 'none' }),
  boolean('auto-rotate', 'Turns slowly while nobody touches it; not where the visitor prefers reduced motion.'),
  string('environment-image', `What the glass refracts: URL of a picture, equirectangular or of six faces, or ${environments.join(', ')}.`, { default: 'studio' }),
  string('skybox-image', 'When present, the environment is shown behind the glass; its value, if any, is the environment where environment-image is absent. Absent: the page shows behind the glass.'),
  string('background', 'What is behind the scene; glass goes on showing environment-image. transparent, environment, blurred, blurred:DEGREES (1 to 90; 6), a colour as #f0e8d8, or URL of a picture that fills the element. Absent: environment with skybox-image, else transparent.'),
  string('backdrop', 'A picture that stands behind the glass, which shows it bent and goes on reflecting environment-image: URL of a picture or video, which fills the element like object-fit: cover, or #id of an img, video or canvas of the page, of which the glass shows what lies under the element. The property takes such an element, an OffscreenCanvas or an ImageBitmap, too; set again, it has changed. Its colours stay as they are: without exposure and tone-mapping. exact and heightfield.'),
  number('backdrop-distance', 0, 1e6, null, 'How far it stands behind the point looked at, in the unit of the model; 0: beyond all glass, by an eighth of its diagonal.', { defaultText: 'beyond all glass' }),
  number('exposure', 1e-6, 1e6, 1, 'Factor on the light of the picture.'),
  oneOf('tone-mapping', ['none', 'neutral', 'aces', 'agx'], 'From light to what a display shows: cut at white, Khronos PBR Neutral, the filmic curve of ACES, or AgX.', { default: 'neutral' }),
  boolean('ground', 'The ground below catches shadows and light; the sun of the environment casts shadows on opaque things of plain materials, too: exact and heightfield.'),
  string('ground-color', 'Of a matt ground, "R,G,B", linear, 0 to 1 each. Empty: what is seen of the ground is the environment.'),
  string('sun', 'Light on the ground from this direction: "X,Y,Z", where more is said ",SIZE", its diameter in degrees (0.53), and ",R,G,B", its irradiance (3,3,3). Empty: the environment\'s own.'),
  number('shadow-intensity', 0, 1, null, 'Of what is caught; above 0 it stands for ground.', { defaultText: '1 with ground, else 0' }),
  number('shadow-softness', 0, 1, 0, '0: as the lights are wide; 1: blurred.'),
  oneOf('touch-action', ['pan-y', 'pan-x', 'none'], 'What a finger does to the page rather than to the view.'),
  boolean('disable-pan', 'Right button, Shift and two fingers do not move the point looked at.'),
  boolean('disable-zoom', 'Wheel, pinch and + − keys do not change the distance.'),
  number('ior', 1, 4, null, 'Index of refraction of all glass.', { defaultText: "each object's own" }),
  number('roughness', 0, 1, null, 'Of all glass: 0 is clear, 1 frosted.', { defaultText: "each object's own" }),
  number('dispersion', 0, 20, null, 'Of all glass: 20 over its Abbe number (diamond 0.36, flint 0.55).', { defaultText: "each object's own" }),
  oneOf('fresnel', ['off', 'on'], 'on: glass reflects where it refracts, by Fresnel; off: only where it must.', { default: 'on' }),
  oneOf('walls', ['auto', 'thin', 'solid'], 'Glass of files: as the file says, or all of it thin walls or solid bodies.'),
  string('orientation', 'Of src: turned by roll, pitch and yaw, about z, x and y, in deg or rad.', { default: '0deg 0deg 0deg' }),
  string('scale', 'Of src: a factor, or one along each of x, y and z.', { default: '1 1 1' }),
  string('variant-name', 'Of the variants of materials (KHR_materials_variants) that files have; `availableVariants` lists them. Empty: the materials as they are.'),
  boolean('autoplay', 'Plays the animations of files once they are shown; not where the visitor prefers reduced motion.'),
  string('animation-name', 'Which of the animations that files have; `availableAnimations` lists them. Empty: the first of each file.'),
  oneOf('technique', techniques, 'How the glass is computed; see `vitrine list`.', { default: null, defaultText: '`exact`; `heightfield` where there is a relief' }),
  oneOf('preset', ['low', 'medium', 'high'], 'What layers, steps and max-events are where they are absent, how often exact follows what glass reflects: never, once or twice, and at how many wavelengths its first sample sees glass that disperses: one, three or three. Less work for weak GPUs, more accuracy for strong ones.', { default: 'medium' }),
  number('layers', 1, 16, null, 'Depth layers peeled, by the techniques that peel: layered and kay-….', ofPreset),
  number('steps', 1, 1000, null, 'Search steps a segment: layered and oliveira.', ofPreset),
  number('max-events', 1, 64, null, 'Refractions and internal reflections of a path.', ofPreset),
  oneOf('output', ['picture', 'analysis', 'layer-depth', 'layer-normal'], 'picture; analysis: paths by colour (red two refractions, blue more, green total reflection, grey lost); or depth or normals of one layer.'),
  number('layer', 0, 15, 0, 'Which layer is shown, 0 the nearest.', { integer: true }),
  number('samples', 1, 4096, 64, 'Samples a pixel, for smooth edges: added one a frame once the view rests. 1: a single one, and nothing is added.', { integer: true }),
  number('max-memory', 1, 2e9, null, 'Bytes that one file may take, read, unpacked and decoded.', { integer: true, defaultText: '2 GiB' }),
  number('max-triangles', 1, 1e9, null, 'Triangles of one file.', { integer: true, defaultText: '50,000,000' }),
  number('max-pixels', 1, 1e9, null, 'Pixels of an environment, a background or a relief; those of materials are scaled down to 2048 a side.', { integer: true, defaultText: '8192 × 8192' }),
  oneOf('quality', ['auto', 'high', 'medium', 'low'], 'auto: holds the frame time while moving and draws one full frame at rest; high, medium and low: always 1, 3/4 and 1/2 of the resolution.'),
].map((row) => ({ ...row, property: row.attribute.replace(/-(.)/g, (_, letter) => letter.toUpperCase()) }));

/**
 * The value that an attribute's text stands for, and a sentence where it cannot stand as it is.
 * @param {Attribute} row
 * @param {string|null} text null: absent
 * @returns {{value: string|number|boolean|null, problem: string}}
 */
export function readAttribute(row, text) {
  if (row.type === 'boolean') return { value: text !== null, problem: '' };
  if (text === null) return { value: row.default, problem: '' };
  if (row.type === 'string') return { value: text, problem: '' };
  if (row.type === 'enum') {
    const fits = row.values.includes(text);
    const problem = fits ? '' : `${row.attribute} is '${text}'; it must be one of ${row.values.join(', ')}`;
    return { value: fits ? text : row.default, problem };
  }
  const given = text.trim() === '' ? NaN : Number(text);
  const kind = row.integer ? 'a whole number' : 'a number';
  const fits = Number.isFinite(given) && given >= row.min && given <= row.max && (!row.integer || Number.isInteger(given));
  if (fits) return { value: given, problem: '' };
  const near = Math.min(row.max, Math.max(row.min, row.integer ? Math.round(given) : given));
  const value = Number.isFinite(given) ? near : row.default;
  const used = value === null ? row.defaultText : value;
  return { value, problem: `${row.attribute} is '${text}'; it must be ${kind} from ${row.min} to ${row.max}; ${used} is used` };
}

/** All values of an element, by property, and the sentences about those that cannot stand. */
export function readAttributes(element) {
  const values = {}, problems = [];
  for (const row of attributes) {
    const { value, problem } = readAttribute(row, element.getAttribute(row.attribute));
    values[row.property] = value;
    if (problem) problems.push(problem);
  }
  return { values, problems };
}

/** Gives a class the properties of the table, each reflected as its attribute. */
export function defineProperties(prototype) {
  for (const row of attributes) {
    if (Object.hasOwn(prototype, row.property)) continue; // it takes more than its attribute
    Object.defineProperty(prototype, row.property, {
      configurable: true,
      enumerable: true,
      get() {
        return readAttribute(row, this.getAttribute(row.attribute)).value;
      },
      set(value) {
        if (row.type === 'boolean') this.toggleAttribute(row.attribute, Boolean(value));
        else if (value === null || value === undefined) this.removeAttribute(row.attribute);
        else this.setAttribute(row.attribute, value);
      },
    });
  }
}

/** What a page set before the class was there becomes attributes. */
export function adoptProperties(element) {
  for (const { property } of attributes) {
    if (!Object.hasOwn(element, property)) continue;
    const value = element[property];
    delete element[property];
    element[property] = value;
  }
}
