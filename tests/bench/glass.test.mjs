// The glass benchmark at its smallest: does it run, and does its report say what it should? Times and shares are not
// judged. Skips itself where something is missing; the packages of tests/bench are not fetched for it.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const root = resolve(here, '../..');
const web = resolve(process.env.VITRINE_WEB ?? join(root, 'build/web'));
const missing = [
  process.env.CHROMIUM ?? '/usr/bin/chromium', join(web, 'vitrine-core.wasm'), join(web, 'demo/assets/bunny.glb'),
  join(root, 'tests/node_modules/playwright-core'), join(here, 'node_modules/@react-three/drei'),
].filter((file) => !existsSync(file));

test('the glass benchmark reports', { skip: missing.length > 0 && `missing: ${missing.join(', ')}` }, (t) => {
  const out = mkdtempSync(join(tmpdir(), 'vitrine-glass-'));
  t.after(() => rmSync(out, { recursive: true }));
  const words = ['--size', '64', '--rounds', '1', '--samples', '1', '--thickness', '3', '--peers', 'physical,transmission,refraction',
    '--techniques', 'layered,nonesuch', '--model', join(web, 'demo/assets/bunny.glb'), '--environment', join(web, 'demo/assets/city.hdr'), '--out', out];
  const { status, stdout, stderr } = spawnSync(process.execPath, [join(here, 'glass.mjs'), ...words], { encoding: 'utf8' });
  assert.equal(status, 0, stderr);

  const report = JSON.parse(readFileSync(join(out, 'report.json'), 'utf8'));
  assert.deepEqual(report.contestants.map(({ name }) => name), ['empty', 'physical', 'transmission', 'refraction', 'layered']);
  assert.deepEqual(report.absent.map(({ name }) => name), ['nonesuch']);
  for (const entry of report.contestants) {
    assert.ok(entry.milliseconds > 0, entry.name);
    if (entry.kind === 'empty') continue;
    for (const share of ['within1', 'within5', 'flip', 'flipReflecting']) assert.ok(entry[share] >= 0 && entry[share] <= 1, `${entry.name} ${share}`);
    assert.ok(existsSync(join(out, `${entry.name}.png`)), entry.name);
    // Background pixels are right whoever draws them: the pictures have the same view, and colours say directions.
    assert.ok(entry.calibration.median < (entry.kind === 'peer' ? 0.3 : 1), `${entry.name}: background off by ${entry.calibration.median} degrees`);
  }
  assert.ok(report.contestants.every(({ name, plainMilliseconds }) => (plainMilliseconds > 0) === ['physical', 'transmission'].includes(name)));
  const layered = report.contestants.find(({ name }) => name === 'layered');
  assert.ok(layered.asNative > 0.97, `browser and native agree in ${layered.asNative}`);
  assert.equal(readFileSync(join(out, 'report.md'), 'utf8'), stdout.trimEnd() + '\n');
  assert.ok(existsSync(join(out, 'sheet.png')));
});

test('a wrong option is answered with a sentence', { skip: !existsSync(join(root, 'tests/node_modules/playwright-core')) && 'missing: node modules' }, () => {
  const { status, stderr } = spawnSync(process.execPath, [join(here, 'glass.mjs'), '--camera', '1,2'], { encoding: 'utf8' });
  assert.equal(status, 1);
  assert.match(stderr, /^bench: --camera is '1,2'; give three numbers/);
});
