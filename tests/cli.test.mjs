// The command line as people use it: output, options, bad input, golden images. Needs VITRINE_BINARY.
// VITRINE_UPDATE_GOLDEN=1 writes the golden images instead of comparing with them.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { deflateSync } from 'node:zlib';
import { PNG } from 'pngjs';
import * as shapes from '../scripts/glb.mjs';
import { glb, gltf } from '../scripts/glb.mjs';
import { drawPlot } from '../scripts/plot.mjs';
import { pngChunk } from './bombs.mjs';
import { goldenModels } from './golden-models.mjs';
import { moving } from './moving-model.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const binary = resolve(process.env.VITRINE_BINARY ?? join(here, '../build/release/vitrine'));
const folder = mkdtempSync(join(tmpdir(), 'vitrine-'));
after(() => rmSync(folder, { recursive: true, force: true }));

const slow = process.env.VITRINE_SANITIZE === '1';

// EGL unloads Mesa's driver before a leak checker of a sanitizer build can name its leaks; ours are checked
// with OSMesa.
const withoutLeakCheck = { ...process.env, ASAN_OPTIONS: 'detect_leaks=0' };

function vitrine(args, options = {}) {
  const result = spawnSync(binary, args, { cwd: folder, maxBuffer: 1 << 27, ...options });
  return {
    code: result.status,
    signal: result.signal,
    out: result.stdout,
    text: result.stdout.toString(),
    error: result.stderr.toString(),
  };
}

/** Runs what must fail: exit code 1, one sentence holding every part, the output file as it was. */
function refuses(args, parts, options = {}) {
  const output = join(folder, 'kept.png');
  writeFileSync(output, 'as it was');
  const before = readdirSync(folder).sort();
  const result = vitrine([...args, '-o', output], options);
  assert.equal(result.signal, null, result.error);
  assert.equal(result.code, 1, `exit code ${result.code}: ${result.error}`);
  assert.match(result.error, /^vitrine: [^\n]+\n$/, 'one sentence');
  for (const part of parts) assert.ok(result.error.includes(part), `'${part}' is not in: ${result.error}`);
  assert.equal(readFileSync(output, 'utf8'), 'as it was');
  assert.deepEqual(readdirSync(folder).sort(), before, 'no file is left behind');
}

/** A cube, changed by each case before it is written. */
const cube = () => ({ positions: [...shapes.cube.positions], indices: [...shapes.cube.indices], ior: 1.31 });

function write(name, data) {
  writeFileSync(join(folder, name), data);
  return name;
}

const small = ['--resolution', '64,64'];

describe('words', () => {
  test('help, version and list', () => {
    assert.match(vitrine(['--help']).text, /vitrine render MODEL -o OUT\.png/);
    assert.match(vitrine(['--version']).text, /^vitrine \d+\.\d+\.\d+\n$/);
    const list = vitrine(['list']).text;
    for (const word of ['kay-linear', 'kay-nonlinear', 'kay-thickness', 'single', 'wyman', 'oliveira', 'layered', 'sphere', 'torus', 'knot', 'goblet', 'bottle', 'diamond', 'checker', 'studio', 'sky', 'ripples', 'hammered', 'fluted', 'lens-array', 'moissanite     index 2.648, Abbe number 27.1; ']) {
      assert.ok(list.includes(word), word);
    }
    const help = vitrine(['render', '--help']);
    assert.equal(help.code, 0);
    for (const option of ['technique', 'layers', 'steps', 'refine', 'max-events', 'ior', 'environment', 'camera', 'target',
      'fov', 'resolution', 'directions', 'layer-sheet', 'analysis', 'rendering-backend', 'verbose', 'output']) {
      assert.ok(help.text.includes(`--${option}`), option);
    }
  });

  /** The names of a struct's fields in the public header. */
  function fieldsOf(struct) {
    const header = readFileSync(join(here, '../src/vitrine.h'), 'utf8');
    const body = header.match(new RegExp(`typedef struct ${struct} \\{([^}]*)\\} ${struct};`))[1].replace(/\/\/.*/g, '');
    return body.split(';').flatMap((line) => line.split(',').map((part) => part.match(/(\w+)\s*$/)?.[1]).filter(Boolean));
  }

  test('the table of settings has a row for every field of vtFrame', () => {
    const rows = JSON.parse(vitrine(['list', '--settings']).text);
    // Where a picture goes, and a host's view and picture: only for embedding.
    const others = ['framebuffer', 'x', 'y', 'linear', 'viewMatrix', 'projectionMatrix', 'overlay', 'hostColor', 'hostDepth', 'hostLinear', 'hostLevels', 'hostOpaque',
      'stageDone', 'stageData'];
    const wanted = fieldsOf('vtFrame').filter((field) => !others.includes(field)).flatMap((field) => (field === 'view' ? fieldsOf('vtView').map((part) => `view.${part}`) : [field]));
    assert.deepEqual(rows.map(({ field }) => field), wanted);
    for (const { name, help } of rows) assert.ok(help.length > 0, name);
    assert.match(vitrine(['list', '--all']).error, /'--all'/);
  });

  test('the element takes settings as the table has them', async () => {
    const rows = JSON.parse(vitrine(['list', '--settings']).text);
    // As a data URL it is a module for Node 18 too.
    const source = readFileSync(join(here, '../web/element/attributes.js')).toString('base64');
    const { attributes } = await import(`data:text/javascript;base64,${source}`);
    const shared = attributes.filter(({ attribute }) => rows.some(({ name }) => name === attribute));
    assert.deepEqual(shared.map(({ attribute }) => attribute),
      ['exposure', 'tone-mapping', 'ior', 'roughness', 'dispersion', 'fresnel', 'technique', 'preset', 'layers', 'steps', 'max-events', 'output', 'layer', 'samples']);
    for (const row of shared) {
      const { attribute, type, min, max, integer = false, values } = row;
      if (attribute === 'exposure' || attribute === 'technique') continue; // a factor; an id
      const setting = rows.find(({ name }) => name === attribute);
      if (type === 'enum') assert.deepEqual(values, setting.words, attribute);
      else assert.deepEqual([min, max, integer], [setting.least, setting.most, setting.kind === 'integer'], attribute);
      const value = type === 'enum' ? values.indexOf(row.default) : row.default ?? (['roughness', 'dispersion'].includes(attribute) ? -1 : 0);
      // The element adds 64 samples, one by one, and maps tones as the viewers do that its users know.
      if (!['samples', 'tone-mapping'].includes(attribute)) assert.equal(value, setting.default, attribute);
    }
    const ids = vitrine(['list']).text.split('shapes:')[0].match(/^  [a-z-]+/gm).map((line) => line.trim());
    const { values } = attributes.find(({ attribute }) => attribute === 'technique');
    assert.deepEqual([...values].sort(), ids.filter((id) => id !== 'reference').sort());
  });

  test('a missing or unknown command', () => {
    assert.equal(vitrine([]).code, 1);
    const unknown = vitrine(['paint']);
    assert.equal(unknown.code, 1);
    assert.match(unknown.error, /unknown command 'paint'/);
  });
});

