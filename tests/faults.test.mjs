// <vitrine-viewer> in Chromium where WebGL fails: whichever call it is, the picture is right or there is a sentence,
// other elements keep theirs, and once WebGL works again so does the element. Needs what element.test.mjs needs.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { png, sheet } from './bombs.mjs';
import { ball, model, solid } from './case-models.mjs';
import { answerWithFile, chromiumPath, launch, listen, openPage, skipWithout } from './browser-tools.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const site = resolve(process.env.VITRINE_WEB ?? join(here, '../build/web'));
const modules = await import('playwright-core').catch(() => null);
const skip = skipWithout(
  [modules, "node modules (run 'npm ci' in tests/)"],
  [existsSync(join(site, 'element/vitrine-viewer.js')), `${site}/element`],
  [existsSync(chromiumPath), chromiumPath],
);

const long = process.env.VITRINE_LONG === '1'; // nothing left out

const page = `<!doctype html><html lang="en"><title>Test</title><link rel="icon" href="data:,">
  <style>body { margin: 0 } vitrine-viewer { width: 32px; height: 32px; display: block }</style>
  <script type="module" src="/element/vitrine-viewer.js"></script><div id="place"></div>`;

const hdr = (width, height) => Buffer.concat([Buffer.from(`#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`), Buffer.alloc(4 * width * height, 128)]);
const manyNodes = (json) => json.nodes.push(...Array.from({ length: 40000 }, (_, i) => ({ name: `node ${i}` })));

/** The first three take more memory than there is at first: of C, of C++, of a picture. */
const files = {
  '/round.glb': () => model([{ mesh: ball(1, 200), material: solid([1, 1, 1]) }]),
  '/nodes.glb': () => sheet(30, 10, manyNodes),
  '/sky.hdr': () => hdr(2048, 1024),
  '/picture.png': () => png(64, 32),
};

