// The glass benchmark at its smallest: does it run, does its report say what it should, and do browser and native program
// draw the same? Times are not judged. Skips itself where something is missing; the packages of tests/bench are not
// fetched for it: what needs none of them is tested without. Also first-picture.mjs.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const root = resolve(here, '../..');
const web = resolve(process.env.VITRINE_WEB ?? join(root, 'build/web'));
const binary = resolve(process.env.VITRINE_BINARY ?? join(root, 'build/release/vitrine'));
const needs = [
  process.env.CHROMIUM ?? '/usr/bin/chromium', join(web, 'vitrine-core.wasm'), join(web, 'demo/assets/bunny.glb'), binary,
  join(root, 'tests/node_modules/playwright-core'), join(root, 'tests/node_modules/three'),
];
const skipWithout = (files) => {
  const missing = files.filter((file) => !existsSync(file));
  return missing.length > 0 && `missing: ${missing.join(', ')}`;
};
const skip = skipWithout(needs);

/** Runs it small. */
function glass(t, more, environment = {}) {
  const out = mkdtempSync(join(tmpdir(), 'vitrine-glass-'));
  t.after(() => rmSync(out, { recursive: true }));
  const words = ['--size', '64', '--rounds', '1', '--samples', '1', '--thickness', '3', '--model', join(web, 'demo/assets/bunny.glb'),
    '--environment', join(web, 'demo/assets/city.hdr'), '--out', out, ...more];
  const { status, stdout, stderr } = spawnSync(process.execPath, [join(here, 'glass.mjs'), ...words], { encoding: 'utf8', env: { ...process.env, ...environment } });
  const report = () => JSON.parse(readFileSync(join(out, 'report.json'), 'utf8'));
  return { status, stdout, stderr, out, report };
}

test('the glass benchmark reports', { skip: skip || skipWithout([join(here, 'node_modules/@react-three/drei')]) }, (t) => {
  const { status, stdout, stderr, out, report } = glass(t, ['--peers', 'physical,transmission,refraction', '--techniques', 'layered,exact,exact-plain,nonesuch']);
  assert.equal(status, 0, stderr);

  const { contestants, absent } = report();
  assert.deepEqual(contestants.map(({ name }) => name), ['empty', 'physical', 'transmission', 'refraction', 'layered', 'exact', 'exact-plain']);
  assert.deepEqual(absent.map(({ name }) => name), ['nonesuch']);
  for (const entry of contestants) {
    assert.ok(entry.milliseconds > 0, entry.name);
    if (entry.kind === 'empty') continue;
    const measures = ['within1', 'within5', 'flip', ...(entry.name === 'exact-plain' ? [] : ['flipReflecting'])];
    for (const share of measures) assert.ok(entry[share] >= 0 && entry[share] <= 1, `${entry.name} ${share}`);
    assert.ok(existsSync(join(out, `${entry.name}.png`)), entry.name);
    // Background pixels are right whoever draws them: the pictures have the same view, and colours say directions.
    assert.ok(entry.calibration.median < (entry.kind === 'peer' ? 0.3 : 1), `${entry.name}: background off by ${entry.calibration.median} degrees`);
  }
  assert.deepEqual(contestants.filter(({ plainMilliseconds }) => plainMilliseconds > 0).map(({ name }) => name), ['physical', 'transmission', 'layered', 'exact']);
  assert.equal(readFileSync(join(out, 'report.md'), 'utf8'), stdout.trimEnd() + '\n');
  assert.match(stdout, /^\| Vitrine exact, its defaults \|.*\n\| Vitrine exact, no reflection \|/m);
  assert.ok(existsSync(join(out, 'sheet.png')));
});