describe('output', () => {
  test('the reference has the backgrounds that the renderer has', () => {
    const picture = new PNG({ width: 96, height: 40 }); // wider than the frame: it is cut off
    picture.data.forEach((_, at) => (picture.data[at] = at % 4 === 3 ? 255 : (at * 7) % 256 < 128 ? 30 : 200));
    const wide = write('wide.png', PNG.sync.write(picture));
    for (const [background, most] of [['#ff8020', 0.03], ['blurred:12', 0.03], [wide, 0.04], ['transparent', 0.03]]) {
      const draw = (name, ...more) => assert.equal(vitrine(['render', 'sphere', '-r', '64,48', '--samples', '16', '--background', background, '--tone-mapping', 'neutral', '-o', name, ...more]).error, '');
      draw('drawn.png');
      draw('traced.png', '-t', 'reference', '--reference', 'drawn.png', '--reference-threshold', `${most}`);
      const [drawn, traced] = ['drawn.png', 'traced.png'].map((name) => PNG.sync.read(readFileSync(join(folder, name))).data);
      const alpha = (data) => data.filter((_, at) => at % 4 === 3);
      assert.deepEqual(alpha(traced), alpha(drawn), background);
    }
  });

  test('the reference has them behind a ground, too', { skip: slow && 'unit tests trace grounds under sanitizers' }, () => {
    const sun = ['--ground', '--sun', '-0.6,0.9,-0.2,2,8,8,8', '--camera', '1.5,3,5', '-r', '48,48', '--samples', '4'];
    for (const more of [['--background', '#ff8020'], ['--background', 'blurred:12'], ['--background', 'transparent'], ['--background', 'transparent', '--ground-color', '0.5,0.5,0.5']]) {
      const [drawn, traced] = ['exact', 'reference'].map((technique) => {
        assert.equal(vitrine(['render', 'sphere', ...sun, ...more, '-t', technique, '-o', 'behind.png']).error, '');
        return PNG.sync.read(readFileSync(join(folder, 'behind.png'))).data;
      });
      const numbers = (data) => data.map((value, at) => (at % 4 === 3 ? value : (value * data[at | 3]) / 255)); // colours times alpha
      const [a, b] = [drawn, traced].map(numbers), apart = a.map((value, at) => Math.abs(value - b[at]));
      const mean = apart.reduce((sum, value) => sum + value, 0) / apart.length;
      assert.ok(mean < 3, `${more}: ${mean} of 255`);
      const shadow = traced.filter((value, at) => at % 4 === 3 && value > 20 && value < 235).length;
      if (more.length === 2 && more[1] === 'transparent') assert.ok(shadow > 100, `${shadow} pixels in the shadow`);
    }
  });

  test('a picture to standard output', () => {
    const result = vitrine(['render', 'diamond', ...small, '-o', '-']);
    assert.equal(result.code, 0, result.error);
    assert.deepEqual([...result.out.subarray(0, 8)], [137, 80, 78, 71, 13, 10, 26, 10]);
    assert.equal(result.error, '');
  });

  test('directions are PFM: bottom row first, unit or marked', () => {
    const result = vitrine(['render', 'sphere', '--resolution', '64,32', '--directions', 'd.pfm']);
    assert.equal(result.code, 0, result.error);
    const file = readFileSync(join(folder, 'd.pfm'));
    assert.equal(file.subarray(0, 14).toString(), 'PF\n64 32\n-1.0\n');
    assert.equal(file.length, 14 + 64 * 32 * 12);
    let glass = 0;
    for (let i = 0; i < 64 * 32; ++i) {
      const [x, y, z] = [0, 4, 8].map((k) => file.readFloatLE(14 + 12 * i + k));
      const length = Math.hypot(x, y, z);
      assert.ok(length === 0 || x === 2 || Math.abs(length - 1) < 1e-4, `${x} ${y} ${z}`);
      glass += length > 0;
    }
    assert.ok(glass > 400, `${glass} pixels of glass`);
    // The light of the ball's lower rim has been bent upwards the most: the picture stands on its head.
    const row = (j) => file.readFloatLE(14 + 12 * (64 * j + 32) + 4);
    assert.ok(row(6) > 0.2 && row(25) < -0.2, `${row(6)} ${row(25)}`);
  });

  test('layer sheet, analysis, both backends, verbose', () => {
    const result = vitrine(['render', 'torus', '-t', 'layered', ...small, '-o', 'a.png', '--layer-sheet', 'sheet.png', '--analysis', '-v']);
    assert.equal(result.code, 0, result.error);
    assert.match(result.error, /[\d.]+ MB of textures.*\n.*4 layers of \d+ x \d+\n/);
    const exact = vitrine(['render', 'torus', ...small, '-o', 'b.png', '-v']);
    assert.match(exact.error, /hierarchies and vertices take [\d.]+ MB, targets and pictures [\d.]+ MB\n/);
    const sheet = readFileSync(join(folder, 'sheet.png'));
    assert.equal(sheet.readUInt32BE(16) % 4, 0);
    for (const backend of ['osmesa', 'egl', 'auto']) {
      const env = backend === 'egl' ? withoutLeakCheck : process.env;
      const each = vitrine(['render', 'torus', ...small, '-o', `${backend}.png`, '--rendering-backend', backend], { env });
      assert.equal(each.code, 0, each.error);
    }
    assert.deepEqual(readFileSync(join(folder, 'egl.png')), readFileSync(join(folder, 'osmesa.png')));
  });

  test('the index of refraction comes from the file, unless given', () => {
    const model = write('ice.glb', glb(gltf(cube())));
    assert.match(vitrine(['render', model, ...small, '-o', 'x.png', '-v']).error, /ior 1\.31/);
    assert.match(vitrine(['render', model, ...small, '-o', 'x.png', '-v', '--ior', '2.4']).error, /ior 2\.4/);
  });

  test('pictures of more than 8 bits: PNG of 16, OpenEXR and HDR', () => {
    const draw = (name, ...more) => {
      const result = vitrine(['render', 'goblet', ...small, '-e', 'sky', '-o', name, ...more]);
      assert.deepEqual([result.code, result.error], [0, ''], name);
      return readFileSync(join(folder, name));
    };
    const off = (a, b) => Number(vitrine(['compare', a, b]).text.match(/largest difference (\d+)/)[1]);
    assert.equal(draw('eight.png')[24], 8);
    assert.equal(draw('sixteen.png', '--bits', '16')[24], 16);
    const light = draw('light.exr');
    draw('light.HDR');
    assert.ok(off('sixteen.png', 'eight.png') <= 1);
    assert.ok(off('light.exr', 'eight.png') <= 1);
    assert.ok(off('light.HDR', 'eight.png') <= 1);
    // Light is as it is, whatever is made of it for a display, and brighter than white where it is.
    assert.deepEqual(draw('mapped.exr', '--tone-mapping', 'agx'), light);
    draw('dark.png', '--exposure', '-5');
    draw('dark.exr', '--exposure', '-5');
    assert.ok(off('dark.exr', 'dark.png') <= 1);
    assert.ok(off('mapped.exr', 'dark.png') > 200);
    // Several samples: no light is cut before its mean is taken.
    draw('samples.exr', '--samples', '4');
    draw('samples.png', '--samples', '4', '--bits', '16');
    assert.ok(off('samples.exr', 'samples.png') <= 1);
    // Alpha is in an OpenEXR file only where something is transparent.
    const names = (file) => file.subarray(0, 400).toString('latin1').match(/[ABGR]\0\x02\0\0\0/g).map((name) => name[0]).join('');
    assert.equal(names(light), 'BGR');
    assert.equal(names(draw('clear.exr', '--background', 'transparent')), 'ABGR');
    const traced = draw('traced.exr', '-t', 'reference');
    if (traced.length > 0) assert.ok(off('traced.exr', 'eight.png') > 0);
  });

  test('tone mapping, of the reference, too; what is behind the scene', () => {
    const draw = (name, ...more) => {
      const result = vitrine(['render', 'sphere', ...small, '-e', 'checker', '--exposure', '1', '--no-fresnel', '-o', name, ...more]);
      assert.deepEqual([result.code, result.error], [0, ''], more.join(' '));
      return name;
    };
    const psnr = (a, b) => JSON.parse(vitrine(['compare', a, b, '--json']).text).psnr ?? Infinity;
    for (const mapping of ['none', 'neutral', 'aces', 'agx']) {
      draw('mapped.png', '--tone-mapping', mapping);
      assert.ok(psnr(draw('traced.png', '--tone-mapping', mapping, '-t', 'reference'), 'mapped.png') > 45, mapping);
      assert.ok(psnr(draw('traced.png', '--tone-mapping', mapping, '-t', 'reference', '--bits', '16'), 'mapped.png') > 45, mapping);
      if (mapping !== 'none') assert.ok(psnr('mapped.png', 'plain.png') < 35, mapping);
      else assert.equal(psnr(draw('plain.png'), 'mapped.png'), Infinity);
    }
    assert.equal(psnr(draw('same.png', '--background', 'environment'), 'plain.png'), Infinity);
    for (const background of ['transparent', '#1e90ff', '#fff', 'blurred', 'blurred:30', './mapped.png']) {
      draw('behind.png', '--background', background);
      assert.ok(psnr('behind.png', 'plain.png') < 40, background);
    }
  });

  test('a model from standard input, a .gltf with its buffer beside it', () => {
    const input = glb(gltf(cube()));
    assert.equal(vitrine(['render', '-', ...small, '-o', 'x.png'], { input }).code, 0);
    mkdirSync(join(folder, 'sub'), { recursive: true });
    const parts = gltf(cube(), 'cube data.bin');
    write('sub/cube data.bin', parts.bin);
    write('sub/cube.gltf', JSON.stringify(parts.json));
    const result = vitrine(['render', 'sub/cube.gltf', ...small, '-o', 'x.png']);
    assert.equal(result.code, 0, result.error);
  });

  test('an environment from a picture', () => {
    const png = vitrine(['render', 'sphere', ...small, '-o', '-']).out;
    write('env.png', png);
    const result = vitrine(['render', 'sphere', ...small, '-o', 'x.png', '-e', './env.png']);
    assert.equal(result.code, 0, result.error);
    assert.match(result.error, /^vitrine: note: environment '\.\/env\.png' is (\d+) x \1 pixels, not twice as wide as high/);
  });

  test('an environment is told by its contents, whatever its name', () => {
    const image = readFileSync(join(here, 'cases/hdr-crlf.hdr'));
    const result = vitrine(['render', 'sphere', ...small, '-o', 'x.png', '-e', write('white.jpg', image)]);
    assert.deepEqual([result.code, result.error], [0, '']);
  });

  test('a WebP picture on a model', () => {
    const args = ['render', join(here, 'cases/webp-picture.glb'), ...small, '-e', 'sky'];
    const result = vitrine([...args, '-o', 'x.png']);
    assert.equal(result.code, 0, result.error);
  });
});

describe('notes', () => {
  test('a mesh without normals is drawn, with a note', () => {
    const result = vitrine(['render', write('cube.glb', glb(gltf(cube()))), ...small, '-o', 'x.png']);
    assert.equal(result.code, 0, result.error);
    assert.match(result.error, /note: 'cube\.glb' lacks normals/);
  });

  test('an open mesh is drawn, with a warning', () => {
    const open = cube();
    open.indices.length -= 6;
    const result = vitrine(['render', write('open.glb', glb(gltf(open))), ...small, '-o', 'x.png']);
    assert.equal(result.code, 0, result.error);
    assert.match(result.error, /warning: 'open\.glb' is not closed \(4 open edges\)/);
  });
});

describe('bad input', () => {
  const render = (...args) => ['render', ...args, ...small];

  test('options', () => {
    refuses(render('sphere', '--layers', '40'), ['--layers is 40', 'from 1 to 16']);
    refuses(render('sphere', '--layers', '2.5'), ['--layers is 2.5', 'whole number']);
    refuses(render('sphere', '--steps', '0'), ['--steps is 0', 'from 1 to 1000']);
    refuses(render('sphere', '--ior', '0.5'), ['--ior is 0.5', 'from 1 to 4']);
    refuses(render('sphere', '--ior', 'nan'), ['--ior', 'number']);
    refuses(render('sphere', '--roughness', '1.5'), ['--roughness is 1.5', 'from 0 to 1']);
    refuses(render('sphere', '--roughness', '-1'), ['--roughness is -1', 'from 0 to 1']);
    refuses(render('sphere', '--dispersion', '21'), ['--dispersion is 21', 'from 0 to 20']);
    refuses(render('sphere', '--dispersion', 'abbe:0.5'), ['--dispersion is 0.5', 'from 1 to 1000']);
    refuses(render('sphere', '--dispersion', 'abbe:'), ["--dispersion is ''", 'a number']);
    refuses(render('sphere', '--glass', 'window'), ["--glass is 'window', which is unknown", 'vitrine list']);
    refuses(render('sphere', '--fov', '200'), ['--fov is 200', 'from 1 to 170']);
    refuses(render('sphere', '--camera', '1,2'), ['--camera', 'X,Y,Z']);
    refuses(render('sphere', '--camera', '0,0,0', '--target', '0,0,0'), ['stands on its target']);
    refuses(['render', 'sphere', '--resolution', '0,10'], ['--resolution is 0,10', 'from 1 to 16384']);
    refuses(render('sphere', '--technique', 'magic'), ["'magic'", 'vitrine list']);
    refuses(render('sphere', '--rendering-backend', 'vulkan'), ["'vulkan'", 'auto, osmesa or egl']);
    refuses(render('sphere', '--shiny'), ['--shiny', 'vitrine render --help']);
    refuses(render('sphere', 'torus'), ["'torus' is a second model", '{name}', '--object']);
    refuses(render(), ['no model given']);
    refuses(render('sphere', '--bits', '12'), ['--bits is 12', '8 or 16']);
    refuses(render('sphere', '--tone-mapping', 'film'), ["--tone-mapping is 'film'", 'none, neutral, aces or agx']);
    refuses(render('sphere', '--background', 'blured'), ["'blured'", 'environment, transparent, blurred', "picture's file"]);
    refuses(render('sphere', '--background', 'blurred:100'), ["'blurred:100'", 'from 1 to 90']);
    refuses(render('sphere', '--background', '#12345'), ["'#12345'", 'hexadecimal']);
    refuses(render('sphere', '--background', 'nowhere.png'), ["'nowhere.png'", 'No such file']);
    refuses(render('sphere', '--background', write('text.png', 'once upon a time')), ["'text.png'", 'PNG, JPEG nor WebP']);
    for (const [more, part] of [[['--bits', '16'], 'leave it out'], [['--analysis'], 'must be a PNG']]) {
      const result = vitrine([...render('sphere', ...more), '-o', 'x.exr']);
      assert.equal(result.code, 1);
      assert.match(result.error, /^vitrine: [^\n]+\n$/);
      assert.ok(result.error.includes(part), result.error);
    }
    const none = vitrine(['render', 'sphere']);
    assert.equal(none.code, 1);
    assert.match(none.error, /no output given; add -o/);
    assert.match(vitrine(['render', 'sphere', '-o']).error, /option -o needs a value/);
  });

  test('model files', () => {
    refuses(render('nowhere.glb'), ["'nowhere.glb'", 'No such file']);
    refuses(render('.'), ["'.'", 'directory']);
    refuses(render('octopus'), ["'octopus'"]);
    refuses(render(write('empty.glb', '')), ["'empty.glb'", 'empty']);
    refuses(render(write('text.glb', 'once upon a time')), ["'text.glb'"]);
    const whole = glb(gltf(cube()));
    for (const length of [3, 12, 15, 40, whole.length - 200, whole.length - 1]) {
      refuses(render(write('cut.glb', whole.subarray(0, length))), ["'cut.glb'"]);
    }
    const outside = gltf(cube(), 'lost.bin');
    refuses(render(write('outside.gltf', JSON.stringify(outside.json))), ["'outside.gltf'", 'lost.bin']);
  });

  test('geometry', () => {
    const change = (name, edit, parts) => {
      const shape = cube();
      edit(shape);
      refuses(render(write(name, glb(gltf(shape)))), [`'${name}'`, ...parts]);
    };
    change('nan.glb', (s) => (s.positions[4] = NaN), ['vertex 1', 'not finite']);
    change('inf.glb', (s) => (s.positions[23] = Infinity), ['vertex 7', 'not finite']);
    change('index.glb', (s) => (s.indices[7] = 99), ['99', '8']);
    change('nothing.glb', (s) => (s.indices.length = 0), []);
    const lines = gltf(cube());
    lines.json.meshes[0].primitives[0].mode = 1;
    refuses(render(write('lines.glb', glb(lines))), ["'lines.glb'", 'triangle']);
  });

  test('environments', () => {
    refuses(render('sphere', '-e', 'moon'), ["'moon'", 'studio']);
    refuses(render('sphere', '-e', './nowhere.hdr'), ["'./nowhere.hdr'", 'No such file']);
    refuses(render('sphere', '-e', write('text.hdr', 'once upon a time')), ["'text.hdr'"]);
    refuses(render('sphere', '-e', join(here, 'cases/hdr-rle-cut.hdr')), ["hdr-rle-cut.hdr' cannot be decoded as Radiance HDR (its pixels are cut off)"]);
    refuses(render('sphere', '-e', join(here, 'cases/dht.jpg')), ["dht.jpg' cannot be decoded as JPEG (Bogus Huffman table definition)"]);
  });

  test('output that cannot be written', () => {
    const result = vitrine(['render', 'sphere', ...small, '-o', 'no/such/folder/x.png']);
    assert.equal(result.code, 1);
    assert.match(result.error, /'no\/such\/folder\/x\.png' cannot be written: No such file/);
  });

  test('no GL context, no display', () => {
    const env = { ...withoutLeakCheck, __EGL_VENDOR_LIBRARY_FILENAMES: '/nonexistent.json', DISPLAY: '', WAYLAND_DISPLAY: '' };
    refuses(render('sphere', '--rendering-backend', 'egl'), ['egl'], { env });
    const view = vitrine(['view', 'sphere'], { env });
    assert.equal(view.code, 1);
    assert.match(view.error, /^vitrine: window: [^\n]+\n$/);
  });
});

