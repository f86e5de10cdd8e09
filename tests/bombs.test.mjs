// Files that are small and ask for much are refused in a sentence, soon and with little memory. Needs
// VITRINE_BINARY and VITRINE_BUILD.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, openSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import * as bombs from './bombs.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const binary = resolve(process.env.VITRINE_BINARY ?? join(here, '../build/release/vitrine'));
const measure = join(process.env.VITRINE_BUILD ?? join(here, '../build/release'), 'tests/measure');
const folder = mkdtempSync(join(tmpdir(), 'vitrine-bombs-'));
after(() => rmSync(folder, { recursive: true, force: true }));

// Sanitizers keep memory that was freed, and take several times as long.
const isSanitized = process.env.VITRINE_SANITIZE !== undefined && /asan/.test(process.env.VITRINE_BUILD ?? '');
const mostMegabytes = 256;

function run(args, options = {}) {
  const result = spawnSync(measure, ['60', binary, ...args], { cwd: folder, ...options });
  const lines = result.stderr.toString().trimEnd().split('\n');
  const [seconds, kilobytes] = lines.pop().split(' ').map(Number);
  return { code: result.status, error: lines.join('\n'), seconds, megabytes: kilobytes / 1024, text: result.stdout.toString() };
}

/** What every run takes: the libraries of GL, above all. */
const idle = run(['--version']);

/** Exit code 1 and one sentence with every part, in a second of the processor's time beyond what any run takes. */
function refuses(args, parts, options) {
  const result = run([...args], options);
  assert.equal(result.code, 1, result.error);
  assert.match(result.error, /^vitrine: [^\n]+$/, 'one sentence');
  for (const part of parts) assert.ok(result.error.includes(part), `'${part}' is not in: ${result.error}`);
  assert.ok(!existsSync(join(folder, 'out.png')));
  if (!isSanitized) {
    assert.ok(result.megabytes <= mostMegabytes, `${result.megabytes} MB: ${result.error}`);
    assert.ok(result.seconds - idle.seconds <= 1, `${result.seconds} s: ${result.error}`);
  }
  return result;
}

function write(name, bytes) {
  writeFileSync(join(folder, name), bytes);
  return name;
}

const million = 1e6, triangle = { faces: 1, vertices: 3 };
const small = ['-r', '16,16', '-t', 'reference', '-o', 'out.png'];

