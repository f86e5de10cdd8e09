// The same picture by every GL that there is: each technique by EGL and, where VITRINE_LONG asks for it, by Chromium with
// llvmpipe and with SwiftShader, beside OSMesa's. Needs VITRINE_BINARY; scripts/backends.mjs draws.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { boundOf, browsers, compareBackends, hasBackend, hasBrowsers } from '../scripts/backends.mjs';

const takesBrowsers = process.env.VITRINE_LONG === '1' && hasBrowsers;
const skip = !hasBackend('osmesa') ? 'missing: OSMesa' : !hasBackend('egl') && !takesBrowsers && 'missing: EGL';

test('each technique draws the same everywhere', { skip }, async (t) => {
  const table = await compareBackends({ gpus: takesBrowsers ? Object.keys(browsers) : [] });
  for (const [technique, row] of Object.entries(table)) {
    for (const [name, { mean, apart }] of Object.entries(row)) {
      const figures = `${technique}, ${name}: mean difference ${mean.toFixed(4)} of 255, ${(100 * apart).toFixed(3)} % of the pixels apart`;
      t.diagnostic(figures);
      const bound = boundOf(technique, name);
      assert.ok(mean <= bound.mean && apart <= bound.apart, figures);
    }
  }
});