/** In the page, before its scripts: the n-th call of some name fails as WebGL has it; and what tests do there. */
function simulate() {
  const { prototype } = WebGL2RenderingContext;
  const fault = (window.fault = { name: '', at: 0, calls: 0, error: 0, isBare: false, isTiny: false, refused: [] });
  const real = {};
  const wrap = (name, act) => {
    real[name] = prototype[name];
    prototype[name] = function (...values) {
      return act.call(this, (...others) => real[name].apply(this, others.length > 0 ? others : values), ...values);
    };
  };
  const fails = (name) => fault.name === name && ++fault.calls === fault.at;
  const outOfMemory = 0x0505;
  const refuses = (what, isTooMuch) => {
    if (fault.isTiny && isTooMuch) fault.refused.push(what);
    return false;
  };
  wrap('getError', function (call) {
    const { error } = fault;
    fault.error = 0;
    return error || call();
  });
  for (const name of ['texStorage2D', 'texStorage3D', 'bufferData', 'texSubImage2D', 'drawArrays', 'drawElements']) {
    wrap(name, function (call, ...values) {
      if (name === 'texStorage2D') refuses(name, values[3] > 2048 || values[4] > 2048);
      if (name === 'texStorage3D') refuses(name, values[3] > 2048 || values[4] > 2048 || values[5] > 256);
      if (!fails(name)) return call();
      fault.error = outOfMemory;
    });
  }
  // One without any attachment is not complete.
  wrap('bindFramebuffer', (call) => {
    fault.isBare = false;
    call();
  });
  for (const [name, bare] of [['framebufferTexture2D', [0x0de1, null, 0]], ['framebufferTextureLayer', [null, 0, 0]]]) {
    wrap(name, (call, target, point) => {
      fault.isBare ||= point === 0x8ce0 && fails(name); // its first
      if (fault.isBare) call(target, point, ...bare);
      else call();
    });
  }
  wrap('drawBuffers', (call, buffers) => refuses('drawBuffers', buffers.length > 4) || call());
  wrap('activeTexture', (call, unit) => refuses('activeTexture', unit >= 0x84c0 + 32) || call());
  wrap('shaderSource', (call, shader, text) => call(shader, fails('compileShader') ? '#version 300 es\n#error simulated\n' : text));
  wrap('linkProgram', function (call, program) {
    if (fails('linkProgram')) return;
    call();
    if (!fault.isTiny) return;
    let samplers = 0;
    for (let i = 0; i < this.getProgramParameter(program, this.ACTIVE_UNIFORMS); ++i) samplers += /SAMPLER/.test(Object.keys(prototype).find((key) => /SAMPLER/.test(key) && this[key] === this.getActiveUniform(program, i).type) ?? '') ? 1 : 0;
    refuses(`${samplers} samplers`, samplers > 16);
  });
  wrap('getParameter', function (call, name) {
    const least = { [this.MAX_TEXTURE_SIZE]: 2048, [this.MAX_ARRAY_TEXTURE_LAYERS]: 256, [this.MAX_DRAW_BUFFERS]: 4, [this.MAX_COLOR_ATTACHMENTS]: 4, [this.MAX_TEXTURE_IMAGE_UNITS]: 16, [this.MAX_COMBINED_TEXTURE_IMAGE_UNITS]: 32 };
    return fault.isTiny && name in least ? least[name] : call();
  });
  wrap('getExtension', (call, name) => (fault.isTiny && /float|parallel/.test(name) ? null : call()));
  wrap('getSupportedExtensions', (call) => (fault.isTiny ? [] : call()));

  // The memory of WebAssembly does not grow from the n-th time on.
  const { grow } = WebAssembly.Memory.prototype;
  WebAssembly.Memory.prototype.grow = function (pages) {
    if (fault.name === 'grow' && ++fault.calls >= fault.at) throw new RangeError('simulated');
    return grow.call(this, pages);
  };

  // The context is lost at the n-th call of any of those, or of one, and given back after a while.
  const loses = ['texStorage2D', 'bufferData', 'shaderSource', 'linkProgram', 'drawArrays', 'fenceSync'];
  for (const name of [...loses, 'getProgramParameter', 'getSyncParameter']) {
    const before = prototype[name];
    prototype[name] = function (...values) {
      const isLost = (fault.name === 'loss' || fault.name === `loss in ${name}`) && ++fault.calls === fault.at;
      if (isLost) {
        const loss = this.getExtension('WEBGL_lose_context');
        loss.loseContext();
        setTimeout(() => loss.restoreContext(), 50);
      }
      return before.apply(this, values);
    };
  }

  const pixels = async (viewer) => {
    const { data } = await viewer.toBlob().then(createImageBitmap).then((bitmap) => {
      const context = new OffscreenCanvas(32, 32).getContext('2d');
      context.drawImage(bitmap, 0, 0);
      return context.getImageData(0, 0, 32, 32);
    });
    return data.join();
  };
  const make = (technique) => Object.assign(document.createElement('vitrine-viewer'), { src: 'diamond', environmentImage: 'studio', skyboxImage: ' ', samples: 2, interpolationDecay: 0, technique });
  const says = (viewer) => {
    const part = viewer.shadowRoot.querySelector('[part=message]');
    return part.hidden ? '' : part.textContent;
  };
  const until = async (what, holds) => {
    for (const end = performance.now() + 120000; !holds();) {
      if (performance.now() > end) throw new Error(`waited in vain: ${what()}`);
      await new Promise((done) => setTimeout(done, 5));
    }
  };
  /** Has it that picture, or gets it? The model before may still be there. */
  const comesTo = async (viewer, expected) => {
    let seen = await pixels(viewer);
    for (let i = 0; seen !== expected && i < 100; ++i) {
      await new Promise((done) => setTimeout(done, 20));
      seen = await pixels(viewer);
    }
    return seen === expected;
  };
  window.setFault = (name, at) => Object.assign(fault, { name, at, calls: 0, error: 0 });
  /** A new element under a fault, then without: what it said, and whether its pictures are right. */
  window.play = async (technique, name, at, expected) => {
    const viewer = make(technique), errors = [];
    viewer.addEventListener('error', ({ detail }) => errors.push(detail.sourceError.message));
    window.setFault(name, at);
    window.place.append(viewer);
    await until(() => `${technique}, ${name} ${at}: ${says(viewer)}`, () => viewer.loaded || says(viewer));
    const said = says(viewer), hit = fault.calls >= at;
    const seen = viewer.loaded && !said && !name.startsWith('loss') ? await pixels(viewer).catch(({ message }) => message) : expected;
    window.setFault('', 0);
    if (/graphics context/.test(said)) await until(() => `${technique}, ${name} ${at}, back: ${says(viewer)}`, () => viewer.loaded && !says(viewer));
    Object.assign(viewer, { environmentImage: 'sky' });
    Object.assign(viewer, { src: 'cube' });
    await new Promise((done) => setTimeout(done, 20));
    Object.assign(viewer, { src: 'diamond', environmentImage: 'studio' });
    await until(() => `${technique}, ${name} ${at}, again: ${says(viewer)}`, () => viewer.loaded && !says(viewer));
    const isRight = await comesTo(viewer, expected);
    viewer.remove();
    await new Promise((done) => setTimeout(done));
    return { hit, said: said || (/GL_/.test(seen) ? seen : ''), isTold: !said || errors.length > 0, errors, wrong: seen !== expected && !/GL_/.test(seen), stays: !isRight };
  };
  window.expect = async (technique, more = {}) => {
    const viewer = Object.assign(make(technique), more);
    window.place.append(viewer);
    await until(() => says(viewer), () => viewer.loaded);
    const seen = await pixels(viewer);
    viewer.remove();
    await new Promise((done) => setTimeout(done));
    return seen;
  };
  /** A new element whose memory does not grow from the n-th time on, then a smaller model in it: what it said, and whether the latter is right. */
  window.outgrow = async (wish, at, expected) => {
    const viewer = make('exact'), errors = [];
    viewer.addEventListener('error', ({ detail }) => errors.push(detail.sourceError.message));
    window.setFault('grow', at);
    Object.assign(viewer, wish);
    window.place.append(viewer);
    await until(() => `${JSON.stringify(wish)}, growth ${at}: ${says(viewer)}`, () => viewer.loaded || says(viewer));
    await new Promise((done) => setTimeout(done, 50)); // what comes after the first frame
    const said = says(viewer), hit = fault.calls >= at;
    Object.assign(viewer, { src: 'diamond', relief: null, ground: false, environmentImage: 'studio' });
    await until(() => `${JSON.stringify(wish)}, growth ${at}, a smaller model: ${says(viewer)}`, () => viewer.loaded && !says(viewer));
    const isRight = await comesTo(viewer, expected);
    viewer.remove();
    window.setFault('', 0);
    return { hit, said, isTold: !said || errors.length > 0, isRight };
  };
  /** What a new element says, with limits and once they are gone; '': it shows all of it. */
  window.limit = async (wish, limits) => {
    const viewer = Object.assign(make(null), { src: 'cube', ...wish, ...limits });
    window.place.append(viewer);
    const answer = async () => {
      await until(() => `${JSON.stringify({ ...wish, ...limits })}: ${says(viewer)}`, () => viewer.loaded || says(viewer));
      if (!says(viewer)) await pixels(viewer);
      return says(viewer);
    };
    const first = await answer();
    for (const name of Object.keys(limits)) viewer[name] = null;
    await until(() => `${JSON.stringify(wish)}, without ${JSON.stringify(limits)}: ${says(viewer)}`, () => viewer.loaded && !says(viewer));
    viewer.remove();
    return first;
  };
  /** What an element of its own says. */
  window.refuse = async (wish) => {
    const viewer = Object.assign(make(null), wish);
    window.place.append(viewer);
    await until(() => 'no sentence', () => says(viewer));
    const said = says(viewer);
    viewer.remove();
    return said;
  };
  /** An element that has a model is asked for one that the memory is too small for. @returns {{said: string, stays: boolean, turns: boolean}} the model before does, and can be seen from elsewhere */
  window.outgrowLater = async (wish, expected) => {
    const viewer = await window.keep();
    window.setFault('grow', 1);
    Object.assign(viewer, wish);
    await until(() => JSON.stringify(wish), () => says(viewer));
    const said = says(viewer), stays = await comesTo(viewer, expected);
    viewer.cameraOrbit = '30deg 60deg auto';
    await new Promise((done) => setTimeout(done, 50));
    const turns = (await pixels(viewer)) !== expected;
    window.setFault('', 0);
    return { said, stays, turns };
  };
  /** One that stays, so that the context does. */
  window.keep = async () => {
    const viewer = make('exact');
    window.place.append(viewer);
    await until(() => says(viewer), () => viewer.loaded);
    return viewer;
  };
  window.pixels = pixels;
}