describe('models', () => {
  const structure = 'the objects and lists in its JSON take more than 134217728 bytes', much = 'but all that is read of a file may take 4294967296';
  const files = {
    'nodes of nothing.gltf': [() => bombs.jsonList('nodes', '{}', 5 * million), structure],
    'objects that nobody reads.gltf': [() => bombs.jsonList('extras', '{}', 5 * million), structure],
    'lists.gltf': [() => bombs.jsonList('extras', '[]', 5 * million), structure],
    'texts.gltf': [() => bombs.jsonList('extensionsUsed', '""', 5 * million), structure],
    'numbers.gltf': [() => bombs.jsonList('extras', '1', 8 * million), structure],
    'keys.gltf': [() => bombs.manyKeys(million), structure],
    'deep.gltf': [() => bombs.nested(3 * million), structure],
    'a chain of nodes.gltf': [() => bombs.nodeChain(million), structure],
    'a short chain.gltf': [() => bombs.nodeChain(2000), 'its nodes are nested deeper than 1000 levels'],
    'one primitive 20000 times.glb': [() => bombs.manyPrimitives(20000, 60000, 60000), much],
    'triangles.glb': [() => bombs.manyPrimitives(300, 3, 200000), 'it has more than 50000000 triangles'],
    'zeros.glb': [() => bombs.manyZeros(100, 1 << 24), much],
    'sparse.glb': [() => bombs.manySparse(100, 1 << 24), much],
    'morph targets.glb': [() => bombs.manyTargets(20000, 50000), much],
    'poses of a mesh.glb': [() => bombs.manyShapes(4000, 60000), much],
    'samplers.glb': [() => bombs.manySamplers(4000, 1 << 17), much, ['--time', '0']],
    'skins.glb': [() => bombs.manySkins(8000, 8000), 'but there can be 4096'],
    'pictures.glb': [() => bombs.manyPictures(Array(30).fill(bombs.png(8192, 8192))), much],
    'a large picture.glb': [() => bombs.manyPictures([bombs.png(16384, 8192)]), '16384 x 8192 pixels, but at most 67108864 are read'],
    'vertices of meshoptimizer.glb': [() => bombs.meshopt(8 * million), 'in 36 bytes, too few for the 2048000000 that it declares'],
    'triangles of meshoptimizer.glb': [() => bombs.meshopt(12 * million, 'TRIANGLES', 4), 'in 36 bytes, too few for the 48000000 that it declares'],
    'faces of Draco.glb': [() => bombs.draco(300 * million, 100 * million), 'it has more than 50000000 triangles'],
    'faces of Draco, in order.glb': [() => bombs.draco(300 * million, 100 * million, { method: 0 }), 'it has more than 50000000 triangles'],
    'less faces of Draco.glb': [() => bombs.draco(16 * million, 8 * million), 'declares 16000000 triangles and 8000000 vertices, which neither its 67 bytes nor its accessors have'],
    'less faces of Draco, in order.glb': [() => bombs.draco(16 * million, 8 * million, { method: 0 }), 'cannot be unpacked'],
    'by valence.glb': [() => bombs.draco(million, million, { symbols: million, traversal: 2, told: triangle }), 'a packed primitive takes 52000000 bytes', ['--max-memory', '40M']],
    'untold faces of Draco.glb': [() => bombs.draco(49 * million, 8 * million, { symbols: 49 * million, traversal: 2, told: triangle }), 'declares 49000000 triangles and 8000000 vertices'],
    'untold vertices of Draco.glb': [() => bombs.draco(1, 400 * million, { method: 0, told: triangle }), 'declares 1 triangles and 400000000 vertices'],
    'an old version of Draco.glb': [() => bombs.draco(16 * million, 8 * million, { version: [1, 248], symbols: 16 * million, told: triangle }), "has version 1.248 of Draco's bitstream, but glTF has 2.2"],
  };
  for (const [name, [make, part, more]] of Object.entries(files)) {
    test(name, () => {
      refuses(more !== undefined ? ['render', write(name, make()), ...small, ...more] : ['inspect', write(name, make())], [part]);
      rmSync(join(folder, name));
    });
  }

  test('what a limit allows is drawn', () => {
    const name = write('sheet.glb', bombs.sheet(300, 1000));
    refuses(['inspect', name, '--max-triangles', '999'], ['it has more than 999 triangles', '--max-triangles']);
    assert.equal(run(['inspect', name, '--max-triangles', '1K']).code, 0);
    refuses(['render', name, ...small, '--max-memory', '1K'], ["file 'sheet.glb' has", '--max-memory']);
    refuses(['inspect', name, '--max-memory', '64K'], ['take more than 2048 bytes', '--max-memory']);
    assert.equal(run(['inspect', name, '--max-memory', '2M']).code, 0);
    const nodes = write('nodes.gltf', bombs.jsonList('nodes', '{}', 1000));
    refuses(['inspect', nodes, '--max-memory', '10M'], ['take more than 327680 bytes', 'a 32nd']);
    refuses(['inspect', nodes, '--max-memory', '100M'], ['its scene has no triangles']);
  });

  test('words that are no limit', () => {
    for (const word of ['0', '-1', 'much', '1X', '2GB', 'nan', '1e300']) {
      refuses(['render', 'sphere', ...small, '--max-memory', word], [`--max-memory is '${word}'; it must be a number of bytes from 1 on, as 512M or 2G`]);
      refuses(['render', 'sphere', ...small, '--max-pixels', word], [`--max-pixels is '${word}'; it must be a number of pixels from 1 on, as 20M`]);
    }
  });
});

