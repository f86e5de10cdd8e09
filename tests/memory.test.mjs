// Whole programs whose memory is out: every allocation of the command line and its picture libraries fails in turn.
// Needs VITRINE_BINARY and, of VITRINE_BUILD, tests/libfailing_memory.so.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { PNG } from 'pngjs';
import { moving } from './moving-model.mjs';

const build = resolve(process.env.VITRINE_BUILD ?? join(dirname(fileURLToPath(import.meta.url)), '../build/release'));
const binary = resolve(process.env.VITRINE_BINARY ?? join(build, 'vitrine'));
const failing = join(build, 'tests/libfailing_memory.so');
const isLong = process.env.VITRINE_LONG === '1';
const folder = mkdtempSync(join(tmpdir(), 'vitrine-memory-'));
after(() => rmSync(folder, { recursive: true, force: true }));

/** A run in a folder of its own; how many allocations it made, null where it ended by a signal. */
function vitrine(args, name, variables) {
  const cwd = join(folder, name), count = join(folder, `${name}.count`);
  mkdirSync(cwd);
  return new Promise((done) => {
    const child = spawn(binary, args, { cwd, stdio: ['ignore', 'ignore', 'pipe'], env: { ...process.env, LD_PRELOAD: failing, VITRINE_FAILING_COUNT: count, ...variables } });
    let error = '';
    child.stderr.on('data', (text) => { error += text; });
    child.on('close', (code, signal) => {
      const files = Object.fromEntries(readdirSync(cwd).map((file) => [file, readFileSync(join(cwd, file)).toString('base64')]));
      const allocations = existsSync(count) ? Number(readFileSync(count)) : null;
      for (const gone of [cwd, count]) rmSync(gone, { recursive: true, force: true });
      done({ code, signal, error, files, allocations });
    });
  });
}

/** What is wrong with a run some of whose memory was out, beside one that had all; undefined: nothing. */
function faultOf(run, whole) {
  if (run.signal !== null) return `ends by ${run.signal}`;
  if (run.code !== 0 && run.code !== 1) return `ends with code ${run.code}`;
  const said = run.error.split('\n').filter((line) => line !== '' && !whole.error.includes(line) && !/^\d+ of \d+ pictures/.test(line));
  if (run.code === 1 && !said.some((line) => line.startsWith('vitrine: ')) || said.some((line) => !/^vitrine: .{15,}/.test(line))) return 'not a sentence of ours';
  if (run.code === 0 && Object.keys(run.files).length !== Object.keys(whole.files).length) return 'a file is missing, and nothing is said';
  const half = Object.keys(run.files).find((file) => run.files[file] !== whole.files[file]);
  return half === undefined ? undefined : `${half} is not the file that it should be`;
}

/** Every allocation alone, then with all that follow; a part of them in the short run. */
async function failEach(args) {
  const whole = await vitrine(args, 'whole', {});
  assert.equal(whole.code, 0, whole.error);
  assert.ok(whole.allocations > 5, `${whole.allocations} allocations`);
  const runs = ['alone', 'lasting'].flatMap((kind, i) =>
    Array.from({ length: whole.allocations }, (_, n) => [kind, n]).filter(([, n]) => isLong || n % 24 === 12 * i));
  const faults = [];
  const work = async () => {
    for (let next = runs.shift(); next !== undefined; next = runs.shift()) {
      const [kind, n] = next;
      const run = await vitrine(args, `${kind}-${n}`, { VITRINE_FAILING: `${n}`, ...(kind === 'lasting' ? { VITRINE_FAILING_LASTING: '1' } : {}) });
      const fault = faultOf(run, whole);
      if (fault !== undefined) faults.push(`allocation ${n} fails, ${kind}: ${fault}; ${run.error.trim()}`);
    }
  };
  await Promise.all([work(), work()]);
  assert.deepEqual(faults, []);
  return whole.allocations;
}

before(() => {
  const picture = new PNG({ width: 8, height: 4 });
  picture.data.forEach((_, i) => { picture.data[i] = i % 4 === 3 ? 255 : (37 * i) % 256; });
  const bytes = PNG.sync.write(picture);
  writeFileSync(join(folder, 'a.png'), bytes);
  picture.data[0] ^= 64;
  writeFileSync(join(folder, 'b.png'), PNG.sync.write(picture));
  writeFileSync(join(folder, 'model.glb'), moving());
  writeFileSync(join(folder, 'list.txt'), 'sphere\ncube\n');
});

const small = ['-r', '8,8'];
for (const [name, args] of [
  ['render: a model, a panorama, a background', ['render', '../model.glb', '-o', 'x.png', '-e', '../a.png', '--background', '../b.png', '--directions', 'x.pfm', ...small]],
  ['render: floats', ['render', 'sphere', '-o', 'x.exr', ...small]],
  ['render: a picture of heights and further objects', ['render', '../a.png', '--object', 'cube', '-o', 'x.hdr', ...small]],
  ['render: compared with a picture', ['render', 'sphere', '-o', 'x.png', '-r', '8,4', '--reference', '../a.png', '--reference-threshold', '1']],
  ['render: frames', ['render', '../model.glb', '-o', '{frame}.png', '--turntable', '2', ...small]],
  ['render: models of a list', ['render', '--list', '../list.txt', '-o', '{name}.png', ...small]],
  ['render: reference', ['render', '../model.glb', '-t', 'reference', '-o', 'x.png', '-e', '../a.png', ...small]],
  ['render: layers', ['render', 'sphere', '-t', 'layered', '--layer-sheet', 'sheet.png', ...small]],
  ['compare', ['compare', '../a.png', '../b.png', '--json', '--difference', 'x.png']],
  ['inspect', ['inspect', '../model.glb', '--json']],
]) {
  test(name, async () => {
    const count = await failEach(args);
    console.log(`${name}: ${count} allocations`);
  });
}
