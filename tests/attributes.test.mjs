// The element's attributes, whatever their text: each gives a value that fits or its default, with a sentence, and no
// parser throws anything but a sentence. Texts are made by chance of parts that fit and parts that do not; the numbers
// are the same each time. VITRINE_ATTRIBUTE_RUNS: how many texts (20,000; 2,000,000 where VITRINE_LONG is 1).
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { attributes, readAttribute, readAttributes } from '../web/element/attributes.js';
import { readGround } from '../web/element/ground.js';
import { builtIn, readBackground } from '../web/element/loading.js';
import { Orbit, parseFieldOfView, parseOrbit, parsePlacement, parseTarget } from '../web/element/orbit.js';

const runs = Number(process.env.VITRINE_ATTRIBUTE_RUNS ?? (process.env.VITRINE_LONG === '1' ? 2000000 : 20000));

/** Numbers from 0 to 1, by mulberry32. */
function chance(seed) {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), seed | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

const numbers = ['0', '-0', '1', '-1', '0.5', '.5', '5.', '1e3', '1e308', '1e309', '-1e309', '1e-320', 'NaN', 'Infinity', '-Infinity', '0x10', '1_000', '٣', '2147483648', '9007199254740993', '1,5', ''];
const units = ['deg', 'rad', 'm', 'cm', 'mm', '%', '', 'DEG', 'px', 'constructor', '__proto__'];
const words = ['auto', 'none', 'on', 'off', 'true', 'null', 'undefined', 'blurred:', '#f0e8d8', '#', 'sphere', 'a.png', 'http://[', '\0', '\ud800', '💎', 'constructor', '__proto__', ' '];
const gaps = [' ', ',', '  ', '\t', '\n', ';', ':', '/', '\u00a0', ''];

const small = ['0', '.25', '0.5', '1', '1e-3'];
const angles = ['deg', 'rad'], lengths = ['m', 'cm', 'mm'], plain = [''];
/** What is between the parts, and the units of each: orbits, targets, orientations, fields of view, scales, colours, suns. */
const forms = [[' ', angles, angles, [...lengths, '%']], [' ', lengths, lengths, lengths], [' ', angles, angles, angles], [' ', angles],
  [' ', plain, plain, plain], [',', plain, plain, plain], [',', ...Array(4).fill(plain)], [',', ...Array(7).fill(plain)]];

/** A text that looks like a value, for the most part; half of them have the form of one. */
function text(random) {
  const pick = (list) => list[Math.floor(random() * list.length)];
  if (random() < 0.5) {
    const [between, ...units] = pick(forms);
    return units.map((list) => (random() < 0.1 ? 'auto' : pick(random() < 0.5 ? small : numbers) + pick(list))).join(between);
  }
  const piece = () => (random() < 0.6 ? pick(numbers) + pick(units) : random() < 0.7 ? pick(words) : pick(attributes.find(({ values }) => values && random() < 0.3)?.values ?? words));
  const gap = pick(gaps);
  return Array.from({ length: 1 + Math.floor(random() * 7) }, piece).join(random() < 0.8 ? gap : pick(gaps));
}

/** What a parser gives, or null where it throws a sentence that names what was written; `fitting` counts the former. */
function sentenceOr(parse, name, given, fitting) {
  try {
    const value = parse();
    fitting[name] = (fitting[name] ?? 0) + 1;
    return value;
  } catch (reason) {
    assert.equal(reason.constructor, Error, `${name} '${given}' throws ${reason.stack}`);
    assert.ok(reason.message.startsWith(`${name} is '`), reason.message);
    return null;
  }
}

test(`each of ${runs} texts gives a value that fits or the default, with a sentence`, () => {
  const random = chance(1);
  for (let i = 0; i < runs; ++i) {
    const row = attributes[i % attributes.length], given = text(random), { value, problem } = readAttribute(row, given);
    const says = `${row.attribute}='${given}' gives ${value}: '${problem}'`;
    if (row.type === 'number' && value !== null) assert.ok(Number.isFinite(value) && value >= row.min && value <= row.max && (!row.integer || Number.isInteger(value)), says);
    if (row.type === 'number' && value === null) assert.ok(row.default === null && problem, says);
    if (row.type === 'number' && !problem) assert.equal(value, Number(given), says);
    if (row.type === 'enum') assert.ok(row.values.includes(value) || value === row.default, says);
    if (row.type === 'enum') assert.equal(problem === '', row.values.includes(given), says);
    if (problem) assert.ok(problem.startsWith(`${row.attribute} is '${given}'; it must be `), says);
  }
});