/** A server that never ends its answer. @returns {Promise<number>} how many bytes it sent until nobody read on */
function sendEndlessly(response) {
  const chunk = Buffer.alloc(65536, 'glTF');
  let sent = 0;
  response.writeHead(200, { 'content-type': 'application/octet-stream' });
  const more = () => {
    do sent += chunk.length; while (response.write(chunk));
  };
  response.on('drain', more);
  more();
  return new Promise((closed) => response.on('close', () => closed(sent)));
}

describe('the element where WebGL fails', { skip }, () => {
  let server, browser, endless;

  before(async () => {
    server = await listen((request, response) => {
      const { pathname } = new URL(request.url, 'http://localhost');
      if (files[pathname]) response.writeHead(200, { 'content-type': 'application/octet-stream' }).end(files[pathname]());
      else if (pathname === '/endless.glb') endless = sendEndlessly(response);
      else if (pathname === '/') response.writeHead(200, { 'content-type': 'text/html' }).end(page);
      else answerWithFile(site, pathname, response);
    });
    browser = await launch();
  });
  after(async () => {
    await browser?.close();
    server?.close();
  });

  async function open(t) {
    const opened = await openPage(browser, { viewport: { width: 200, height: 200 } });
    const thrown = [];
    opened.on('pageerror', (error) => thrown.push(String(error)));
    t.after(async () => {
      await opened.context().close();
      assert.deepEqual(thrown, []);
    });
    await opened.addInitScript(simulate);
    await opened.goto(server.address);
    await opened.waitForFunction(() => customElements.get('vitrine-viewer'));
    return opened;
  }

  /** All calls of that name in turn; isFresh: each in a context of its own, with programs to compile. */
  const failEach = (opened, names, ids, isFresh = false) => opened.evaluate(async ([calls, techniquesToTry, isAnew]) => {
    const answers = [];
    let kept = null, before, others = true;
    const renew = async () => {
      kept?.remove();
      await new Promise((done) => setTimeout(done));
      kept = await window.keep();
      before = await window.pixels(kept);
    };
    for (const technique of techniquesToTry) {
      const expected = await window.expect(technique);
      for (const name of calls) {
        for (let at = 1; at <= 40; ++at) {
          if (isAnew || kept === null) await renew();
          const answer = await window.play(technique, name, at, expected);
          if (!answer.hit) break;
          answers.push({ technique, name, at, ...answer });
          others &&= (await window.pixels(kept)) === before;
        }
      }
    }
    return { answers, others };
  }, [names, ids, isFresh]);

  function judge(t, { answers, others }, least) {
    t.diagnostic(`${answers.length} faults, ${answers.filter(({ said }) => said).length} sentences, as '${answers.find(({ said }) => said)?.said}'`);
    assert.ok(answers.length >= least, `${answers.length} faults`);
    for (const { technique, name, at, isTold, wrong, stays } of answers) {
      const where = `${technique}, ${name} ${at}`;
      assert.ok(!wrong, `${where}: another picture, and nothing said`);
      assert.ok(!stays, `${where}: another picture afterwards`);
      assert.ok(isTold, `${where}: no error event`);
    }
    assert.ok(others, 'the other element has its picture');
  }

  test('no memory, and framebuffers that are not complete', async (t) => {
    const answer = await failEach(await open(t), ['texStorage2D', 'texStorage3D', 'framebufferTexture2D', 'framebufferTextureLayer', 'bufferData', 'drawArrays'], ['exact']);
    judge(t, answer, 5);
    assert.ok(answer.answers.some(({ said }) => /GL_OUT_OF_MEMORY/.test(said)));
    assert.ok(answer.answers.some(({ said }) => /FRAMEBUFFER/.test(said)));
  });

  test('shaders that do not compile, and programs that do not link', async (t) => {
    const answer = await failEach(await open(t), ['compileShader', 'linkProgram'], long ? ['layered', 'wyman'] : ['wyman'], true);
    judge(t, answer, 5);
    for (const fits of [/does not compile: .*simulated/, /does not link/]) assert.ok(answer.answers.some(({ said }) => fits.test(said)), `${fits}`);
  });

  test('a context that is lost while loading, while compiling and in a frame', async (t) => {
    const opened = await open(t);
    const answers = await opened.evaluate(async () => {
      const expected = await window.expect('layered'), found = [];
      const lose = async (name, at) => found.push({ at, name, ...(await window.play('layered', name, at, expected)) });
      for (let at = 1; at < 40; at += 6) await lose('loss', at); // each in a context of its own, with programs to compile
      for (const at of [1, 3]) {
        await lose('loss in linkProgram', at);
        await lose('loss in getProgramParameter', at);
      }
      return found;
    });
    t.diagnostic(`${answers.filter(({ hit }) => hit).length} losses; said: ${[...new Set(answers.map(({ said }) => said))].join(' | ')}`);
    assert.ok(answers.filter(({ hit }) => hit).length >= 5);
    for (const { name, at, hit, errors, stays } of answers) {
      assert.ok(hit || name === 'loss', `${name}, call ${at}: not reached`);
      assert.ok(!stays, `${name}, call ${at}: another picture afterwards`);
      assert.deepEqual(errors.filter((sentence) => !/context was lost/.test(sentence)), [], `${name}, call ${at}: nothing else is said`);
    }
  });

  test('no more than WebGL 2 has at least, and no float targets', async (t) => {
    const opened = await open(t);
    const pictures = {
      exact: ['exact'],
      layered: ['layered'],
      heightfield: ['heightfield', { src: 'ripples' }],
      ground: ['exact', { ground: true, groundColor: '0.5,0.5,0.5' }],
      ...(long && {
        ...Object.fromEntries(['oliveira', 'wyman', 'single', 'kay-thickness', 'kay-nonlinear', 'kay-linear'].map((technique) => [technique, [technique]])),
        rough: ['exact', { roughness: 0.3, dispersion: 0.5, environmentImage: 'sky' }],
        opaque: ['exact', { objects: 'cube:opaque,at=2,0,0', background: 'blurred' }],
      }),
    };
    const answer = await opened.evaluate(async (all) => {
      const seen = {};
      for (const [name, [technique, more]] of Object.entries(all)) {
        window.fault.isTiny = false;
        const usual = await window.expect(technique, more);
        window.fault.isTiny = true;
        seen[name] = { isSame: (await window.expect(technique, more)) === usual, colours: new Set(usual.split(',')).size };
      }
      return { seen, refused: window.fault.refused };
    }, pictures);
    assert.deepEqual(answer.refused, []);
    for (const [name, { isSame, colours }] of Object.entries(answer.seen)) {
      assert.ok(isSame, `${name}: another picture`);
      assert.ok(colours > 5, `${name}: ${colours} values`);
    }
  });

  test('memory of WebAssembly that does not grow', async (t) => {
    const wishes = [{ src: 'round.glb' }, { src: 'nodes.glb' }, { environmentImage: 'sky.hdr' }, ...(long ? [{ relief: 'sky.hdr' }, { src: 'nodes.glb', ground: true }] : [])], answers = [];
    for (const wish of wishes) {
      for (let at = 1, hit = true; hit && (long || at === 1); ++at) {
        const opened = await open(t); // with memory that has not grown yet
        const answer = await opened.evaluate(async ([what, growth]) => {
          const kept = await window.keep(), before = await window.pixels(kept), expected = await window.expect('exact');
          return { ...(await window.outgrow(what, growth, expected)), others: (await window.pixels(kept)) === before };
        }, [wish, at]);
        ({ hit } = answer);
        answers.push({ what: `${JSON.stringify(wish)}, growth ${at}`, ...answer });
      }
    }
    const later = await (await open(t)).evaluate(async () => window.outgrowLater({ src: 'nodes.glb' }, await window.expect('exact')));
    assert.deepEqual(later, { said: 'nodes.glb: too large for the memory of this page', stays: true, turns: true });
    for (const { what, said, isTold, isRight, others } of answers) {
      t.diagnostic(`${what}: ${said}`);
      assert.ok(isRight, `${what}: another picture afterwards`);
      assert.ok(others, `${what}: another element has another picture`);
      assert.ok(isTold, `${what}: no error event`);
    }
    assert.ok(answers.filter(({ said }) => /memory/.test(said)).length >= wishes.length);
  });

  test('limits of what a file may ask for', async (t) => {
    const opened = await open(t);
    const pixels = /64 x 32 pixels, but at most 2047 are read/;
    for (const [wish, limits, sentence] of [
      [{ src: 'round.glb' }, { maxTriangles: 159199 }, /more than 159199 triangles/],
      [{ src: 'round.glb' }, { maxTriangles: 159200 }, /^$/],
      [{ src: 'round.glb' }, { maxMemory: 1e6 }, /^round\.glb: it has more than 1000000 bytes; make it smaller, or allow more \(max-memory\)$/],
      [{ src: 'round.glb' }, { maxMemory: 4e6 }, /takes \d+ bytes, but all that is read of a file may take 4000000/],
      [{ src: 'nodes.glb' }, { maxMemory: 1e8 }, /JSON take more than 3125000 bytes/],
      [{ environmentImage: 'sky.hdr' }, { maxPixels: 1e6 }, /2048 x 1024 pixels, but at most 1000000 are read/],
      [{ environmentImage: 'sky.hdr' }, { maxMemory: 1e7 }, /2048 x 1024 pixels takes \d+ bytes, but a file may take 10000000/],
      [{ environmentImage: 'picture.png' }, { maxPixels: 2047 }, pixels],
      [{ environmentImage: 'picture.png' }, { maxPixels: 2048 }, /^$/],
      [{ background: './picture.png' }, { maxPixels: 2047 }, pixels],
      [{ relief: 'picture.png' }, { maxPixels: 2047 }, pixels],
      [{ relief: 'sky.hdr' }, { maxPixels: 1e6 }, /2048 x 1024 pixels, but at most 1000000 are read/],
      [{}, { maxPixels: 0 }, /max-pixels is '0'; it must be a whole number from 1 to/],
    ]) {
      assert.match(await opened.evaluate(([what, most]) => window.limit(what, most), [wish, limits]), sentence, JSON.stringify({ ...wish, ...limits }));
    }
    const said = await opened.evaluate(() => window.refuse({ src: 'endless.glb', maxMemory: 3e6 }));
    assert.equal(said, 'endless.glb: it has more than 3000000 bytes; make it smaller, or allow more (max-memory)');
    const sent = await endless;
    assert.ok(sent < 3e7, `${sent} bytes were sent`);
    const later = await opened.evaluate(async () => { // of an element whose module has no limits
      const expected = await window.expect('exact'), viewer = await window.keep();
      const said = await window.outgrowLater({ src: 'round.glb', maxTriangles: 100 }, expected);
      viewer.remove();
      return said;
    });
    assert.deepEqual(later, { said: "model 'round.glb': it has more than 100 triangles; simplify it", stays: true, turns: true });
  });
});
