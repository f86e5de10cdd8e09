// The window of `vitrine view` under Xvfb: it plays, steps, scrubs, takes dropped files and tells what it shows. Needs
// VITRINE_BUILD. Skips itself without Xvfb, or where act_on_window is not built.
import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { PNG } from 'pngjs';
import { patience, skipWithout } from './browser-tools.mjs';
import { startDisplay, xvfbPath } from './display.mjs';
import { moving } from './moving-model.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const build = resolve(process.env.VITRINE_BUILD ?? join(here, '../build/release'));
const binary = resolve(process.env.VITRINE_BINARY ?? join(build, 'vitrine'));
const hand = join(build, 'tests/act_on_window');
const skip = skipWithout([existsSync(xvfbPath), 'Xvfb'], [existsSync(hand), 'act_on_window (libx11-dev)']);

describe('the window', { skip }, () => {
  const folder = mkdtempSync(join(tmpdir(), 'vitrine-window-'));
  // The display's drivers keep memory to the end.
  const env = { ...process.env, ASAN_OPTIONS: `${process.env.ASAN_OPTIONS ?? ''}:detect_leaks=0` };
  let screen, view, said = '';

  before(async () => {
    writeFileSync(join(folder, 'moving.glb'), moving());
    mkdirSync(join(folder, 'a folder'));
    writeFileSync(join(folder, 'a folder', 'two words.glb'), moving((json) => delete json.animations));
    writeFileSync(join(folder, 'broken.glb'), 'glTF? no');
    writeFileSync(join(folder, 'beside.bin'), '');
    screen = await startDisplay();
    env.DISPLAY = screen.display;
    view = spawn(binary, ['view', 'sphere', '--camera', '0,0,9', '-r', '160,120', '--samples', '4'], { cwd: folder, env, stdio: ['ignore', 'ignore', 'pipe'] });
    view.stderr.on('data', (text) => (said += text));
  });
  after(async () => {
    view?.kill();
    screen?.stop();
    rmSync(folder, { recursive: true, force: true });
  });

  const act = (...words) => {
    const { status, stdout, stderr } = spawnSync(hand, ['Vitrine', ...words], { cwd: folder, env, timeout: patience });
    return { isDone: status === 0, text: stdout.toString().trim(), error: stderr.toString() };
  };
  const press = (...names) => names.forEach((name) => assert.ok(act('key', name).isDone, name));
  const drop = (...names) => assert.ok(act('drop', ...names.map((name) => join(folder, name).replaceAll(' ', '%20'))).isDone);
  const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));

  /** Until the title is like this. @returns {Promise<RegExpExecArray>} */
  async function titled(pattern) {
    for (const end = Date.now() + patience / 6; Date.now() < end; await pause(50)) {
      const found = pattern.exec(act('title').text);
      if (found !== null) return found;
      assert.equal(view.exitCode, null, `it has ended: ${said}`);
    }
    throw new Error(`the title is '${act('title').text}', not ${pattern}`);
  }

  /** What is seen once nothing changes any more. @returns {Promise<{width: number, height: number, data: Buffer}>} RGB */
  async function seen() {
    const take = () => {
      assert.ok(act('picture', 'seen.ppm').isDone);
      return readFileSync(join(folder, 'seen.ppm'));
    };
    let now = take();
    for (let before = null; before === null || !before.equals(now); now = take()) {
      before = now;
      await pause(600);
    }
    const [head, width, height] = /^P6 (\d+) (\d+) 255\n/.exec(now.subarray(0, 40).toString('latin1'));
    return { width: Number(width), height: Number(height), data: now.subarray(head.length) };
  }

  /** Mean difference from what `vitrine render` draws, codes. */
  function differenceFrom({ width, height, data }, ...args) {
    const { status, stderr } = spawnSync(binary, ['render', ...args, '-r', `${width},${height}`, '--samples', '4', '-o', 'drawn.png'], { cwd: folder });
    assert.equal(status, 0, stderr.toString());
    const drawn = PNG.sync.read(readFileSync(join(folder, 'drawn.png'))).data;
    let sum = 0;
    for (let i = 0; i < data.length; ++i) sum += Math.abs(data[i] - drawn[4 * Math.floor(i / 3) + (i % 3)]);
    return sum / data.length;
  }

  const pausedAt = /^Vitrine: moving, (\d\.\d\d) s of 1\.00, paused, \d+\.\d ms a frame$/;
  /** Until it is paused at that time. */
  const isAt = (seconds) => titled(new RegExp(`^Vitrine: moving, ${seconds.toFixed(2).replace('.', '\\.')} s of 1\\.00, paused, `));

  test('what stands still is drawn as a picture, and told with the time of a frame', async () => {
    await titled(/^Vitrine: sphere, \d+\.\d ms a frame$/);
    const difference = differenceFrom(await seen(), 'sphere', '--camera', '0,0,9');
    assert.ok(difference < 0.5, `${difference} codes`);
    press('space', 'Right', 'Home'); // nothing moves
    await titled(/^Vitrine: sphere, \d+\.\d ms a frame$/);
  });

  test('a dropped file is shown by itself and played', async () => {
    drop('beside.bin', 'moving.glb'); // the model, not what came with it
    const [, first] = await titled(/^Vitrine: moving, (\d\.\d\d) s of 1\.00, \d+\.\d ms a frame$/);
    await titled(new RegExp(`^Vitrine: moving, (?!${first.replace('.', '\\.')})\\d\\.\\d\\d s of 1\\.00, \\d`));
    assert.equal(said, '');
  });

  test('space stops it, arrows step, Home begins anew, the right button scrubs, space goes on', async () => {
    press('space');
    const [, stopped] = await titled(pausedAt);
    await pause(1200);
    await isAt(Number(stopped));
    press('Home');
    await isAt(0);
    const start = await seen();
    assert.ok(differenceFrom(start, 'moving.glb', '--time', '0') < 0.5);
    press(...Array(15).fill('Right'));
    await isAt(0.5);
    const later = await seen();
    assert.ok(differenceFrom(later, 'moving.glb', '--time', '0.5') < 0.5);
    assert.ok(differenceFrom(later, 'moving.glb', '--time', '0') > 1, 'the times can be told apart');
    press(...Array(6).fill('Left'));
    await isAt(0.3);
    act('drag', '3', '20', '100'); // half of the window
    await isAt(0.8);
    act('drag', '3', '120', '40');
    await isAt(0.3);
    act('drag', '3', '120', '40'); // past the start, to its end
    await isAt(0.8);
    press('space');
    await titled(/^Vitrine: moving, \d\.\d\d s of 1\.00, \d/);
  });

  test('dragging with the left button turns', async () => {
    press('space', 'Home');
    await isAt(0);
    const before = await seen();
    act('drag', '1', '80', '20');
    const after = await seen();
    assert.ok(!before.data.equals(after.data));
    await isAt(0);
  });

  test('what cannot be shown is told, and what was shown stays', async () => {
    const before = await seen();
    drop('broken.glb');
    await titled(/^Vitrine: .*broken\.glb.+/);
    await pause(200); // what it says comes by another way
    assert.match(said, /^vitrine: .*broken\.glb.+\n$/);
    assert.ok(before.data.equals((await seen()).data));
    press('Right');
    await isAt(0.03);
  });

  test('a name with spaces, of a file that does not move', async () => {
    drop('a folder/two words.glb');
    await titled(/^Vitrine: two words, \d+\.\d ms a frame$/);
    assert.ok(differenceFrom(await seen(), 'a folder/two words.glb') < 0.5);
    assert.equal(view.exitCode, null);
  });

  test('--frames ends it', () => {
    const { status, stderr } = spawnSync(binary, ['view', 'moving.glb', '--frames', '3', '-r', '64,48'], { cwd: folder, env });
    assert.equal(status, 0, stderr.toString());
  });
});