test(`orbits, targets, placements and fields of view of ${runs} texts are finite, or a sentence`, () => {
  const random = chance(2), fitting = {}, finite = (list, says) => assert.ok(list.every((value) => value === null || Number.isFinite(value)), says);
  for (let i = 0; i < runs; ++i) {
    const given = text(random), scale = random() < 0.5 ? '1 1 1' : text(random), says = `'${given}', scale '${scale}'`;
    const orbit = sentenceOr(() => parseOrbit(given), 'camera-orbit', given, fitting);
    const target = sentenceOr(() => parseTarget(given), 'camera-target', given, fitting);
    const field = sentenceOr(() => parseFieldOfView(given), 'field-of-view', given, fitting);
    if (orbit) finite([orbit.theta, orbit.phi, orbit.radius?.value ?? null], says);
    if (target) finite(target, says);
    if (field !== null) assert.ok(field >= 1 && field <= 170, says);
    const turned = sentenceOr(() => parsePlacement(given, '1 1 1'), 'orientation', given, fitting);
    const scaled = sentenceOr(() => parsePlacement('0deg 0deg 0deg', scale), 'scale', scale, fitting);
    for (const keys of [turned, scaled]) if (keys) finite(keys.split(/[=,]/).filter((part) => part !== 'rotate' && part !== 'scale').map(Number), `${says}: ${keys}`);
    const view = new Orbit();
    if (orbit) view.place(orbit);
    if (target) view.aim(target);
    view.turn(0.1, 0.1);
    view.zoom(0.9);
    finite([view.theta, view.phi, view.distance, ...view.target], says);
    assert.ok(view.phi > 0 && view.phi < Math.PI && view.distance > 0, says);
  }
  for (const name of ['camera-orbit', 'camera-target', 'field-of-view', 'orientation', 'scale']) assert.ok(fitting[name] > runs / 1000, `${fitting[name]} of ${name} fit`);
});

test(`grounds, backgrounds and built-in names of ${runs} texts fit, or a sentence is said`, () => {
  const random = chance(3);
  let colors = 0, suns = 0;
  for (let i = 0; i < runs; ++i) {
    const given = text(random), sun = text(random), { ground, problems } = readGround({ ground: true, groundColor: given, sun, shadowIntensity: null, shadowSoftness: 0 });
    const floats = ground.map(Math.fround), says = `ground-color='${given}', sun='${sun}' give ${floats}`;
    const isGiven = sun !== '' && !problems.some((problem) => problem.startsWith('sun'));
    assert.ok(floats.length === 14 && floats.every(Number.isFinite), says);
    assert.equal(Math.hypot(...floats.slice(7, 10)) > 0, isGiven, says);
    colors += floats[3];
    suns += isGiven;
    assert.ok(problems.every((problem) => /^(ground-color|sun) is '/.test(problem)), `${problems}`);
    const back = readBackground(given);
    if (back) assert.ok(back.kind >= 0 && back.kind <= 4 && back.blur >= 1 && back.blur <= 90 && back.color.every((part) => part >= 0 && part <= 1), `background='${given}'`);
    for (const kind of ['model', 'relief', 'environment', 'background']) builtIn(kind, given);
  }
  assert.ok(colors > runs / 1000 && suns > runs / 1000, `${colors} colours of grounds, ${suns} suns fit`);
});

test('an element whose attributes are all nonsense has values all the same', () => {
  const random = chance(4);
  for (let i = 0; i < 300; ++i) {
    const { values, problems } = readAttributes({ getAttribute: () => (random() < 0.3 ? null : text(random)) });
    assert.deepEqual(Object.keys(values), attributes.map(({ property }) => property));
    assert.ok(problems.every((problem) => problem.includes('; it must be ')));
  }
});