/** Renders what must work, and gives the picture back. */
function picture(name, ...args) {
  const result = vitrine(['render', ...args, '-o', name]);
  assert.equal(result.code, 0, result.error);
  return readFileSync(join(folder, name));
}

describe('objects', () => {
  const render = (...args) => ['render', ...args, ...small];
  const object = (...specs) => specs.flatMap((spec) => ['--object', spec]);

  test('the order of objects does not matter', () => {
    const specs = ['cube:at=0,0,0.6', 'knot:at=0,0,-2,scale=0.8,rotate=0,40,0', 'plane:checker=4,at=0,0,-4', 'sphere:scale=0.4,at=0,0,0.6,ior=1'];
    const first = picture('first.png', ...object(...specs), ...small, '--directions', 'first.pfm');
    const second = picture('second.png', ...object(...specs.reverse()), ...small, '--directions', 'second.pfm');
    assert.ok(first.equals(second));
    assert.ok(readFileSync(join(folder, 'first.pfm')).equals(readFileSync(join(folder, 'second.pfm'))));
    // A model by itself is the first object.
    assert.ok(picture('a.png', 'cube', ...object('sphere:at=2,0,0'), ...small).equals(picture('b.png', ...object('cube', 'sphere:at=2,0,0'), ...small)));
  });

  test('keys do what they say', () => {
    const plain = picture('plain.png', ...object('cube'), ...small, '--camera', '1,1,4');
    const changes = ['ior=1.2', 'at=0.3,0,0', 'scale=0.7', 'scale=1,0.7,1', 'rotate=0,30,0', 'tint=1,0.5,0.5', 'absorb=1,0.5,0.5', 'opaque', 'colour=1,0,0', 'checker'];
    const drawn = changes.map((keys, i) => picture(`key-${i}.png`, ...object(`cube:${keys}`), ...small, '--camera', '1,1,4', '--target', '0,0,0'));
    drawn.forEach((png, i) => {
      assert.ok(!png.equals(plain), changes[i]);
      for (let k = 0; k < i; ++k) assert.ok(!png.equals(drawn[k]), `${changes[i]} and ${changes[k]}`);
    });
    const same = ['at=0,0,0', 'scale=1', 'ior=1.5', 'priority=3', 'glass', 'distance=2', 'colour=1,0,0,glass', 'absorb=0.5,0.5,0.5,distance=0'];
    for (const keys of same) {
      assert.ok(picture('same.png', ...object(`cube:${keys}`), ...small, '--camera', '1,1,4', '--target', '0,0,0').equals(plain), keys);
    }
  });

  test('roughness, dispersion and kinds of glass, of all objects and of each', () => {
    const draw = (...args) => picture('material.png', ...args, '-r', '24,24', '-t', 'reference', '--camera', '1,1,4', '--target', '0,0,0');
    const plain = draw(...object('cube'));
    for (const keys of ['roughness=0', 'dispersion=0', 'glass', 'attenuation-color=0.5,0.5,0.5,attenuation-distance=0']) {
      assert.ok(draw(...object(`cube:${keys}`)).equals(plain), keys);
    }
    const same = {
      'roughness=0.4': ['--roughness', '0.4'], 'dispersion=0.5': ['--dispersion', '0.5'], 'glass=flint': ['--glass', 'flint'],
      [`ior=1.62,dispersion=${20 / 36.37}`]: ['--glass', 'flint'], 'dispersion=0.8': ['--dispersion', 'abbe:25'], 'glass=flint,ior=1.5': ['--glass', 'flint', '--ior', '1.5'],
      'glass=diamond,dispersion=0': ['--ior', '2.417'],
    };
    for (const [keys, options] of Object.entries(same)) {
      const one = draw(...object(`cube:${keys}`));
      assert.ok(one.equals(draw('cube', ...options)), keys);
      assert.ok(!one.equals(plain), keys);
    }
    assert.ok(draw(...object('cube:absorb=0.5,0.9,0.5,distance=2')).equals(draw(...object('cube:attenuation-color=0.5,0.9,0.5,attenuation-distance=2'))));
    assert.ok(draw(...object('cube:roughness=0.4'), '--roughness', '0').equals(plain));
    const { error } = vitrine(['render', 'sphere', ...small, '-o', 'note.png', '-t', 'layered', '--roughness', '0.2', '--dispersion', '0.3']);
    assert.match(error, /technique layered draws no roughness and dispersion of glass; reference does/);
  });

  test('what overlaps: the highest priority counts', () => {
    const pair = (one, other) => picture('pair.png', ...object(`sphere${one}`, `cube:at=0.8,0,0,ior=2${other}`), ...small);
    const smaller = pair('', ''); // the cube's volume
    assert.ok(smaller.equals(pair('', ',priority=1')));
    assert.ok(!smaller.equals(pair(':priority=1', '')));
    assert.ok(smaller.equals(pair(':priority=1', ',priority=2')));
  });

  test('keys that are wrong', () => {
    const bad = {
      'sphere:size=2': ["--object 'sphere:size=2' has the key 'size', which is unknown; the keys are ior, at, scale,", 'checker, thin, dispersion, width, height, radius, bevel, thickness and image'],
      'sphere:roughness=2': ["roughness is '2'; it must be a number from 0 to 1"],
      'sphere:dispersion=-1': ["dispersion is '-1'; it must be a number from 0 to 20"],
      'sphere:glass=window': ["glass is 'window'; it must be one of water, crown, flint", 'or stand alone'],
      'sphere:attenuation-distance=-1': ["distance is '-1'"],
      'sphere:': ["the key ''"],
      'sphere:ior=5': ["ior is '5'; it must be a number from 0.25 to 4"],
      'sphere:ior=0.2': ["ior is '0.2'"],
      'sphere:ior': ["ior is ''"],
      'sphere:ior=glass': ["ior is 'glass'"],
      'sphere:at=1,2': ["at is '1,2'; it must be three numbers"],
      'sphere:at=1,2,3,4': ["at is '1,2,3,4'"],
      'sphere:rotate=90': ["rotate is '90'; it must be three numbers"],
      'sphere:scale=0': ["scale is '0'; it must be one number or three", 'none of them within 1e-09 of 0'],
      'sphere:scale=1,0,1': ["scale is '1,0,1'"],
      'sphere:scale=1,2': ["scale is '1,2'"],
      'sphere:priority=1.5': ["priority is '1.5'; it must be a whole number"],
      'sphere:tint=1,2,1': ["tint is '1,2,1'; it must be three numbers from 0 to 1"],
      'sphere:colour=nan,0,0': ["colour is 'nan,0,0'"],
      'sphere:distance=-1': ["distance is '-1'"],
      'sphere:relief=11': ["relief is '11'; it must be a number from 0 to 10"],
      'ripples:slab=0': ["slab is '0'; it must be a number from 0.001 to 10"],
      'ripples:smooth=-1': ["smooth is '-1'; it must be a number from 0 to 64"],
      'ripples:samples=1': ["samples is '1'; it must be a whole number from 2 to 4096"],
      'ripples:samples=9.5': ["samples is '9.5'"],
      'sphere:relief=0.1': ["--object 'sphere' is no relief, so the key 'relief' says nothing to it"],
      'knot:samples=9': ["the key 'samples' says nothing to it"],
      'sphere:opaque=1': ["opaque is '1'; it must be given without a value"],
      'sphere:checker=1,2': ["checker is '1,2'; it must be without a value or a number"],
      'sphere:opaque,glass': ['is opaque and glass; give one of them'],
      'octopus:ior=1.4': ["'octopus' is neither a built-in shape", 'vitrine list'],
      'nowhere.glb': ["'nowhere.glb' is neither a built-in shape", 'nor a file'],
      ':ior=1.5': ["--object is ':ior=1.5'; it must be NAME or NAME:key=value"],
      '': ["--object is ''"],
    };
    for (const [spec, parts] of Object.entries(bad)) refuses(render(...object(spec)), parts);
    refuses(render(...object(...Array(65).fill('sphere'))), ["'sphere' is one too many; at most 64"]);
    refuses(render('sphere', '--multi', 'some'), ["--multi is 'some'; it must be any or ordered"]);
    refuses(render('sphere', '--ground=deep'), ["--ground is 'deep'; it must be a number"]);
    refuses(render('sphere', '--ground=0.5'), ['it lies at 0.5, but the scene reaches down to -1']);
    refuses(render('sphere', '--ground', '--sun', '1,2'), ["--sun is '1,2'; it must be X,Y,Z towards it"]);
    refuses(render('sphere', '--ground', '--sun', '0,-1,0'), ["the sun's direction is 0, -1, 0; it must point up"]);
    refuses(render('sphere', '--ground', '--ground-color', '1,2,1'), ['its color is 2; it must be from 0 to 1']);
    refuses(render('sphere', '--sun', '1,1,1'), ['--sun says something of a ground; add --ground']);
    refuses(render('sphere', '--ground', '--shadow-softness', '3'), ['its shadow softness is 3; it must be from 0 to 1']);
    const { error } = vitrine(['render', 'sphere', ...small, '-o', 'note.png', '-t', 'layered', '--ground']);
    assert.match(error, /note: technique layered draws no ground, and no light or shadow of its sun; exact, heightfield and reference do/);
    refuses(render('sphere', '--search', 'rays'), ["--search is 'rays'; it must be steps or cells"]);
  });

  test('an open sheet of glass within glass is a thin wall', () => {
    const output = join(folder, 'sheet-in-cube.png'), bare = join(folder, 'cube.png');
    assert.equal(vitrine([...render(...object('cube:scale=4', 'plane:glass')), '-o', output]).code, 0);
    assert.equal(vitrine([...render(...object('cube:scale=4')), '-o', bare]).code, 0);
    assert.ok(!readFileSync(output).equals(readFileSync(bare)));
    assert.equal(vitrine([...render(...object('cube:scale=4', 'plane:glass,at=0,0,-3')), '-o', output]).code, 0);
  });

  test('the reference draws the same objects', () => {
    const args = [...object('sphere', 'sphere:scale=0.4,colour=0.9,0.3,0.1', 'plane:at=0,0,-2,checker'), ...small, '-e', 'checker'];
    picture('objects.png', ...args, '--directions', 'objects.pfm');
    picture('traced.png', ...args, '-t', 'reference', '--directions', 'traced.pfm');
    const compared = (a, b) => JSON.parse(vitrine(['compare', a, b, '--json']).text);
    const { flip } = compared('objects.png', 'traced.png'), { within1, lost } = compared('objects.pfm', 'traced.pfm');
    assert.ok(flip < 0.05, `FLIP ${flip}`);
    assert.ok(within1 > 0.97 && lost < 0.01, `${within1} within 1 degree, ${lost} lost`);
  });
});

