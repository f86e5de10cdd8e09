// The same picture by every GL that there is: each technique by EGL and, where VITRINE_LONG asks for it, by Chromium with
// llvmpipe and with SwiftShader and by Firefox, beside OSMesa's. Needs VITRINE_BINARY; scripts/backends.mjs draws.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { boundOf, browsersHere, compareBackends, hasBackend } from '../scripts/backends.mjs';

const takesBrowsers = process.env.VITRINE_LONG === '1' && browsersHere.length > 0;
const skip = !hasBackend('osmesa') ? 'missing: OSMesa' : !hasBackend('egl') && !takesBrowsers && 'missing: EGL';

test('each technique draws the same everywhere', { skip }, async (t) => {
  const table = await compareBackends(takesBrowsers ? browsersHere : []);
  for (const [technique, row] of Object.entries(table)) {
    for (const [name, { mean, apart }] of Object.entries(row)) {
      const figures = `${technique}, ${name}: mean difference ${mean.toFixed(4)} of 255, ${(100 * apart).toFixed(3)} % of the pixels apart`;
      t.diagnostic(figures);
      const bound = boundOf(technique, name);
      assert.ok(mean <= bound.mean && apart <= bound.apart, figures);
    }
  }
});
