// Series of pictures: frames, models, parts; stopped and gone on with. Needs VITRINE_BINARY.
import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { chmodSync, copyFileSync, existsSync, lstatSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync, symlinkSync, truncateSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { PNG } from 'pngjs';
import * as shapes from '../scripts/glb.mjs';
import { glb, gltf } from '../scripts/glb.mjs';
import { moving } from './moving-model.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const binary = resolve(process.env.VITRINE_BINARY ?? join(here, '../build/release/vitrine'));
const folder = mkdtempSync(join(tmpdir(), 'vitrine-series-'));
after(() => rmSync(folder, { recursive: true, force: true }));

function vitrine(args, options = {}) {
  const result = spawnSync(binary, ['render', ...args], { cwd: folder, maxBuffer: 1 << 27, ...options });
  return { code: result.status, signal: result.signal, error: result.stderr.toString() };
}

/** What must fail with one sentence that has every part, and write nothing. */
function refuses(args, ...parts) {
  const result = vitrine(args);
  assert.equal(result.code, 1, result.error);
  assert.match(result.error, /^vitrine: [^\n]+\n$/, 'one sentence');
  for (const part of parts) assert.ok(result.error.includes(part), `'${part}' is not in: ${result.error}`);
}

/** The files of a folder by name. */
const contents = (name) => Object.fromEntries(readdirSync(join(folder, name)).sort().map((file) => [file, readFileSync(join(folder, name, file)).toString('base64')]));

const small = ['-r', '48,48', '--no-fresnel'];
const turn = (to, ...more) => ['sphere', '-o', `${to}/{frame}.png`, '--turntable', '6', ...small, ...more];

describe('frames', () => {
  test('a turntable: the number stands where the pattern says, or before the ending', () => {
    assert.match(vitrine(turn('turn')).error, /6 of 6 pictures are there: 6 drawn, 0 kept/);
    assert.equal(vitrine(['sphere', '-o', 'plain/t.x.png', '--turntable', '2', '--frames', '1:', ...small]).code, 0);
    assert.deepEqual(readdirSync(join(folder, 'turn')), [0, 1, 2, 3, 4, 5].map((i) => `000${i}.png`));
    assert.deepEqual(readdirSync(join(folder, 'plain')), ['t.x-0001.png']);
    // A quarter of a turn of an eye in front is an eye at the side.
    vitrine(['knot', '-o', 'quarter/{frame}.png', '--camera', '0,0,3', '--target', '0,0,0', '--turntable', '4', ...small]);
    vitrine(['knot', '-o', 'side.png', '--camera', '3,0,0', '--target', '0,0,0', ...small]);
    assert.equal(vitrine(['knot', '-o', 'again.png', '--camera', '3,0,0', '--target', '0,0,0', ...small, '--reference', 'quarter/0001.png', '--reference-threshold', '0.01']).code, 0);
  });

  test('keys: at a key and halfway between two', () => {
    writeFileSync(join(folder, 'keys.txt'), '# seconds, eye, target, field of view\n0 0,0,3 0,0,0\n1 0,0,5 0,0,0 30 # nearer\n\n2 0,0,3 0,0,0\r\n');
    const drawn = vitrine(['knot', '-o', 'keys/{frame}.png', '--camera-keys', 'keys.txt', '--fps', '2', '--fov', '40', ...small]);
    assert.match(drawn.error, /5 of 5 pictures/);
    const same = (frame, z, fov) => vitrine(['knot', '-o', 'key.png', '--camera', `0,0,${z}`, '--target', '0,0,0', '--fov', fov, ...small, '--reference', `keys/000${frame}.png`, '--reference-threshold', '0.001']);
    assert.equal(same(0, 3, '40').error, '');
    assert.equal(same(2, 5, '30').error, '');
    // Slopes are 2 at the first key and 0 at the second: 4 + (2 - 0) / 8.
    assert.equal(same(1, 4.25, '35').error, '');
    assert.equal(same(1, 4, '35').code, 1, 'another place is seen');
  });

  test('animations of files: each frame is at its time, all there are, and the shutter blurs them', () => {
    writeFileSync(join(folder, 'moving.glb'), moving());
    const seen = ['--camera', '0,1,9', '--target', '1,0,0', ...small];
    assert.match(vitrine(['moving.glb', '-o', 'moving/{frame}.png', '--fps', '4', ...seen]).error, /5 of 5 pictures/);
    const same = (frame, time, ...more) => vitrine(['moving.glb', '-o', 'at.png', '--time', time, ...more, ...seen, '--reference', `moving/000${frame}.png`, '--reference-threshold', '0']).code === 0;
    assert.ok(same(0, '0') && same(1, '0.25') && same(4, '1') && !same(1, '0.5'));
    assert.equal(vitrine(['moving.glb', '-o', 'moving/{frame}.png', '--fps', '4', '--animation', 'up', '--time', '0.5', '--frames', '1:1', ...seen]).code, 0);
    assert.ok(same(1, '0.75', '--animation', 'up'));
    // A turntable turns it at rest, unless an animation is named.
    vitrine(['moving.glb', '-o', 'moving/{frame}.png', '--turntable', '4', '--frames', '0:1', '--fps', '1', ...seen]);
    assert.ok(same(0, '0'));
    refuses(['moving.glb', '-o', 'x-{frame}.png', '--frames', '60:', '--fps', '4'], "'moving.glb' has no frame 60");
    refuses(['moving.glb', '-o', 'x-{frame}.png', '--animation', 'none'], 'nothing moves');
    // While the shutter is open the cube comes a quarter of its way; 24 samples of that cover more than it.
    const covered = (name, ...more) => {
      const light = ['-e', 'checker', '--background', '#ff00ff', '--samples', '8', '--redraw'];
      assert.equal(vitrine(['moving.glb', '-o', `${name}/{frame}.png`, '--fps', '2', '--frames', '0:0', ...seen, ...light, ...more]).code, 0);
      const { data } = PNG.sync.read(readFileSync(join(folder, name, '0000.png')));
      let count = 0;
      for (let i = 0; i < data.length; i += 4) count += data[i] !== 255 || data[i + 1] !== 0 || data[i + 2] !== 255;
      return count;
    };
    assert.ok(covered('open', '--shutter', '1') > 1.3 * covered('closed'), `${covered('open', '--shutter', '1')} of ${covered('closed')} pixels`);
  });

  test('motion blur: samples over the shutter', () => {
    const draw = (to, ...more) => vitrine(['knot', '-o', `${to}/{frame}.png`, '--turntable', '8', '--frames', '0:0', '--samples', '8', '-r', '48,48', ...more]);
    assert.equal(draw('sharp').code, 0);
    assert.equal(draw('blurred', '--shutter', '1').code, 0);
    assert.equal(draw('hardly', '--shutter', '0.000001').code, 0);
    const compare = (a, b) => spawnSync(binary, ['compare', `${a}/0000.png`, `${b}/0000.png`, '--json'], { cwd: folder }).stdout.toString();
    const flip = (a, b) => Number(/"[^"]*flip[^"]*": ?([0-9.e-]+)/i.exec(compare(a, b))?.[1]);
    assert.ok(flip('blurred', 'sharp') > 0.05, compare('blurred', 'sharp'));
    assert.ok(flip('hardly', 'sharp') < 0.002, compare('hardly', 'sharp'));
  });
});

describe('gone on with', () => {
  test('what is there is kept; what is cut, of other options or another file is drawn again', () => {
    const before = contents('turn');
    assert.match(vitrine(turn('turn')).error, /0 drawn, 6 kept/);
    truncateSync(join(folder, 'turn/0002.png'), statSync(join(folder, 'turn/0002.png')).size - 20);
    rmSync(join(folder, 'turn/0004.png'));
    assert.match(vitrine(turn('turn')).error, /2 drawn, 4 kept/);
    assert.deepEqual(contents('turn'), before);
    assert.match(vitrine(turn('turn', '--frames', '1:2', '--ior', '1.3')).error, /2 drawn, 0 kept/);
    assert.match(vitrine(turn('turn', '--frames', '1:3')).error, /2 drawn, 1 kept/);
    assert.match(vitrine(turn('turn', '--redraw')).error, /6 drawn, 0 kept/);
    assert.deepEqual(contents('turn'), before);
    const cube = { positions: [...shapes.cube.positions], indices: [...shapes.cube.indices], ior: 1.31 };
    writeFileSync(join(folder, 'model.glb'), glb(gltf(cube)));
    const model = ['model.glb', '-o', 'model/{frame}.png', '--turntable', '2', ...small];
    vitrine(model);
    assert.match(vitrine(model).error, /0 drawn, 2 kept/);
    writeFileSync(join(folder, 'model.glb'), glb(gltf({ ...cube, ior: 1.6 })));
    assert.match(vitrine(model).error, /2 drawn, 0 kept/);
  });

  for (const ending of ['exr', 'hdr']) {
    test(`.${ending} is known again, too`, () => {
      const args = ['sphere', '-o', `light/{frame}.${ending}`, '--turntable', '2', ...small];
      assert.match(vitrine(args).error, /2 drawn/);
      assert.match(vitrine(args).error, /0 drawn, 2 kept/);
      const name = join(folder, `light/0001.${ending}`);
      truncateSync(name, statSync(name).size - 8);
      assert.match(vitrine(args).error, /1 drawn, 1 kept/);
    });
  }

  for (const signal of ['SIGINT', 'SIGTERM', 'SIGKILL']) {
    test(`ended by ${signal} and started again: the same bytes, nothing half written`, async () => {
      const to = `by${signal}`, args = ['knot', '-o', `${to}/{frame}.png`, '--turntable', '40', '-r', '64,64'];
      const child = spawn(binary, ['render', ...args], { cwd: folder, stdio: ['ignore', 'ignore', 'pipe'] });
      let said = '';
      child.stderr.on('data', (data) => (said += data));
      const ended = new Promise((done) => child.on('exit', (code, by) => done({ code, by })));
      const count = () => (existsSync(join(folder, to)) ? readdirSync(join(folder, to)).filter((name) => /^\d{4}\.png$/.test(name)).length : 0);
      while (count() < 3 && child.exitCode === null) await new Promise((next) => setTimeout(next, 5));
      child.kill(signal);
      assert.deepEqual(await ended, { code: null, by: signal });
      const drawn = count();
      assert.ok(drawn >= 3 && drawn < 40, `${drawn} pictures`);
      if (signal !== 'SIGKILL') {
        assert.match(said, /stopped; the same command goes on with the rest/);
        assert.equal(readdirSync(join(folder, to)).length, drawn, 'no file is left behind');
      }
      assert.match(vitrine(args).error, new RegExp(`${40 - drawn} drawn, ${drawn} kept`));
      if (signal === 'SIGKILL') return;
      vitrine(['knot', '-o', 'whole/{frame}.png', '--turntable', '40', '-r', '64,64']);
      assert.deepEqual(contents(to), contents('whole'));
    });
  }
});

test('a full disk: a sentence, whole pictures stay, and it goes on once there is room', (context) => {
  const disk = join(folder, 'disk');
  mkdirSync(disk);
  if (spawnSync('mount', ['-t', 'tmpfs', '-o', 'size=64k', 'vitrine', disk]).status !== 0) return context.skip('this user cannot mount a small disk');
  try {
    const args = ['knot', '-o', 'disk/{frame}.png', '--turntable', '24', '-r', '64,64'];
    const full = vitrine(args);
    assert.equal(full.code, 1);
    assert.match(full.error, /'disk\/\d{4}\.png' cannot be written: No space left on device/);
    const drawn = readdirSync(disk);
    assert.ok(drawn.length > 2 && drawn.length < 24 && drawn.every((name) => /^\d{4}\.png$/.test(name)), drawn.join(' '));
    spawnSync('mount', ['-o', 'remount,size=1m', disk]);
    assert.match(vitrine(args).error, new RegExp(`${24 - drawn.length} drawn, ${drawn.length} kept`));
  } finally {
    spawnSync('umount', [disk]);
  }
});

describe('parts', () => {
  const whole = () => contents('turn');

  test('four parts are the whole, byte by byte, each picture in one of them', () => {
    for (let i = 1; i <= 4; ++i) {
      const result = vitrine(turn('parts', '--part', `${i}/4`));
      assert.match(result.error, i <= 2 ? /2 of 2 pictures are there: 2 drawn/ : /1 of 1 pictures are there: 1 drawn/);
    }
    assert.deepEqual(contents('parts'), whole());
  });

  test('by the environment of Slurm, Kubernetes and GNU parallel', () => {
    const draw = (to, environment, ...more) => vitrine(turn(to, ...more), { env: { ...process.env, ...environment } });
    const slurm = { SLURM_ARRAY_TASK_ID: '14', SLURM_ARRAY_TASK_COUNT: '3', SLURM_ARRAY_TASK_MIN: '10', SLURM_ARRAY_TASK_STEP: '2' };
    assert.match(draw('slurm', slurm).error, /note: part 3 of 3, by SLURM_ARRAY_TASK_ID/);
    assert.deepEqual(readdirSync(join(folder, 'slurm')), ['0002.png', '0005.png']);
    assert.match(draw('slurm', slurm, '--part', '1/1').error, /^vitrine: 6 of 6/m, 'the option goes before');
    assert.match(draw('kubernetes', { JOB_COMPLETION_INDEX: '0' }, '--part', 'auto/6').error, /part 1 of 6, by JOB_COMPLETION_INDEX/);
    assert.deepEqual(readdirSync(join(folder, 'kubernetes')), ['0000.png']);
    assert.match(draw('parallel', { PARALLEL_SEQ: '6' }, '--part', 'auto/6').error, /part 6 of 6, by PARALLEL_SEQ/);
    assert.deepEqual(readdirSync(join(folder, 'parallel')), ['0005.png']);
  });
});

describe('many models', () => {
  test('a picture of each; a bad one is named and the others are drawn', () => {
    writeFileSync(join(folder, 'bad.glb'), 'glTF? no');
    const result = vitrine(['sphere', 'bad.glb', 'goblet', '-o', 'out/{name}.png', ...small]);
    assert.equal(result.code, 1);
    assert.match(result.error, /'bad\.glb'/);
    assert.match(result.error, /1 of 3 models could not be drawn/);
    assert.deepEqual(readdirSync(join(folder, 'out')), ['goblet.png', 'sphere.png']);
    vitrine(['sphere', '-o', 'alone.png', ...small]);
    const same = spawnSync(binary, ['compare', 'out/sphere.png', 'alone.png', '--json'], { cwd: folder }).stdout.toString();
    assert.match(same, /"[^"]*flip[^"]*": ?0(\.0+)?[,\s]/i, same);
  });

  test('a list, from standard input, of frames each', () => {
    const result = vitrine(['--list', '-', '-o', 'list/{name}-{frame}.png', '--turntable', '2', ...small], { input: 'sphere\r\n\ndiamond\n' });
    assert.equal(result.code, 0, result.error);
    assert.deepEqual(readdirSync(join(folder, 'list')), ['diamond-0000.png', 'diamond-0001.png', 'sphere-0000.png', 'sphere-0001.png']);
  });
});

describe('films', () => {
  const isThere = spawnSync('ffmpeg', ['-version']).status === 0;

  test('by ffmpeg', { skip: isThere ? false : 'ffmpeg is not installed' }, () => {
    assert.equal(vitrine(['sphere', '-o', 'turn.mp4', '--turntable', '6', '-r', '48,47']).code, 0);
    const probe = spawnSync('ffprobe', ['-v', 'error', '-count_frames', '-show_entries', 'stream=width,height,nb_read_frames,r_frame_rate', '-of', 'csv=p=0', 'turn.mp4'], { cwd: folder });
    assert.equal(probe.stdout.toString().trim(), '48,48,24/1,6');
    assert.deepEqual(readdirSync(folder).filter((name) => name.startsWith('turn.mp4')), ['turn.mp4']);
  });

  test('without ffmpeg: a sentence, and nothing is left', () => {
    const result = vitrine(['sphere', '-o', 'none.mp4', '--turntable', '2', ...small], { env: { ...process.env, PATH: '/nowhere' } });
    assert.equal(result.code, 1);
    assert.match(result.error, /'[^']*none\.mp4': ffmpeg cannot be run; install it/);
    assert.deepEqual(readdirSync(folder).filter((name) => name.startsWith('none')), []);
  });
});

test('what makes no series', () => {
  refuses(['sphere', 'knot', '-o', 'x.png'], "'knot' is a second model, but -o 'x.png' names one file", '{name}', '--object');
  refuses(['a/x.glb', 'b/x.glb', '-o', '{name}.png'], "'a/x.glb' and 'b/x.glb'", 'the same {name}');
  refuses(['sphere', '-o', 'x{size}.png', '--turntable', '2'], "'{size}.png' means nothing");
  refuses(['sphere', '--turntable', '2'], 'no output given');
  refuses(['sphere', '-o', '-', '--turntable', '2'], '-o - takes one picture');
  refuses(['sphere', '-o', 'x.png', '--frames', '0:3'], "nothing moves in 'sphere'", '--turntable');
  refuses(['sphere', '-o', 'x.mp4'], "nothing moves in 'sphere'");
  refuses(['sphere', '-o', 'x.png', '--turntable', '4', '--frames', '3:1'], "--frames is '3:1'", 'which is 3');
  refuses(['sphere', '-o', 'x.png', '--turntable', '4', '--shutter', '0.5'], '--samples 16');
  refuses(['sphere', '-o', 'x.png', '--part', '1/2'], '--part is of many pictures');
  refuses(['sphere', '-o', 'x.png', '--turntable', '4', '--part', '5/4'], 'there is no part 5 of 4');
  refuses(['sphere', '-o', 'x.png', '--turntable', '4', '--part', '0/4'], "--part is '0/4'");
  refuses(['sphere', '-o', 'x.png', '--turntable', '4', '--part', 'auto/4'], 'none of SLURM_ARRAY_TASK_ID');
  refuses(['sphere', '-o', 'x.mp4', '--turntable', '4', '--part', '1/4'], 'cannot be drawn in parts');
  refuses(['sphere', '-o', 'x.png', '--turntable', '4', '--directions', 'd.pfm'], '--directions is of one picture');
  writeFileSync(join(folder, 'late.txt'), '1 0,0,3 0,0,0\n1 0,0,4 0,0,0\n');
  refuses(['sphere', '-o', 'x.png', '--camera-keys', 'late.txt'], 'line 2', 'not after that of the key before');
  writeFileSync(join(folder, 'wrong.txt'), '1 0,0,3\n');
  refuses(['sphere', '-o', 'x.png', '--camera-keys', 'wrong.txt'], "line 1 is '1 0,0,3'");
  refuses(['sphere', '-o', 'x.png', '--camera-keys', 'wrong.txt', '--turntable', '3'], 'both say where the eye is');
  writeFileSync(join(folder, 'empty.txt'), '\n');
  refuses(['--list', 'empty.txt', '-o', '{name}.png'], "'empty.txt' names no model");
});

describe('files', () => {
  test('a link is followed, a planted one beside it is not, permissions stay', () => {
    mkdirSync(join(folder, 'real'));
    writeFileSync(join(folder, 'real/target.png'), 'old');
    chmodSync(join(folder, 'real/target.png'), 0o600);
    symlinkSync('real/target.png', join(folder, 'link.png'));
    writeFileSync(join(folder, 'victim'), 'mine');
    symlinkSync('victim', join(folder, 'link.png.part'));
    symlinkSync('victim', join(folder, 'real/target.png.part'));
    assert.equal(vitrine(['sphere', '-o', 'link.png', ...small]).code, 0);
    assert.ok(lstatSync(join(folder, 'link.png')).isSymbolicLink());
    assert.equal(readFileSync(join(folder, 'real/target.png')).subarray(1, 4).toString(), 'PNG');
    assert.equal(statSync(join(folder, 'real/target.png')).mode & 0o777, 0o600);
    assert.equal(readFileSync(join(folder, 'victim'), 'utf8'), 'mine');
    symlinkSync('real/new.png', join(folder, 'dangling.png'));
    assert.equal(vitrine(['sphere', '-o', 'dangling.png', ...small]).code, 0);
    assert.ok(existsSync(join(folder, 'real/new.png')));
  });

  test('a name of 255 bytes; a file that may not be written; a name that ends like another kind', () => {
    const long = `${'n'.repeat(251)}.png`;
    assert.equal(vitrine(['sphere', '-o', long, ...small]).code, 0);
    assert.ok(existsSync(join(folder, long)));
    writeFileSync(join(folder, 'protected.png'), 'as it was');
    chmodSync(join(folder, 'protected.png'), 0o444);
    // Who is root may write everything, and others may not get at the binary where it lies.
    const asOther = process.getuid() === 0 ? ['setpriv', '--reuid=65534', '--regid=65534', '--clear-groups'] : [];
    copyFileSync(binary, join(folder, 'vitrine'));
    chmodSync(folder, 0o777);
    const [program, ...args] = [...asOther, './vitrine', 'render', 'sphere', '-o', 'protected.png', ...small];
    const refused = spawnSync(program, args, { cwd: folder, env: { ...process.env, ASAN_OPTIONS: 'detect_leaks=0' } });
    assert.equal(refused.status, 1);
    assert.match(refused.stderr.toString(), /'protected\.png' cannot be written: Permission denied/);
    assert.equal(readFileSync(join(folder, 'protected.png'), 'utf8'), 'as it was');
    const told = vitrine(['sphere', '-o', 'a.jpg', ...small]);
    assert.equal(told.code, 0);
    assert.match(told.error, /^vitrine: note: 'a\.jpg' is written as PNG; \.exr and \.hdr are the other kinds$/m);
    assert.doesNotMatch(vitrine(['sphere', '-o', 'a.PNG', ...small]).error, /note/);
  });

  test('a file of the size limit: a sentence, the old file stays', () => {
    writeFileSync(join(folder, 'kept.png'), 'as it was');
    const result = spawnSync('bash', ['-c', `ulimit -f 1; "${binary}" render sphere -o kept.png -r 256,256`], { cwd: folder });
    assert.equal(result.status, 1);
    assert.match(result.stderr.toString(), /'kept\.png' cannot be written: File too large/);
    assert.equal(readFileSync(join(folder, 'kept.png'), 'utf8'), 'as it was');
    assert.deepEqual(readdirSync(folder).filter((name) => name.startsWith('kept')), ['kept.png']);
  });

  test('standard output that takes nothing more', () => {
    for (const command of ['list', 'list --settings', 'list --gltf', '--help', '--version', 'render --help', 'inspect model.glb', 'render sphere -r 32,32 -o -']) {
      const result = spawnSync('bash', ['-c', `"${binary}" ${command} >/dev/full`], { cwd: folder });
      assert.equal(result.status, 1, command);
      assert.match(result.stderr.toString(), /^vitrine: .*No space left on device\n$/m, command);
    }
    const closed = spawnSync('bash', ['-c', `set -o pipefail; "${binary}" list --settings | true`], { cwd: folder });
    assert.ok(closed.status === 0 || closed.status === 1, 'no signal');
  });
});