/** A grey PNG of 8 or 16 bits; `height(column, row)` is 0 to 1. */
function greyPng(width, height, bits, heightAt) {
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header[8] = bits;
  const size = bits / 8, rows = Buffer.alloc(height * (1 + width * size));
  for (let row = 0; row < height; ++row) {
    for (let column = 0; column < width; ++column) {
      const at = row * (1 + width * size) + 1 + column * size;
      rows.writeUIntBE(Math.round(heightAt(column, row) * (2 ** bits - 1)), at, size);
    }
  }
  return Buffer.concat([Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), pngChunk('IHDR', header), pngChunk('IDAT', deflateSync(rows)), pngChunk('IEND', Buffer.alloc(0))]);
}

describe('pictures seen through glass do not sparkle', () => {
  // Noise, finer than what a pixel covers of it through glass. The reference reads it at full size.
  const noise = greyPng(1024, 512, 8, (column, row) => ((column * 73856093) ^ (row * 19349663) ^ ((column * row) >> 3)) % 17 & 1);
  const size = ['--resolution', '96,96', '-e', './noise.png', '--fov', '45'];
  const view = (shift) => ['--camera', `${shift},0.3,4`, '--target', `${shift},0,0`];
  const draw = (name, model, ...args) => picture(name, model, ...size, ...args);
  const flip = (a, b) => JSON.parse(vitrine(['compare', a, b, '--json']).text).flip;

  test('nor are photographs blurred', () => {
    // As in photographs, wide differences are greater than narrow ones.
    const wave = (x, y, k) => Math.sin(k * x + 1.7 * k * k) * Math.sin(k * y + 0.6 * k * k);
    const octaves = [1, 2, 4, 8, 16, 32, 64, 128];
    write('photograph.png', greyPng(1024, 512, 8, (column, row) => 0.5 + 0.5 * Math.tanh(
      octaves.reduce((sum, k) => sum + wave((2 * Math.PI * column) / 1024, (Math.PI * row) / 512, k) / Math.sqrt(k), 0))));
    const words = ['--no-fresnel', '-e', './photograph.png'];
    for (const model of ['sphere', 'knot']) {
      draw('truth.png', model, ...view(0), ...words, '-t', 'reference', '--samples', '64');
      for (const technique of ['exact', 'reference']) draw(`${technique}.png`, model, ...view(0), ...words, '-t', technique);
      const error = (name) => flip(`${name}.png`, 'truth.png');
      assert.ok(error('exact') < error('reference'), `${model}: ${error('exact')} of ${error('reference')}`);
    }
  });

  for (const model of ['sphere', 'knot']) {
    test(model, () => {
      write('noise.png', noise);
      const moved = 0.3 * 2 * 4 * Math.tan(Math.PI / 8) / 96; // a third of a pixel
      draw('truth.png', model, ...view(0), '-t', 'reference', '--samples', '64');
      for (const technique of ['exact', 'layered', 'reference']) {
        draw(`${technique}.png`, model, ...view(0), '-t', technique);
        draw(`${technique}-moved.png`, model, ...view(moved), '-t', technique);
      }
      draw('still.png', model, ...view(0), '--samples', '64');
      const error = (name) => flip(`${name}.png`, 'truth.png'), change = (name) => flip(`${name}.png`, `${name}-moved.png`);
      // Half of what a pixel covers is blurred: pictures that have wide parts, too, come out worse by all of it.
      assert.ok(error('exact') < 0.75 * error('reference'), `${error('exact')} of ${error('reference')}`);
      assert.ok(error('layered') < 0.8 * error('reference'), `${error('layered')} of ${error('reference')}`);
      assert.ok(change('exact') < 0.6 * change('reference'), `${change('exact')} of ${change('reference')}`);
      assert.ok(change('layered') < 0.8 * change('reference'), `${change('layered')} of ${change('reference')}`);
      // Many samples come to the same picture: each of them covers less.
      assert.ok(error('still') < 0.25 * error('exact'), `${error('still')} of ${error('exact')}`);
    });
  }
});

/** A grey PFM. */
function greyPfm(width, height, heightAt) {
  const numbers = Buffer.alloc(4 * width * height);
  for (let row = 0; row < height; ++row) {
    for (let column = 0; column < width; ++column) {
      numbers.writeFloatLE(heightAt(column, row), 4 * ((height - 1 - row) * width + column));
    }
  }
  return Buffer.concat([Buffer.from(`Pf\n${width} ${height}\n-1.0\n`), numbers]);
}

describe('reliefs', () => {
  const render = (...args) => ['render', ...args, ...small];
  const args = ['--resolution', '128,128', '-t', 'exact', '-e', 'checker', '--relief-size', '129'];
  const wave = (column, row) => 0.5 + 0.5 * Math.sin(0.2 * column) * Math.cos(0.15 * row);

  test('built-in patterns', () => {
    const drawn = ['ripples', 'hammered', 'fluted', 'lens-array'].map((name) => picture(`${name}.png`, name, ...args));
    drawn.forEach((png, i) => drawn.slice(0, i).forEach((other) => assert.ok(!png.equals(other))));
    assert.ok(drawn[0].equals(picture('again.png', 'ripples', ...args)));
    // As the one object that is drawn, keys for options.
    assert.ok(drawn[0].equals(picture('again.png', '--object', 'ripples:samples=129', ...args.slice(0, -2))));
    const changed = picture('again.png', 'ripples', ...args, '--relief', '0.1', '--slab', '0.3', '--smooth', '1');
    assert.ok(!drawn[0].equals(changed));
    assert.ok(changed.equals(picture('keys.png', '--object', 'ripples:samples=129,relief=0.1,slab=0.3,smooth=1', ...args.slice(0, -2))));
  });

  test('what --verbose says', () => {
    const { error } = vitrine([...render('fluted', '--relief-size', '65'), '-o', 'x.png', '-v']);
    assert.match(error, /'fluted': relief of 65 x 65 samples, cell 0\.03125, z 0 to 0\.0[34]\d*, back at -0\.1, [\d.]+ MB of heights\n/);
    // By its heights, unless another technique is asked for.
    assert.match(error, /, 0\.0 MB of mesh\n/);
    assert.doesNotMatch(vitrine([...render('fluted'), '-t', 'exact', '-o', 'x.png', '-v']).error, /, 0\.0 MB of mesh\n/);
  });

  test('the same heights as PNG of 16 bits and as PFM', () => {
    const ramp = (column, row) => (column + 64 * row) / 4095;
    write('ramp.png', greyPng(64, 64, 16, (column, row) => Math.round(ramp(column, row) * 65535) / 65535));
    write('ramp.pfm', greyPfm(64, 64, (column, row) => Math.round(ramp(column, row) * 65535)));
    const options = [...small, '-e', 'checker', '--relief', '0.4'];
    const first = vitrine(['render', 'ramp.png', ...options, '-o', 'a.png', '--directions', 'a.pfm']);
    assert.equal(first.code, 0, first.error);
    assert.equal(first.error, '');
    const second = picture('b.png', 'ramp.pfm', ...options, '--directions', 'b.pfm');
    assert.ok(readFileSync(join(folder, 'a.png')).equals(second));
    assert.ok(readFileSync(join(folder, 'a.pfm')).equals(readFileSync(join(folder, 'b.pfm'))));
    // What a file holds counts, not its name, so that it may come from standard input, too.
    const input = readFileSync(join(folder, 'ramp.png'));
    const piped = vitrine(['render', '-', ...options, '-o', 'c.png'], { input });
    assert.equal(piped.code, 0, piped.error);
    assert.ok(readFileSync(join(folder, 'c.png')).equals(second));
    assert.ok(picture('d.png', '--object', 'ramp.png:relief=0.4', ...small, '-e', 'checker').equals(second));
  });

  test('an opaque one carries a picture, by its heights as by its triangles', () => {
    const differs = (a, b) => JSON.parse(vitrine(['compare', a, b, '--json']).text).flip;
    write('picture.png', greyPng(64, 64, 8, (column, row) => (column < 32) === (row < 32) ? 1 : 0.1));
    write('around.png', greyPng(512, 256, 8, (column, row) => ((column * 73856093) ^ (row * 19349663)) % 17 & 1));
    const view = ['--camera', '0,0.5,2', '--target', '0,0,0', ...small, '-e', './around.png'];
    for (const [name, relief] of [['matt', 'hammered:image=picture.png'], ['glossy', 'ripples:colour=0.9,0.8,0.7,metallic=1,roughness=0.1']]) {
      const draw = (technique, ...more) => picture(`${name}-${technique}.png`, '--object', `${relief},relief=0.1,samples=65,rotate=-60,0,0`, ...view, '-t', technique, ...more);
      draw('heightfield');
      draw('exact');
      draw('reference', '--samples', '16');
      assert.ok(differs(`${name}-heightfield.png`, `${name}-exact.png`) < 0.003);
      assert.ok(differs(`${name}-heightfield.png`, `${name}-reference.png`) < 0.1);
    }
    // White in the upper left and lower right quarter.
    const flat = (scale) => picture('flat.png', '--object', `hammered:image=./picture.png,relief=0,samples=9,scale=${scale}`, '--camera', '0,0,4', '--target', '0,0,0', ...small, '-e', 'studio');
    assert.ok(!flat('1').equals(flat('-1,1,-1')) && flat('1').equals(flat('-1,-1,1')));
    refuses(render('--object', 'hammered:image'), ["image is ''", '.png or .jpg']);
    refuses(render('--object', 'hammered:image=nowhere.png'), ["'nowhere.png'"]);
  });

  test('8 bits are smoothed, with a note', () => {
    write('waves.png', greyPng(80, 60, 8, wave));
    const noted = vitrine([...render('waves.png'), '-o', 'a.png']);
    assert.equal(noted.code, 0, noted.error);
    assert.equal(noted.error, "vitrine: note: 'waves.png' has 8 bits a height; smoothed over 2 samples (--smooth)\n");
    const asked = vitrine([...render('waves.png', '--smooth', '2'), '-o', 'b.png']);
    assert.equal(asked.error, '');
    assert.ok(readFileSync(join(folder, 'a.png')).equals(readFileSync(join(folder, 'b.png'))));
    assert.ok(!picture('c.png', 'waves.png', '--smooth', '0', ...small).equals(readFileSync(join(folder, 'a.png'))));
  });

  test('the reference, the ladder and bench draw them', () => {
    const options = [...small, '-e', 'checker', '--relief-size', '65'];
    picture('drawn.png', 'ripples', ...options, '--directions', 'drawn.pfm');
    picture('traced.png', 'ripples', ...options, '-t', 'reference', '--directions', 'traced.pfm');
    const { within1 } = JSON.parse(vitrine(['compare', 'drawn.pfm', 'traced.pfm', '--json']).text);
    assert.ok(within1 > 0.98, `${within1} within 1 degree`);
    picture('wyman.png', 'ripples', ...options, '-t', 'wyman');
    assert.match(vitrine(['bench', 'ripples', ...options, '-t', 'exact', '--rounds', '1']).text, /exact/);
    assert.match(vitrine(['ladder', 'ripples', ...options]).text, /wyman/);
  });

  test('bad input', () => {
    refuses(render('ripples', '--relief', '-1'), ['--relief is -1; it must be a number from 0 to 10']);
    refuses(render('ripples', '--slab', '0'), ['--slab is 0; it must be a number from 0.001 to 10']);
    refuses(render('ripples', '--smooth', '65'), ['--smooth is 65', 'from 0 to 64']);
    refuses(render('ripples', '--relief-size', '4097'), ['--relief-size is 4097', 'from 2 to 4096']);
    refuses(render('sphere', '--relief', '0.1'), ["--relief is given, but 'sphere' is no relief"]);
    refuses(render('--object', 'ripples', '--slab', '0.1'), ['--slab is given, but no MODEL']);
    refuses(render(write('cube.glb', glb(gltf(cube()))), '--smooth', '1'), ["--smooth is given, but 'cube.glb' is no relief"]);
    const good = write('good.png', greyPng(9, 9, 16, () => 0.5));
    refuses(render(good, '--relief-size', '9'), ["--relief-size is given, but 'good.png' has the samples that the file has"]);
    refuses(render('--object', `${good}:samples=9`), ["'good.png' has the samples that the file has; leave the key 'samples' out"]);
    refuses(render('--object', 'cube.glb:relief=0.1'), ["'cube.glb' is no relief, so the key 'relief'"]);
    refuses(render('octopus'), ["model 'octopus' is neither a built-in shape or relief (see 'vitrine list')"]);
    refuses(render(write('one.png', greyPng(1, 1, 8, () => 0))), ["'one.png' is 1 x 1 samples, but a side must be 2 to 4096"]);
    refuses(render(write('wide.png', greyPng(5000, 2, 8, () => 0))), ["'wide.png' is 5000 x 2 samples, but a side must be 2 to 4096"]);
    const noise = greyPng(40, 40, 16, (column, row) => Math.abs(Math.sin(column * 78.233 + row * 12.9898) * 43758.5453 % 1));
    refuses(render(write('cut.png', noise.subarray(0, 300))), ["'cut.png' cannot be decoded"]);
    refuses(render(write('nan.pfm', greyPfm(4, 3, (column, row) => (column === 2 && row === 1 ? NaN : column)))), [
      "'nan.pfm': the height in column 2, row 1 is nan"]);
    refuses(render(write('short.pfm', greyPfm(4, 3, () => 1).subarray(0, 40))), ["'short.pfm' holds", 'truncated']);
  });
});

