// Pictures for the page of scripts/thesis.mjs: `vitrine` draws them, each command once, as many at a time as there are processors; what
// the program does not draw itself is made of its pictures here.
import { execFile } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { availableParallelism } from 'node:os';
import { basename, isAbsolute, join } from 'node:path';
import { promisify } from 'node:util';

const { PNG } = createRequire(new URL('../../tests/package.json', import.meta.url))('pngjs');

/** A command as a reader types it: files without their folders. */
const shorten = (word) => (isAbsolute(word) ? basename(word) : word);

/**
 * Runs `binary` and keeps pictures in `folder`. `draw(name, words)` promises { file, command }: the picture's name in the
 * folder and what drew it. Asked for the same words again it gives the same picture.
 */
export function makeStudio(binary, folder) {
  const known = new Map(), waiting = [];
  let free = availableParallelism();

  async function run(...words) {
    if (free === 0) await new Promise((go) => waiting.push(go));
    else --free;
    try {
      // One picture a processor: a single one keeps several busy for a part of its time only.
      const env = words[0] === 'bench' ? process.env : { ...process.env, LP_NUM_THREADS: '1' };
      return (await promisify(execFile)(binary, words, { env, maxBuffer: 1 << 26 })).stdout;
    } catch (reason) {
      throw new Error(reason.stderr?.trim() || `${binary} does not run; build it: cmake --build --preset release`);
    } finally {
      if (waiting.length > 0) waiting.shift()();
      else ++free;
    }
  }

  function render(option, ending) {
    return (name, words) => {
      const key = [option, ...words].join(' '), file = `${name}.${ending}`;
      if (!known.has(key)) {
        const command = ['vitrine render', ...words.map(shorten), ...(option === '-o' ? [] : [option, file])].join(' ');
        known.set(key, run('render', ...words, option, join(folder, file)).then(() => ({ file, command })));
      }
      return known.get(key);
    };
  }

  const path = ({ file }) => join(folder, file);
  const read = (picture) => PNG.sync.read(readFileSync(path(picture)));
  function write(name, png, { command }, note) {
    const file = `${name}.png`;
    writeFileSync(join(folder, file), PNG.sync.write(png, { colorType: 2 }));
    return { file, command, note };
  }

  return {
    run,
    draw: render('-o', 'png'),
    drawDirections: render('--directions', 'pfm'),
    drawLayers: render('--layer-sheet', 'png'),

    /** Mean FLIP between a picture and the true one. */
    flip: async (picture, truth) => JSON.parse(await run('compare', path(picture), path(truth), '--json')).flip,

    /** Two direction files: { within1, lost } and a picture of the errors. */
    async compareDirections(name, directions, truth) {
      const file = `${name}.png`;
      const text = await run('compare', path(directions), path(truth), '--json', '--difference', join(folder, file));
      return { ...JSON.parse(text), picture: { file, command: `vitrine compare ${directions.file} ${truth.file} --difference ${file}` } };
    },

    /** The square whose left upper corner is at these shares of the picture's sides. */
    crop(name, picture, left, top, side) {
      const whole = read(picture), part = new PNG({ width: side, height: side });
      const x = Math.round(left * whole.width), y = Math.round(top * whole.height);
      PNG.bitblt(whole, part, x, y, side, side, 0, 0);
      return write(name, part, picture, `${side} x ${side} of its pixels, from ${x},${y}`);
    },

    /** Directions as colours: 0.5 + 0.5 d. Black where there is no glass, white where the path was lost. */
    colour(name, directions) {
      const bytes = readFileSync(path(directions)), [, width, height] = bytes.toString('latin1', 0, 64).split(/\s+/).map(Number);
      const png = new PNG({ width, height }), floats = bytes.subarray(bytes.length - 12 * width * height);
      for (let j = 0; j < height; ++j) {
        for (let i = 0; i < width; ++i) {
          const d = [0, 4, 8].map((k) => floats.readFloatLE(12 * ((height - 1 - j) * width + i) + k)); // bottom row first
          const isNone = d.every((value) => value === 0);
          d.forEach((value, k) => {
            png.data[4 * (j * width + i) + k] = isNone ? 0 : Math.min(255, Math.round(127.5 + 127.5 * value));
          });
          png.data[4 * (j * width + i) + 3] = 255;
        }
      }
      return write(name, png, directions, 'a colour is 0.5 + 0.5 of the direction; black: no glass, white: lost');
    },

    /** Black where the analysis says that total internal reflection took part (green). */
    blacken(name, picture, analysis) {
      const png = read(picture), { data } = read(analysis);
      for (let at = 0; at < data.length; at += 4) {
        if (data[at + 1] > data[at] && data[at + 1] > data[at + 2]) png.data.fill(0, at, at + 3);
      }
      return write(name, png, picture, 'then black where --analysis is green');
    },

    /** Of a sheet of layers, one layer's depth: [values from 0 to 1 or, without a surface, null], its width and height. */
    readDepth(sheet, layer, layers) {
      const { width, height, data } = read(sheet), columns = width / layers, rows = height / 2;
      const depths = Array.from({ length: columns * rows }, (_, at) => {
        const from = 4 * (Math.floor(at / columns) * width + layer * columns + (at % columns));
        return data[from] === data[from + 2] ? (1 - data[from] / 255) / 0.9 : null; // grey: present.frag
      });
      return { depths, columns, rows };
    },

    /** The depths of one layer as a picture, grey as on the sheet; the background white. */
    drawDepth(name, sheet, { depths, columns, rows }, note) {
      const png = new PNG({ width: columns, height: rows });
      depths.forEach((depth, at) => {
        png.data.fill(depth === null ? 255 : Math.round(255 * (1 - 0.9 * depth)), 4 * at, 4 * at + 3);
        png.data[4 * at + 3] = 255;
      });
      return write(name, png, sheet, note);
    },
  };
}
