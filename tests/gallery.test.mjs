// The page of examples in headless Chromium on llvmpipe: every snippet alone in a page, and the page of all of them.
// Needs what demo.test.mjs needs; skips itself likewise.
import assert from 'node:assert/strict';
import { existsSync, mkdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { answerWithFile, chromiumPath, launch, listen, openPage, quiet, skipWithout } from './browser-tools.mjs';
import { examples, setup } from '../web/demo/examples.js';

const here = dirname(fileURLToPath(import.meta.url));
const site = resolve(process.env.VITRINE_WEB ?? join(here, '../build/web'));
const screenshots = join(here, '../build/screenshots');
const skip = skipWithout(
  [existsSync(join(here, 'node_modules/axe-core')), "node modules (run 'npm ci' in tests/)"],
  [existsSync(join(site, 'demo/gallery.html')), `${site}/demo/gallery.html`],
  [existsSync(chromiumPath), chromiumPath],
);

/** In the page, before its scripts: one sample a pixel and small pictures, since a software GPU draws them; notes what elements complain of. */
function watch() {
  window.complaints = [];
  const lighten = () => {
    for (const viewer of document.querySelectorAll('vitrine-viewer:not([samples])')) {
      viewer.setAttribute('samples', '1');
      viewer.setAttribute('layers', '2');
      for (const type of ['error', 'warning']) viewer.addEventListener(type, ({ detail }) => window.complaints.push(detail.sourceError?.message ?? detail.sentences.join()));
    }
  };
  new MutationObserver(lighten).observe(document, { childList: true, subtree: true });
}

describe('the page of examples', { skip }, () => {
  let server, browser;

  before(async () => {
    mkdirSync(screenshots, { recursive: true });
    server = await listen((request, response) => {
      const { pathname, searchParams } = new URL(request.url, 'http://localhost');
      if (pathname !== '/alone') return answerWithFile(site, pathname, response);
      const script = setup.replace('vitrine-viewer.bundle.js', '/element/vitrine-viewer.js'); // the bundle of the same (package.test.mjs)
      assert.notEqual(script, setup);
      const page = `<!doctype html><link rel="icon" href="data:,">${script}<main style="width: 240px">${examples[searchParams.get('example')].code.replace('320px', '160px')}</main>`;
      return response.writeHead(200, { 'content-type': 'text/html' }).end(page);
    });
    browser = await launch();
  });
  after(async () => {
    await browser?.close();
    server?.close();
  });

  async function open(t, path, options) {
    const page = await openPage(browser, { reducedMotion: 'reduce', ...options });
    const problems = [];
    page.on('pageerror', ({ message }) => problems.push(message));
    page.on('console', (message) => message.type() === 'error' && problems.push(message.text()));
    t.after(async () => {
      problems.push(...await page.evaluate(() => window.complaints));
      await page.context().close();
      assert.deepEqual(problems, []);
    });
    await page.addInitScript(watch);
    await page.goto(server.address + path);
    return page;
  }

  test('every snippet runs as it stands', async (t) => {
    const page = await open(t, '/alone?example=0');
    for (const [i, { title }] of examples.entries()) {
      if (i > 0) await page.goto(`${server.address}/alone?example=${i}`);
      await page.waitForFunction(() => document.querySelector('vitrine-viewer').loaded || window.complaints.length > 0);
      const { kinds, unknown, alt } = await page.evaluate(async () => {
        const viewer = document.querySelector('vitrine-viewer');
        const bitmap = await createImageBitmap(await viewer.toBlob());
        const pen = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
        pen.drawImage(bitmap, 0, 0);
        const { data } = pen.getImageData(0, 0, bitmap.width, bitmap.height);
        const colors = new Set();
        for (let at = 0; at < data.length; at += 4) colors.add((data[at] >> 4) + 16 * (data[at + 1] >> 4) + 256 * (data[at + 2] >> 4));
        const known = [...viewer.constructor.observedAttributes, 'style', 'alt'];
        return { kinds: colors.size, unknown: viewer.getAttributeNames().filter((name) => !known.includes(name)), alt: viewer.alt };
      });
      assert.deepEqual(await page.evaluate(() => window.complaints), [], title);
      assert.ok(kinds > 20, `${title}: a picture of ${kinds} colours`);
      assert.deepEqual(unknown, [], `${title}: attributes that the element does not know`);
      assert.ok(alt.length > 5, `${title}: alt`);
    }
  });

  test('shows them beside their code, loads what is seen, shares one context a core, copies', async (t) => {
    const page = await open(t, '/demo/gallery.html', { viewport: { width: 420, height: 500 }, permissions: ['clipboard-read', 'clipboard-write'] });
    await page.waitForFunction(() => document.querySelector('vitrine-viewer')?.loaded);
    assert.deepEqual(await page.locator('article pre').allTextContents(), examples.map(({ code }) => code));
    const { viewers, contexts } = await page.evaluate(() => document.querySelector('vitrine-viewer').constructor.statistics());
    assert.ok(viewers >= 1 && viewers < examples.length, `${viewers} viewers while few are in view`);
    assert.equal(contexts, 1);
    await page.getByRole('button', { name: 'Copy the code of “A diamond with fire”' }).click();
    assert.equal(await page.evaluate(() => navigator.clipboard.readText()), examples[1].code);
    await page.waitForFunction(() => document.querySelectorAll('article')[1].textContent.includes('Copied'));
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 420, 'no horizontal scrolling');
    await page.screenshot({ path: join(screenshots, 'gallery.png') });
  });

  test('axe finds nothing', async (t) => {
    const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
    const page = await open(t, '/demo/gallery.html', { viewport: { width: 420, height: 500 } });
    await page.waitForFunction(() => document.querySelector('vitrine-viewer')?.loaded);
    for (const colorScheme of ['dark', 'light']) {
      await page.emulateMedia({ colorScheme });
      await quiet(page);
      const found = await page.evaluate(`(async () => { ${axe}; return (await window.axe.run()).violations; })()`);
      assert.deepEqual(found.map(({ id, nodes }) => [id, ...nodes.map(({ html }) => html)]), []);
    }
  });
});