describe('scenes in files', () => {
  const render = (...args) => ['render', ...args, ...small];
  const scene = (name, edit) => {
    const parts = gltf(cube());
    edit(parts.json);
    return write(name, glb(parts));
  };

  test('two nodes that share a mesh are two objects', () => {
    const one = scene('one.glb', () => {});
    const two = scene('two.glb', (json) => {
      json.nodes = [{ mesh: 0, translation: [-1.5, 0, 0] }, { mesh: 0, translation: [1.5, 0.5, 0], scale: [0.5, 0.5, 0.5] }];
      json.scenes[0].nodes = [0, 1];
    });
    const drawn = picture('two.png', two, ...small);
    assert.ok(!drawn.equals(picture('one.png', one, ...small)));
    const apart = ['--object', `${one}:at=-1.5,0,0`, '--object', `${one}:at=1.5,0.5,0,scale=0.5`];
    assert.ok(drawn.equals(picture('apart.png', ...apart, ...small)));
    assert.ok(!drawn.equals(picture('ior.png', '--object', `${two}:ior=2`, ...small)), 'keys hold for all objects of a file');
  });

  test('cameras', () => {
    const model = scene('camera.glb', (json) => {
      json.cameras = [{ type: 'perspective', perspective: { yfov: Math.PI / 6, znear: 0.1 } }];
      json.nodes = [{ mesh: 0 }, { camera: 0, name: 'front', translation: [0, 0, 9] }];
      json.scenes[0].nodes = [0, 1];
    });
    const own = picture('own.png', model, ...small, '--camera-index', '0');
    assert.ok(!own.equals(picture('framed.png', model, ...small)));
    const given = ['--camera', '0,0,9', '--target', '0,0,0'];
    assert.ok(own.equals(picture('given.png', model, ...small, ...given, '--fov', '30')));
    assert.ok(!own.equals(picture('wide.png', model, ...small, '--camera-index', '0', '--fov', '60')), '--fov goes before it');
    assert.ok(own.equals(picture('named.png', model, ...small, '--camera-index', 'front')), 'by its name');
    refuses(render('sphere', '--camera-index', '0'), ["--camera-index is '0', but there are no cameras", 'leave it out']);
    refuses(render('sphere', '--camera-index', 'front'), ["--camera-index is 'front', but there are no cameras"]);
    assert.match(vitrine([...render(model, '--camera-index', '-1'), '-o', 'no.png']).error, /--camera-index is '-1', but the cameras in what is drawn are: 0 front/);
    const result = vitrine([...render(model, '--camera-index', '1'), '-o', 'no-camera.png']);
    assert.equal(result.code, 1);
    assert.match(result.error, /^vitrine: --camera-index is '1', but the cameras in what is drawn are: 0 front$/m);
    assert.ok(!existsSync(join(folder, 'no-camera.png')));
  });

  test('nodes in a circle, flat nodes', () => {
    const circle = scene('circle.glb', (json) => {
      json.nodes = [{ children: [1] }, { mesh: 0, children: [0] }];
    });
    refuses(render(circle), ["'circle.glb'", 'is reached twice, but nodes must form a tree without cycles']);
    const flat = scene('flat.glb', (json) => (json.nodes = [{ mesh: 0, scale: [1, 0, 1], name: 'lid' }]));
    refuses(render(flat), ["'flat.glb'", "'lid'", 'is scaled by 1, 0, 1', 'give it and those above it a scale other than 0']);
    const above = scene('above.glb', (json) => (json.nodes = [{ scale: [0, 1, 1], children: [1] }, { mesh: 0 }]));
    refuses(render(above), ["'above.glb'", 'node 1', 'a scale other than 0']);
  });
});

describe('Fresnel reflection', () => {
  test('is drawn unless it is left out', () => {
    const args = ['knot', ...small];
    const drawn = picture('with.png', ...args);
    assert.ok(drawn.equals(picture('asked.png', ...args, '--fresnel')));
    assert.ok(!drawn.equals(picture('without.png', ...args, '--no-fresnel')));
    refuses(['render', ...args, '--fresnel', '--no-fresnel'], ['--fresnel and --no-fresnel contradict each other; give one']);
  });

  test('directions are those of strict paths unless --fresnel is given', () => {
    const directions = (name, ...args) => {
      picture(`${name}.png`, 'knot', ...small, '--directions', `${name}.pfm`, ...args);
      return readFileSync(join(folder, `${name}.pfm`));
    };
    const strict = directions('default');
    assert.ok(strict.equals(directions('no', '--no-fresnel')));
    assert.ok(strict.equals(directions('more', '--samples', '4')));
    assert.ok(!strict.equals(directions('yes', '--fresnel')));
    const defaultPicture = readFileSync(join(folder, 'default.png'));
    assert.ok(defaultPicture.equals(readFileSync(join(folder, 'yes.png'))), 'the picture is the same');
  });
});