for (const gl of ['llvmpipe', 'swiftshader']) {
  test(`browser and native program follow the same paths: ${gl}`, { skip }, (t) => {
    const { status, stderr, report } = glass(t, ['--peers', '', '--techniques', 'exact,exact-plain', '--gl', gl]);
    assert.equal(status, 0, stderr);
    const { renderer, contestants: [, exact, plain] } = report();
    assert.match(renderer, gl === 'llvmpipe' ? /llvmpipe/ : /SwiftShader/);
    for (const { name, asNative, comparedPixels } of [exact, plain]) {
      t.diagnostic(`${name}: ${(100 * asNative).toFixed(2)} % of ${comparedPixels}`);
      assert.ok(asNative >= 0.99, `${name} agrees in ${asNative}`);
      assert.ok(comparedPixels > 700, `${name}: ${comparedPixels} pixels`);
    }
    assert.ok(exact.flip < 0.1, `without reflection as the reference without: FLIP ${exact.flip}`);
  });
}

test('paths that differ fail it with the figure', { skip }, (t) => {
  const folder = mkdtempSync(join(tmpdir(), 'vitrine-glass-'));
  t.after(() => rmSync(folder, { recursive: true }));
  const other = join(folder, 'vitrine'); // the same program, but its exact draws another glass
  writeFileSync(other, `#!/bin/sh\ncase " $* " in *" exact "*) set -- "$@" --ior 1.55;; esac\nexec '${binary}' "$@"\n`, { mode: 0o755 });
  const { status, stderr } = glass(t, ['--peers', '', '--techniques', 'exact'], { VITRINE_BINARY: other });
  assert.equal(status, 1, stderr);
  assert.match(stderr, /^bench: exact: browser and native program agree in \d+\.\d % of \d+ pixels, but it must be 99 %/m);
});

test('the first picture is measured', { skip }, () => {
  const words = ['--src', 'sphere', '--size', '64', '--rounds', '1', '--frames', '2', '--json'];
  const { status, stdout, stderr } = spawnSync(process.execPath, [join(here, 'first-picture.mjs'), ...words], { encoding: 'utf8' });
  assert.equal(status, 0, stderr);
  const { firstPicture, longestBlock, counts, queries, frame } = JSON.parse(stdout);
  assert.ok(firstPicture > longestBlock && longestBlock > 0 && frame > 0, stdout);
  assert.ok(queries >= counts.getParameter && counts.getParameter > 0, stdout);
});

test('rough glass, dispersion and caustics are measured', { skip }, (t) => {
  const out = mkdtempSync(join(tmpdir(), 'vitrine-effects-'));
  t.after(() => rmSync(out, { recursive: true }));
  const effects = (...words) => spawnSync(process.execPath, [join(here, 'effects.mjs'), '--peers', '', '--out', out, '--environment', join(web, 'demo/assets/city.hdr'), ...words], { encoding: 'utf8' });
  const { status, stdout, stderr } = effects('--size', '64', '--rounds', '1', '--samples', '32');
  assert.equal(status, 0, stderr);
  const rows = [...stdout.matchAll(/^\| (.*) \| Vitrine exact \| ([\d.]+) ms \| 1\.00 \| ([\d.]+) \| ([\d.]+) \|$/gm)];
  assert.equal(rows.length, 6, stdout);
  for (const [row, scene, milliseconds, moving, still] of rows) {
    t.diagnostic(row);
    assert.ok(Number(milliseconds) > 0 && Number(moving) < 0.1 && Number(still) < 0.06, row); // smooth glass: 0.115, 0.1; no ground: 0.7
    assert.ok(Number(still) < Number(moving), `${scene}: at rest nearer to the reference`);
  }
  assert.match(effects('--only', 'fog').stderr, /^bench: --only names 'fog'; there are rough, dispersion, caustics/);
});

test('a wrong option is answered with a sentence', { skip: !existsSync(join(root, 'tests/node_modules/playwright-core')) && 'missing: node modules' }, () => {
  const { status, stderr } = spawnSync(process.execPath, [join(here, 'glass.mjs'), '--camera', '1,2'], { encoding: 'utf8' });
  assert.equal(status, 1);
  assert.match(stderr, /^bench: --camera is '1,2'; give three numbers/);
});