describe('pictures', () => {
  const pixels = '16384 x 8192 pixels, but at most 67108864 are read; scale it down, or allow more (--max-pixels';
  const files = {
    'panorama.png': [() => bombs.png(16384, 8192, { rows: 8192 }), pixels],
    'cut.png': [() => bombs.png(8192, 8192, { bits: 8, type: 6, rows: 10 }), 'it is cut off'],
    'scans.jpg': [() => bombs.jpeg(16384, 8192, 99), pixels],
    'less scans.jpg': [() => bombs.jpeg(2048, 2048, 99), 'it has more than 64 scans'],
    'cut.jpg': [() => bombs.jpeg(8192, 8192, 0, { cut: true }), 'Premature end of JPEG file'],
    'head.hdr': [() => bombs.hdr(16384, 8192), pixels],
    'smaller head.hdr': [() => bombs.hdr(8192, 8192), 'its pixels are cut off'],
    'lines.exr': [() => bombs.exr(8192, 4096, 0), 'OpenEXR'],
    'tiles.exr': [() => bombs.exr(8192, 4096, 1), 'OpenEXR'],
  };
  for (const [name, [make, part]] of Object.entries(files)) {
    test(name, () => {
      write(name, make());
      refuses(['render', 'sphere', '-e', `./${name}`, ...small], [part]);
      rmSync(join(folder, name));
    });
  }

  test('what a limit allows is drawn', () => {
    write('grey.png', bombs.png(64, 32));
    for (const words of [['-e', './grey.png'], ['--background', './grey.png'], ['--object', 'plane:image=grey.png']]) {
      refuses(['render', 'sphere', ...small, ...words, '--max-pixels', '2047'], ['64 x 32 pixels, but at most 2047 are read', '--max-pixels']);
    }
    refuses(['render', 'grey.png', ...small, '--max-pixels', '2047'], ['64 x 32 pixels, but at most 2047']);
    refuses(['compare', 'grey.png', 'grey.png', '--max-pixels', '2047'], ['64 x 32 pixels, but at most 2047']);
    refuses(['compare', 'grey.png', 'grey.png', '--max-memory', '10K'], ['but a file may take 10240']);
    assert.equal(run(['compare', 'grey.png', 'grey.png', '--max-pixels', '2048']).code, 0);
    refuses(['render', 'sphere', '-e', './grey.png', ...small, '--max-memory', '10K'], ['64 x 32 pixels takes 26624 bytes, but a file may take 10240', '--max-memory']);
    refuses(['render', 'sphere', '-r', '64,64', '-o', 'out.png', '--max-pixels', '4095'], ['--resolution is 64,64, 4096 pixels, but at most 4095 are drawn']);
    refuses(['render', 'sphere', '-r', '16384,16384', '-o', 'out.png'], ['268435456 pixels, but at most 67108864 are drawn']);
    assert.equal(run(['render', 'sphere', ...small, '-e', './grey.png', '--max-pixels', '2048']).code, 0);
    rmSync(join(folder, 'out.png'));
  });

  test('large pictures are compared in little memory beside them', () => {
    write('large.png', bombs.png(2000, 2000));
    const { code, megabytes, error } = run(['compare', 'large.png', 'large.png']);
    assert.equal(code, 0, error);
    const most = idle.megabytes + 4 * (2 * (12 + 3)) + 60; // floats and bytes of both, and a band
    if (!isSanitized) assert.ok(megabytes <= most, `${megabytes} MB of ${most}`);
  });

  test('what PNG packs beside its pixels is not unpacked', () => {
    for (const [name, bytes] of [['texts.png', bombs.pngTexts(100, 4 * million)], ['profile.png', bombs.pngProfile(200 * million)]]) {
      write(name, bytes);
      const result = run(['render', 'sphere', ...small, '-e', `./${name}`]);
      assert.equal(result.code, 0, result.error);
      if (!isSanitized) assert.ok(result.megabytes <= mostMegabytes, `${name}: ${result.megabytes} MB`);
    }
    rmSync(join(folder, 'out.png'));
  });
});

describe('what does not end', () => {
  test('a file and standard input', () => {
    const endless = () => ({ stdio: [openSync('/dev/zero', 'r'), 'pipe', 'pipe'] });
    refuses(['render', '/dev/zero', ...small], ['the file is not glTF']);
    refuses(['render', '-', ...small], ['the file is not glTF'], endless());
    refuses(['render', 'sphere', '-e', '/dev/zero', ...small], ['is no picture that can be read']);
    refuses(['render', '--list', '/dev/zero', '-o', '{name}.png'], ['has more than 16777216 bytes']);
    refuses(['render', 'sphere', '--camera-keys', '/dev/zero', '-o', '{frame}.png'], ['has more than 16777216 bytes']);
    refuses(['compare', '/dev/zero', '/dev/zero'], ['/dev/zero']);
  });
});