describe('measuring', () => {
  const draw = (name, ...args) => {
    const result = vitrine(['render', 'knot', ...small, '-o', `${name}.png`, '--directions', `${name}.pfm`, ...args]);
    assert.equal(result.code, 0, result.error);
  };

  test('compare pictures and directions', () => {
    draw('truth', '--technique', 'reference');
    draw('drawn');
    const same = JSON.parse(vitrine(['compare', 'truth.png', 'truth.png', '--json']).text);
    assert.deepEqual([same.psnr, same.ssim, same.flip, same.pixelsOver], [null, 1, 0, 0]);
    const pictures = JSON.parse(vitrine(['compare', 'drawn.png', 'truth.png', '--json', '--difference', 'map.png']).text);
    assert.ok(pictures.flip > 0 && pictures.flip < 0.1, `FLIP ${pictures.flip}`);
    assert.ok(existsSync(join(folder, 'map.png')));
    const directions = JSON.parse(vitrine(['compare', 'drawn.pfm', 'truth.pfm', '--json']).text);
    assert.ok(directions.within1 > 0.6, `${directions.within1} within 1 degree`);
    assert.equal(directions.maskErrors, 0);
    assert.match(vitrine(['compare', 'drawn.pfm', 'truth.pfm']).text, /<= 1 deg/);
    assert.match(vitrine(['compare', '--help']).text, /--json/);
    draw('counted', '-t', 'reference', '--events', 'events.png');
    const split = JSON.parse(vitrine(['compare', 'drawn.pfm', 'truth.pfm', '--json', '--events', 'events.png']).text);
    assert.ok(split.upTo4Events.pixels > 0 && split.upTo4Events.pixels <= directions.pixels);
    refuses(['render', 'knot', ...small, '--events', 'events.png'], ['--technique reference']);
  });

  test('compare refuses what cannot be compared', () => {
    const fails = (args, parts) => {
      const result = vitrine(['compare', ...args]);
      assert.equal(result.code, 1);
      assert.match(result.error, /^vitrine: [^\n]+\n$/);
      for (const part of parts) assert.ok(result.error.includes(part), `'${part}' is not in: ${result.error}`);
    };
    vitrine(['render', 'knot', '--resolution', '32,32', '-o', 'little.png']);
    fails(['drawn.png', 'little.png'], ['64', '32']);
    fails(['drawn.png', 'truth.pfm'], ['truth.pfm holds directions']);
    fails(['drawn.png', 'nowhere.png'], ["'nowhere.png'"]);
    fails(['drawn.png'], []);
    fails(['drawn.png', 'truth.png', '--shiny'], ['--shiny']);
  });

  test('render against a reference picture', () => {
    const close = vitrine(['render', 'knot', ...small, '--reference', 'truth.png', '--reference-threshold', '0.1']);
    assert.equal(close.code, 0, close.error);
    const far = vitrine(['render', 'knot', ...small, '-t', 'single', '-o', 'far.png', '--reference', 'truth.png',
      '--reference-threshold', '0.01']);
    assert.equal(far.code, 1);
    assert.match(far.error, /differs from 'truth\.png': mean FLIP 0\.\d+ is above --reference-threshold 0\.01/);
    assert.ok(existsSync(join(folder, 'far.png')) && existsSync(join(folder, 'far.png.difference.png')));
  });

  test('the reference tracer: samples, Fresnel, analysis', () => {
    const args = ['render', 'sphere', '--resolution', '24,24', '-t', 'reference'];
    assert.equal(vitrine([...args, '--fresnel', '--samples', '16', '-o', 'fresnel.png']).code, 0);
    assert.equal(vitrine([...args, '--analysis', '-o', 'paths.png']).code, 0);
    refuses([...args, '--layer-sheet', 'sheet.png'], ['peels no layers']);
    refuses(['render', 'sphere', '-t', 'single', '--layer-sheet', 'sheet.png', ...small], ['peels no layers']);
    refuses([...args, '--samples', '0'], ['--samples is 0', 'from 1 to 65536']);
  });

  test('samples: smooth edges, the same in drawing and tracing', () => {
    const args = ['render', 'sphere', '-e', 'checker', '--no-fresnel', '--resolution', '96,96'];
    const pictures = {};
    for (const technique of ['layered', 'reference']) {
      for (const samples of [1, 16]) {
        const file = `${technique}-${samples}.png`;
        const result = vitrine([...args, '-t', technique, '--samples', String(samples), '--directions', `${file}.pfm`, '-o', file]);
        assert.equal(result.code, 0, result.error);
        pictures[file] = readFileSync(join(folder, file));
      }
    }
    const flip = (a, b) => JSON.parse(vitrine(['compare', a, b, '--json']).text).flip;
    assert.ok(flip('layered-16.png', 'reference-16.png') < 0.3 * flip('layered-1.png', 'reference-16.png'));
    const directions = ['layered-1.png.pfm', 'layered-16.png.pfm'].map((file) => readFileSync(join(folder, file)));
    assert.ok(directions[0].equals(directions[1]), "directions stay those of the pixel's centre");
    const bad = [['0', '--samples is 0; it must be a whole number from 1'], ['2.5', '--samples is 2.5'], ['many', "--samples is 'many'"],
      ['5000', 'samples is 5000; it must be from 1 to 4096']];
    for (const [value, sentence] of bad) refuses([...args, '--samples', value], [sentence]);
  });

  test('the ladder: errors fall from rung to rung', () => {
    const result = vitrine(['ladder', 'torus', '--resolution', '96,96', '-o', 'ladder.png', '--table', 'ladder.md']);
    assert.equal(result.code, 0, result.error);
    const table = readFileSync(join(folder, 'ladder.md'), 'utf8');
    const mean = (label) => Number(table.match(new RegExp(`\\| ${label} \\|.*?\\| ([\\d.]+)° \\|`))[1]);
    const rungs = ['single', 'wyman', 'oliveira', 'layered, 4 layers', 'layered, cells'].map(mean);
    assert.ok(rungs[0] > rungs[1] && rungs[1] > rungs[3] && rungs[2] > rungs[3] && rungs[3] > rungs[4], rungs.join(' '));
    assert.ok(existsSync(join(folder, 'ladder.png')));
  });

  test('bench: a report of every technique asked for', () => {
    const args = ['bench', 'torus', '--resolution', '64,64', '--rounds', '1'];
    const result = vitrine([...args, '--json', '--table', 'bench.md']);
    assert.equal(result.code, 0, result.error);
    assert.match(result.error, /^vitrine: bench: torus, 36864 triangles, 64 x 64\n$/);
    const report = JSON.parse(result.text);
    assert.deepEqual([report.model, report.sweep, report.cases.length, report.maxEvents], ['torus', '', 1, 8]);
    const [measured] = report.cases;
    assert.deepEqual(measured.techniques.map(({ id }) => id), ['exact', 'layered', 'single']);
    const { reference } = measured;
    assert.ok(measured.paths > 500 && measured.eventsAPath > 2 && reference.cpu > 0 && reference.build > 0);
    assert.ok(reference.strictPicture.cpu > 0 && reference.picture.cpu > reference.cpu, JSON.stringify(reference));
    const [exact, layered, single] = measured.techniques;
    assert.ok(exact.within1 > 0.97 && layered.within1 > 0.3, JSON.stringify(measured));
    assert.ok(single.within5 < 0.5 && single.readsAPath === 4, 'single reads the first surface, what is on either side of it and its tint');
    assert.ok(exact.readsAPath > 10);
    assert.ok([exact, layered, single].every(({ upload, build }) => upload > 0 && build > 0)); // SetScene builds for all
    const close = (a, b) => assert.ok(Math.abs(a / b - 1) < 0.01, `${a} is not ${b}`);
    for (const { bytesATriangle, meshBytes } of measured.techniques) close(bytesATriangle, meshBytes / 36864);
    close(exact.cpuToReference, exact.cpu / reference.cpu);
    close(exact.cpuToReferencePicture, exact.cpu / reference.strictPicture.cpu);
    close(exact.picture.cpuToReference, exact.picture.cpu / reference.picture.cpu);
    assert.ok(exact.picture.branches === 1 && layered.picture === undefined && single.picture === undefined);
    assert.ok(layered.wallToLayered === 1 && layered.stages.peel.wall > 0 && exact.stages.peel === undefined);
    assert.equal(JSON.parse(vitrine([...args, '-t', 'exact', '--branches', '2', '--json']).text).cases[0].techniques[0].picture.branches, 2);
    const table = readFileSync(join(folder, 'bench.md'), 'utf8');
    assert.match(table, /^`torus`, 36864 triangles, 64 x 64, index 1\.5, .*\n\n\| technique \| frame \|/);
    assert.match(table, /\n\| exact \|/);
    assert.match(table, /\n\| Embree \|.*\n\| Embree, strict picture \|/);
    assert.match(table, /\| picture CPU \/ Embree \|.*\| bytes a triangle \|/);
    assert.match(table, /\n\| technique \| surface \| peel \| merge \|/);
    assert.doesNotMatch(table, /cube|bvh/);
    const widths = new Set(table.split('\n\n')[1].split('\n').map((line) => line.split('|').length));
    assert.equal(widths.size, 1, 'every row has as many cells');
    assert.match(vitrine(['bench', '--help']).text, /--sweep triangles\|resolution/);
  });

  test('bench: sweeps and their plots', { skip: slow && 'a million triangles take minutes under sanitizers' }, () => {
    const result = vitrine(['bench', 'torus', '-t', 'single,exact', '--rounds', '1', '--resolution', '32,32', '--json',
      '--sweep', 'triangles', '--threads', '1']);
    assert.equal(result.code, 0, result.error);
    const report = JSON.parse(result.text), { cases, threads } = report;
    assert.equal(threads, 1);
    assert.equal(cases.length, 6);
    cases.forEach(({ triangles }, i) => {
      const wanted = [1e3, 4e3, 16e3, 64e3, 250e3, 1e6][i];
      assert.ok(Math.abs(triangles / wanted - 1) < 0.05, `${triangles} triangles`);
    });
    const svg = drawPlot(report);
    assert.equal(svg.match(/<polyline/g).length, 5, 'two techniques, a default picture, Embree twice');
    assert.ok(!/NaN|Infinity|undefined/.test(svg), 'every point has a place');
  });

  test('bench: up to 1,000 objects that share a mesh', () => {
    const result = vitrine(['bench', 'torus', '--triangles', '1000', '-t', 'single', '--rounds', '1',
      '--resolution', '48,64', '--json', '--sweep', 'objects', '--table', 'objects.md']);
    assert.equal(result.code, 0, result.error);
    const report = JSON.parse(result.text), { cases } = report;
    assert.deepEqual(cases.map(({ objects }) => objects), [1, 4, 16, 64, 250, 1000]);
    const { meshBytes } = cases[0];
    for (const measured of cases) {
      assert.equal(measured.triangles, measured.objects * cases[0].triangles);
      assert.equal(measured.meshBytes, meshBytes);
      assert.ok(measured.paths > 200 && measured.paths < 48 * 48, `${measured.paths} see glass`);
    }
    const table = readFileSync(join(folder, 'objects.md'), 'utf8');
    assert.equal(new Set(table.split('\n\n')[1].trim().split('\n').map((line) => line.split('|').length)).size, 1);
    assert.equal(drawPlot(report).match(/<polyline/g).length, 3);

    const five = [0, 1, 2, 3, 4].flatMap((x) => ['--object', `cube:scale=0.1,at=${x},0,0`]);
    const few = vitrine(['bench', ...five, '-t', 'single',
      '--rounds', '1', '--resolution', '24,24', '--json', '--sweep', 'objects']);
    assert.deepEqual(JSON.parse(few.text).cases.map(({ objects }) => objects), [1, 4, 16, 64, 250], 'no more than 4,096 in all');
  });

  test('bench: objects one behind the other', () => {
    const result = vitrine(['bench', 'sphere', '-t', 'single', '--rounds', '1', '--resolution', '24,24', '--json', '--sweep', 'depth']);
    assert.equal(result.code, 0, result.error);
    const { cases } = JSON.parse(result.text);
    assert.deepEqual(cases.map(({ objects }) => objects), [1, 2, 4, 8, 16]);
    for (const { paths } of cases) assert.ok(Math.abs(paths / cases[0].paths - 1) < 0.1, `${paths} see glass`);
  });

  test('bench: a relief by its heights and as triangles', () => {
    const args = ['bench', 'ripples', '--rounds', '1', '--resolution', '48,48', '--relief-size', '64'];
    const result = vitrine([...args, '--sweep', 'relief', '--json', '--table', 'relief.md']);
    assert.equal(result.code, 0, result.error);
    const report = JSON.parse(result.text), { cases } = report;
    assert.deepEqual(cases.map(({ samples }) => samples), [4, 8, 16, 32, 64]);
    for (const { techniques: [heights, exact], flip, triangles, samples } of cases) {
      assert.deepEqual([heights.id, exact.id, heights.absent], ['heightfield', 'exact', '']);
      assert.ok(triangles > 2 * (samples - 1) ** 2 && heights.triangulation === 0 && heights.build === 0);
      assert.ok(heights.hostBytes < exact.hostBytes && heights.glassBytes < exact.glassBytes && exact.upload > 0);
      assert.ok(heights.picture.cpuToReference > 0 && exact.picture.cpuToReference > 0);
      assert.ok(flip < 0.01 && heights.agreement.within1 > 0.98 && exact.lost < 0.01, JSON.stringify(heights));
    }
    const [, rows, , agreement] = readFileSync(join(folder, 'relief.md'), 'utf8').split('\n\n');
    assert.match(rows, /\n\| 64 x 64 \| heightfield \|/);
    assert.equal(new Set(rows.split('\n').map((line) => line.split('|').length)).size, 1);
    assert.match(agreement, /\n\| 64 x 64 \| \d+ \|/);
    assert.equal(drawPlot(report).match(/<polyline/g).length, 6);

    const first = vitrine([...args, '--json']);
    assert.throws(() => drawPlot(JSON.parse(first.text)), /add --sweep/);
    assert.deepEqual(JSON.parse(first.text).cases[0].techniques.map(({ id }) => id),
      ['heightfield', 'exact', 'layered', 'single']);
  });

  test('the ladder has a rung of heights for reliefs', () => {
    const table = vitrine(['ladder', 'fluted', '--relief-size', '24', '--resolution', '48,48']).text;
    assert.match(table, /\n\| heightfield \| 2008 \| (100|99)\.\d % \|/);
    assert.doesNotMatch(vitrine(['ladder', 'cube', '--resolution', '24,24']).text, /heightfield/);
  });

  test('bench refuses what it cannot measure', () => {
    const fails = (args, parts) => {
      const result = vitrine(['bench', ...args, '--resolution', '16,16']);
      assert.equal(result.code, 1);
      assert.match(result.error, /^vitrine: [^\n]+\n$/);
      for (const part of parts) assert.ok(result.error.includes(part), `'${part}' is not in: ${result.error}`);
    };
    fails([], ['no model given']);
    fails(['knot', '-t', 'exact,magic'], ["'magic'", 'vitrine list']);
    fails(['knot', '-t', 'reference'], ["'reference'", 'always measured']);
    fails(['knot', '-t', ','], ['names none']);
    fails(['knot', '--sweep', 'time'], ["'time'", 'triangles or resolution']);
    fails(['goblet', '--sweep', 'triangles'], ["'goblet'", 'knot or torus']);
    fails(['knot', '--sweep', 'relief'], ["'knot' is none", 'built-in relief']);
    fails(['ripples', '--sweep', 'relief', '--object', 'cube'], ['leave --object out']);
    fails(['ripples', '--sweep', 'relief', '-t', 'layered'], ['heightfield and exact', 'leave --technique out']);
    fails(['ripples', '--sweep', 'relief', '--relief-size', '16'], ['--relief-size is 16', 'at least 32']);
    fails(['goblet', '--triangles', '5000'], ["'goblet'", 'the knot and the torus can']);
    fails(['knot', '--rounds', '0'], ['--rounds is 0', 'from 1 to 99']);
  });

  test('rays measures a relief and nothing else', () => {
    const args = ['rays', 'ripples', '--relief-size', '33', '--rounds', '1', '--json', '--table', 'rays.md'];
    const measured = vitrine(args);
    if (/without Embree/.test(measured.error)) return;
    assert.equal(measured.code, 0, measured.error);
    const result = JSON.parse(measured.text);
    assert.ok(result.milliseconds.heights.random > 0 && result.milliseconds.withoutBox.camera > 0);
    assert.ok(result.differing[0] + result.differing[1] <= 20);
    const table = readFileSync(join(folder, 'rays.md'), 'utf8');
    assert.match(table, /33 x 33 samples/);
    assert.match(table, /\| heights, through Embree \|/);
    assert.match(table, /The source's method had 0\.93/);
    assert.match(vitrine(['rays', 'knot']).error, /^vitrine: rays: 'knot' is no relief;[^\n]+\n$/);
  });
});

// What glTF files say, as their authors meant it: tests/cases.
describe('glTF files', () => {
  const file = (name) => resolve(here, 'cases', name);
  const inspect = (name) => JSON.parse(vitrine(['inspect', file(name), '--json']).text);
  const draw = (...args) => {
    const result = vitrine(['render', ...args, '-o', 'drawn.png']);
    assert.equal(result.code, 0, result.error);
    return result.error;
  };
  /** Columns from, to, rows from, to of the pixels whose state is other than background. */
  const extent = (name, ...args) => {
    const result = vitrine(['render', file(name), '--directions', 'where.pfm', ...args]);
    assert.equal(result.code, 0, result.error);
    const bytes = readFileSync(join(folder, 'where.pfm'));
    const [, width, height] = bytes.toString('latin1', 0, 40).match(/^PF\n(\d+) (\d+)\n/).map(Number);
    const at = bytes.length - 12 * width * height;
    const found = [width, -1, height, -1];
    for (let i = 0; i < width * height; ++i) {
      if (bytes.readFloatLE(at + 12 * i) === 0 && bytes.readFloatLE(at + 12 * i + 4) === 0 && bytes.readFloatLE(at + 12 * i + 8) === 0) continue;
      const [column, row] = [i % width, height - 1 - Math.floor(i / width)];
      [Math.min, Math.max].forEach((pick, k) => ((found[k] = pick(found[k], column)), (found[k + 2] = pick(found[k + 2], row))));
    }
    return found;
  };
  const view = ['-r', '100,100', '--camera', '0,0,5', '--target', '0,0,0'];

  test('instancing: four balls in a row', () => {
    const { objects, meshes } = inspect('instancing.glb');
    assert.equal(objects.length, 4);
    assert.equal(meshes, 1);
    const [left, right, top, bottom] = extent('instancing.glb', ...view);
    assert.ok(left < 10 && right > 90 && top > 40 && bottom < 60, `${left} ${right} ${top} ${bottom}`);
  });

  test('a skin: 2 x 1 x 0.5 about (0, 1, 0), by its joint', () => {
    const [left, right, top, bottom] = extent('skin-bind.glb', ...view);
    // At depth 4.75 a picture is 3.93 high: the front goes from 24.6 to 75.4 across, and from 11.9 on; at 5.25, where the
    // lower face ends, it is 4.35 high: to 38.5 down.
    assert.deepEqual([left, right, top, bottom], [25, 74, 12, 38]);
  });

  test('keys of unknown extensions', () => {
    assert.match(draw(file('unknown-extension-keys.glb'), ...small), /^vitrine: note: '[^']+': ignored: extension ACME_motion\n$/m);
  });

  test('the default view shows the lamp, not only its bulb', () => {
    const [left, right, top, bottom] = extent('frame-lamp.glb', '-r', '200,200');
    assert.ok(right - left < 30 && bottom < 40 && top > 5, `the bulb: ${left} ${right} ${top} ${bottom}`);
  });

  test('nothing outside the folder is opened, but where --root says so', () => {
    mkdirSync(join(folder, 'models'));
    mkdirSync(join(folder, 'shared'));
    mkdirSync(join(folder, 'models/inner.bin'));
    const { json, bin } = gltf(cube(), '../shared/cube.bin');
    write('shared/cube.bin', bin);
    write('models/near.bin', bin);
    const model = (name, uri) => write(`models/${name}`, JSON.stringify({ ...json, buffers: [{ ...json.buffers[0], uri }] }));
    const outside = model('outside.gltf', '../shared/cube.bin');
    const render = (name, ...args) => ['render', name, ...small, ...args];
    refuses(render(outside), ["its buffer '../shared/cube.bin' lies outside the model's folder", '--root']);
    assert.equal(vitrine([...render(outside, '--root', '.'), '-o', 'a.png']).code, 0);
    assert.equal(vitrine([...render(model('near.gltf', 'near.bin')), '-o', 'b.png']).code, 0);
    assert.ok(readFileSync(join(folder, 'a.png')).equals(readFileSync(join(folder, 'b.png'))));
    refuses(render(outside, '--root', 'nowhere'), ["--root 'nowhere' cannot be found"]);
    refuses(render(outside, '--root', 'models'), ["lies outside the model's folder"]);
    // Links, pipes, devices, folders, standard input.
    symlinkSync('../shared/cube.bin', join(folder, 'models/link.bin'));
    const link = model('link.gltf', 'link.bin');
    refuses(render(link), ['is a link to', 'shared/cube.bin', '--root']);
    assert.equal(vitrine([...render(link, '--root', '.'), '-o', 'c.png']).code, 0);
    symlinkSync('/dev/zero', join(folder, 'models/zero.bin'));
    refuses(render(model('zero.gltf', 'zero.bin')), ["is a link to '/dev/zero'"]);
    refuses(render(model('zero.gltf', 'zero.bin'), '--root', '/'), ['it is no plain file']);
    refuses(render(file('u_zero.gltf')), ['/dev/zero', "lies outside the model's folder"]);
    spawnSync('mkfifo', [join(folder, 'models/pipe.bin')]);
    refuses(render(model('pipe.gltf', 'pipe.bin')), ['it is no plain file']);
    refuses(render(model('inner.gltf', 'inner.bin')), ['it is no plain file']);
    refuses(render(model('minus.gltf', '-'), '-v'), ["its buffer '-' cannot be read"], { input: bin });
    spawnSync('truncate', ['-s', '3G', join(folder, 'models/large.bin')]);
    refuses(render(model('large.gltf', 'large.bin'), '--max-memory', '2G'), ['it has 3221225472 bytes, of which 2147483648 are left to the model', '--max-memory']);
  });

  test('inspect tells what is there and what is drawn', () => {
    const parts = gltf(cube());
    Object.assign(parts.json, {
      animations: [{}], extensionsUsed: ['KHR_materials_clearcoat', 'KHR_materials_transmission'],
      extensions: { KHR_materials_variants: { variants: [{ name: 'blue' }, { name: 'red' }] } },
      cameras: [{ type: 'orthographic', name: 'side', orthographic: { xmag: 2, ymag: 1.5, znear: 0, zfar: 10 } }],
      materials: [{ name: 'coated', pbrMetallicRoughness: { metallicFactor: 0, roughnessFactor: 0 },
        extensions: { KHR_materials_clearcoat: {}, KHR_materials_transmission: { transmissionFactor: 1 }, KHR_materials_volume: { thicknessFactor: 1 } } }],
      nodes: [{ name: 'body', mesh: 0 }, { camera: 0, translation: [0, 0, 6] }],
    });
    parts.json.scenes[0].nodes = [0, 1];
    const name = write('facts.glb', glb(parts));
    const facts = JSON.parse(vitrine(['inspect', name, '--json']).text);
    assert.deepEqual([facts.triangles, facts.meshes, facts.animations, facts.allGlass, facts.nodes], [12, 1, [{ name: '', duration: 0 }], 0, 2]);
    assert.deepEqual(facts.variants, ['blue', 'red']);
    assert.deepEqual(facts.extensionsUsed, parts.json.extensionsUsed);
    assert.deepEqual(facts.boundsMin.concat(facts.boundsMax), [-1, -1, -1, 1, 1, 1]);
    assert.deepEqual(facts.notes, ["'facts.glb': ignored: 2 variants, KHR_materials_clearcoat of 1 material"]);
    assert.deepEqual(facts.materials, [{ index: 0, name: 'coated', drawn: 'KHR_materials_transmission, KHR_materials_volume', ignored: 'KHR_materials_clearcoat' }]);
    assert.deepEqual(facts.objects.map(({ name, made, openEdges }) => [name, made, openEdges]), [['body', 'glass', 0]]);
    assert.deepEqual([facts.cameras[0].name, facts.cameras[0].orthographicHeight], ['side', 3]);
    const text = vitrine(['inspect', name]).text;
    for (const words of ['12 triangles', 'box         -1 -1 -1 to 1 1 1', 'variants    blue, red', 'closed glass   body', 'ignored: KHR_materials_clearcoat', 'orthographic']) {
      assert.ok(text.includes(words), `${words} is not in ${text}`);
    }
    assert.equal(vitrine(['inspect', 'nothing.glb']).code, 1);
    // Numbers of any size, and a name that is no text, are JSON all the same.
    parts.json.nodes[0].scale = [1e-9, 1e-9, 1e-9];
    write('small.glb', glb(parts));
    const result = spawnSync('bash', ['-c', `cp small.glb $'\\xff"\\x7f\\xc3\\xa9.glb'; "${binary}" inspect $'\\xff"\\x7f\\xc3\\xa9.glb' --json`], { cwd: folder });
    const tiny = JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(result.stdout));
    assert.equal(tiny.file, '\ufffd"\x7f\u00e9.glb');
    assert.deepEqual(tiny.boundsMax.map((value) => Math.fround(value)), Array(3).fill(Math.fround(1e-9)));
    assert.match(vitrine(['inspect']).error, /^vitrine: no file given/);
    // Its camera: 2 units of 3 are 43 of 64 rows.
    const [left, right, top, bottom] = extent(join(folder, name), ...small, '--camera-index', 'side');
    assert.deepEqual([left, right, top, bottom], [11, 52, 11, 52]);
    const layered = vitrine(['render', name, ...small, '--camera-index', 'side', '-t', 'layered', '-o', 'no.png']);
    assert.equal(layered.code, 1);
    assert.match(layered.error, /an orthographic projection needs exact/);
    const traced = extent(join(folder, name), ...small, '--camera-index', 'side', '-t', 'reference');
    assert.deepEqual(traced, [left, right, top, bottom]);
  });

  test('animations are drawn at a time', () => {
    const name = write('moving.glb', moving());
    write('still.glb', moving((json) => {
      delete json.animations;
      json.nodes[0].translation = [1, 0, 0];
    }));
    const camera = ['--camera', '0,1,9', '--target', '1,0,0', ...small];
    const draw = (model, ...more) => {
      const { code, out, error } = vitrine(['render', model, ...camera, ...more, '-o', '-']);
      assert.equal(code, 0, error);
      return out;
    };
    const at = draw(name, '--time', '0.5');
    assert.deepEqual(at, draw('still.glb'));
    assert.deepEqual(at, draw(name, '--time', '0.5', '--animation', 'along'));
    assert.deepEqual(draw(name, '--animation', '1'), draw(name, '--time', '0', '--animation', 'up'));
    assert.deepEqual(draw(name), draw(name, '--animation', 'none'));
    assert.deepEqual(draw(name, '--time', '1'), draw(name, '--time', '77')); // the end
    assert.notDeepEqual(at, draw(name, '--time', '0.5', '--animation', 'up'));
    for (const technique of ['reference', 'wyman', 'layered']) {
      assert.deepEqual(draw(name, '--time', '0.5', '-t', technique), draw('still.glb', '-t', technique));
    }
    const placed = ['--object', `${name}:at=0,0.5,0`, '--object', 'sphere:at=0,-1,0'];
    assert.deepEqual(vitrine(['render', ...placed, ...camera, '--time', '0.5', '-o', '-']).out,
      vitrine(['render', '--object', 'still.glb:at=0,0.5,0', '--object', 'sphere:at=0,-1,0', ...camera, '-o', '-']).out);
    // The view shows all times, whichever is drawn.
    const [left] = extent(join(folder, name), ...small, '--time', '0'), [, right] = extent(join(folder, name), ...small, '--time', '1');
    assert.ok(left >= 0 && right <= 63 && right - left > 40, `${left} to ${right}`);
    const rows = JSON.parse(vitrine(['bench', name, ...small, '--rounds', '1', '-t', 'exact', '--time', '1', '--json']).text);
    assert.ok(rows);
    assert.deepEqual(JSON.parse(vitrine(['inspect', name, '--json']).text).animations, [{ name: 'along', duration: 1 }, { name: 'up', duration: 1 }]);
    assert.match(vitrine(['render', name, ...small, '-o', 'rest.png']).error, /ignored: 2 animations/);
    assert.equal(vitrine(['render', name, ...small, '--time', '0', '-o', 'rest.png']).error, '');
  });

  test('what cannot be played is told', () => {
    const name = write('moving.glb', moving());
    refuses(['render', name, '--animation', 'sideways'], ["--animation is 'sideways'", '0 along, 1 up']);
    refuses(['render', name, '--time', '-1'], ['--time is -1', 'from 0']);
    refuses(['render', name, '--time', '1', '--animation', 'none'], ['--time and --animation none contradict']);
    refuses(['render', 'sphere', '--time', '1'], ['--time is given', 'nothing that is drawn has animations']);
    refuses(['render', 'sphere', '--animation', 'walk'], ["--animation is 'walk'", 'nothing that is drawn has animations']);
    const broken = write('broken.glb', moving((json) => (json.animations[0].samplers[0].output = 2)));
    refuses(['render', broken, '--time', '0'], ["model 'broken.glb': animation 0, along, sampler 0", '2 values of 1 numbers for 2 keys of 3']);
    assert.equal(vitrine(['render', broken, '--animation', 'none', ...small, '-o', 'broken.png']).code, 0);
  });

  test("the gallery's models are closed, and nothing is to be said of them", () => {
    const models = join(folder, 'gallery');
    const { status, stderr } = spawnSync(process.execPath, [join(here, '../scripts/gallery-models.mjs'), models], { encoding: 'utf8' });
    assert.equal(status, 0, stderr);
    const names = readdirSync(models).sort();
    assert.deepEqual(names, ['cap.glb', 'collar.glb', 'flacon.glb', 'liquid.glb', 'ring.glb', 'wine.glb']);
    for (const name of names) {
      const { objects, notes } = JSON.parse(vitrine(['inspect', join(models, name), '--json']).text);
      assert.deepEqual([objects.length, objects[0].openEdges, notes], [1, 0, []], name);
      const { code, error } = vitrine(['render', '--object', `${join(models, name)}:ior=1.5`, ...small, '-o', 'gallery.png']);
      assert.deepEqual([code, error], [0, ''], name);
    }
  });

  test('docs/gltf.md has the list of what is drawn', () => {
    const page = readFileSync(join(here, '../docs/gltf.md'), 'utf8');
    const [, table] = page.split('<!-- gltf -->\n\n');
    assert.equal(table.split('\n<!-- end -->')[0], vitrine(['list', '--gltf']).text);
    // Beside others: the same rows, and what is said of Vitrine.
    const firstTwo = (text) => text.trim().split('\n').slice(2).map((line) => line.split(' | ').slice(0, 2).join(' | '));
    const beside = page.split('<!-- peers -->\n\n')[1].split('\n<!-- end of peers -->')[0];
    assert.deepEqual(firstTwo(beside), firstTwo(vitrine(['list', '--gltf']).text));
    for (const line of beside.trim().split('\n').slice(2)) assert.match(line, /^\|[^|]+\| \w+ \|( (yes|no|plugin|\?|no fans|no loops) \|){4}$/);
    const required = scene('required.glb', (json) => (json.extensionsRequired = ['ACME_shape']));
    refuses(['render', required, ...small], ['it requires the extension ACME_shape, which is not supported', 'Supported: EXT_mesh_gpu_instancing']);
  });

  const scene = (name, edit) => {
    const parts = gltf(cube());
    edit(parts.json);
    return write(name, glb(parts));
  };
});

describe('golden images', async () => {
  const libraries = existsSync(join(here, 'node_modules/pixelmatch'));
  const golden = join(here, 'golden');
  const differences = resolve(here, '../build/golden');
  const size = ['--resolution', '192,192'];
  const cases = {
    'sphere-checker': ['sphere', '-e', 'checker'],
    'torus-studio': ['torus', '-e', 'studio'],
    'knot-sky': ['knot', '-e', 'sky'],
    'goblet-studio': ['goblet', '-e', 'studio'],
    'bottle-sky': ['bottle', '-e', 'sky', '--camera', '2,1.2,2.4'],
    'diamond-studio': ['diamond', '-e', 'studio', '--ior', '2.4', '--max-events', '16'],
    'knot-analysis': ['knot', '--analysis'],
    'torus-two-layers': ['torus', '-t', 'layered', '-e', 'checker', '--layers', '2'],
    'technique-layered-cells': ['knot', '-e', 'sky', '-t', 'layered', '--search', 'cells'],
    'ground-goblet': ['goblet', '--ground', '--sun', '1,1.2,-0.8,1', '--ground-color', '0.2,0.18,0.16', '--camera', '1.8,1.6,2.4', '--target=-0.3,-0.5,0'],
    'ground-sky': ['sphere', '--object', 'cube:opaque,at=1.6,-0.6,0,scale=0.4', '-e', 'sky', '--ground', '--camera', '3,2.4,4', '--target', '0.4,-0.4,0'],
    'wyman-farthest': ['knot', '-e', 'sky', '-t', 'wyman', '--back-surface', 'farthest'],
  };
  // One baseline for every row of the technique table.
  const list = vitrine(['list']).text.split('shapes:')[0];
  const techniques = [...list.matchAll(/^  ([a-z-]+) /gm)].map((match) => match[1]);
  for (const id of techniques) cases[`technique-${id}`] = [id === 'heightfield' ? 'ripples' : 'knot', '-e', 'sky', '-t', id];
  // By its heights a relief is the picture that its triangles are, which are drawn here and not kept.
  for (const pattern of slow ? ['hammered'] : ['ripples', 'hammered', 'fluted', 'lens-array']) cases[`heights-${pattern}`] = [pattern, '-e', 'sky'];
  // What glTF's materials can say, scene by scene.
  const { PNG: Png } = libraries ? await import('pngjs') : {};
  const models = libraries ? goldenModels((width, height, pixels) => {
    const png = new Png({ width, height });
    png.data.set(pixels.flat());
    return Png.sync.write(png);
  }) : {};
  for (const [name, { file, args }] of Object.entries(models)) cases[`gltf-${name}`] = [write(`gltf-${name}.glb`, file), ...args];
  for (const [name, args] of Object.entries(cases)) {
    const isMore = slow && /^gltf-|^technique-[kow]|^ground-goblet|-(studio|checker)$/.test(name);
    test(name, { skip: libraries ? isMore && 'more of the same under sanitizers' : 'npm packages are not installed (tests/package.json)' }, async () => {
      const { PNG } = await import('pngjs');
      const { default: pixelmatch } = await import('pixelmatch');
      const file = join(golden, `${name}.png`);
      const result = vitrine(['render', ...args, ...(name.startsWith('gltf-') ? ['--resolution', '160,120'] : size), '-o', '-']);
      assert.equal(result.code, 0, result.error);
      const byTriangles = name.startsWith('heights-') ? vitrine(['render', ...args, '-t', 'exact', ...size, '-o', '-']) : null;
      if (process.env.VITRINE_UPDATE_GOLDEN && !byTriangles) {
        mkdirSync(golden, { recursive: true });
        writeFileSync(file, result.out);
        return;
      }
      const [drawn, wanted] = [PNG.sync.read(result.out), PNG.sync.read(byTriangles?.out ?? readFileSync(file))];
      const picture = new PNG({ width: wanted.width, height: wanted.height });
      // 0.1 is pixelmatch's default for "looks different"; another LLVM may round a few paths elsewhere.
      const different = pixelmatch(drawn.data, wanted.data, picture.data, wanted.width, wanted.height, { threshold: 0.1 });
      if (different > 0) {
        mkdirSync(differences, { recursive: true });
        writeFileSync(join(differences, `${name}.png`), result.out);
        writeFileSync(join(differences, `${name}-difference.png`), PNG.sync.write(picture));
      }
      assert.ok(different <= 0.002 * wanted.width * wanted.height, `${different} pixels differ; see build/golden/`);
    });
  }
});
