// Vitrine as others use it: installed and found by CMake and pkg-config, static and shared, built as a part of another
// project, and packed for Debian. Needs VITRINE_BUILD, a build folder in which everything is built.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, readdirSync, renameSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const root = resolve(here, '..');
const build = resolve(process.env.VITRINE_BUILD ?? join(root, 'build/release'));
const folder = mkdtempSync(join(tmpdir(), 'vitrine-install-'));
after(() => rmSync(folder, { recursive: true, force: true }));

/** What a program prints; a failure holds all that it printed. */
function run(program, args, options = {}) {
  const result = spawnSync(program, args, { encoding: 'utf8', ...options });
  assert.equal(result.status, 0, `${program} ${args.join(' ')}\n${result.stdout}${result.stderr}${result.error ?? ''}`);
  return result.stdout;
}
const words = (text) => text.split(/\s+/).filter(Boolean);
const has = (program) => spawnSync(program, ['--version']).status === 0;
const withMesa = spawnSync('pkg-config', ['--exists', 'osmesa']).status === 0;

const header = readFileSync(join(root, 'src/vitrine.h'), 'utf8');
const version = header.match(/VT_VERSION "([^"]+)"/)[1];

/** Functions that the header declares, sorted. */
function declared() {
  const code = header.replace(/\/\/.*|^#.*$/gm, '').replace(/__attribute__\(\(.*?\)\)/g, '');
  const names = code.split(';').filter((part) => !part.includes('typedef'))
    .map((part) => part.match(/\b(vt\w+)\s*\(/)?.[1]);
  return names.filter(Boolean).sort();
}

/** Names of the symbols that a library defines for others, demangled. */
function symbols(library, options) {
  const lines = run('nm', ['-C', '--defined-only', ...options, library]).split('\n');
  return lines.map((line) => line.match(/^[0-9a-f]+ (\w) (.*)$/)).filter(Boolean)
    .map(([, kind, name]) => ({ kind, name }));
}

/** The installed library by a name that ends so. */
function library(prefix, ending) {
  return run('find', [prefix, '-name', `libvitrine${ending}`]).trim();
}

/** Runs a program that was built from install/user.c. */
function use(program, env = {}) {
  const text = run(program, [], { env: { ...process.env, ...env } });
  assert.ok(text.startsWith(`header ${version}, library ${version}\n`), text);
  if (withMesa) assert.ok(Number(text.match(/edges (\d+)/)[1]) > 500, text);
}

function buildWithCMake(name, options, target) {
  const out = join(folder, name);
  run('cmake', ['-S', join(here, 'install'), '-B', out, '-G', 'Ninja', ...options]);
  run('cmake', ['--build', out, '-j', '2', '--target', target]);
  return out;
}

function buildWithPkgConfig(name, prefix) {
  const path = dirname(run('find', [prefix, '-name', 'vitrine.pc']).trim());
  const env = { ...process.env, PKG_CONFIG_PATH: path };
  const flags = words(run('pkg-config', ['--cflags', '--libs', 'vitrine', ...(withMesa ? ['osmesa'] : [])], { env }));
  const out = join(folder, name);
  run('cc', ['-std=c11', ...(withMesa ? ['-DWITH_OSMESA'] : []), join(here, 'install/user.c'), '-o', out, ...flags]);
  return out;
}

describe('installed, static', () => {
  const prefix = join(folder, 'static');

  before(() => {
    run('cmake', ['--install', build, '--prefix', join(folder, 'elsewhere')]);
    renameSync(join(folder, 'elsewhere'), prefix); // it can be moved
  });

  for (const [compiler, standard, language] of [['cc', 'c11', 'c'], ['c++', 'c++17', 'c++']]) {
    test(`its header stands alone in ${standard}`, () => {
      const warnings = ['-Wall', '-Wextra', '-Wpedantic', '-Werror'];
      run(compiler, [`-std=${standard}`, ...warnings, '-fsyntax-only', '-x', language, '-'],
        { input: `#include "${join(prefix, 'include/vitrine/vitrine.h')}"\n` });
    });
  }

  test('is found by find_package', () => {
    use(join(buildWithCMake('found', [`-DCMAKE_PREFIX_PATH=${prefix}`], 'user'), 'user'));
  });

  test('is found by pkg-config', () => use(buildWithPkgConfig('configured', prefix)));

  test('has no symbol that another library may have', () => {
    const strange = symbols(library(prefix, '.a'), ['-g']).filter(({ name }) => {
      const bare = name.replace(/^(guard variable for|vtable for|typeinfo (name )?for) /, '');
      // Templates begin with what they return; those of std are the language's own, the same in every program, as are the
      // compiler's references to its exceptions (DW.ref). What Draco's headers define is the same in all that link its library.
      return !/^(\w+&? )?(vt|std::)|^DW\.ref\.|\bdraco::/.test(bare);
    });
    assert.deepEqual(strange, []);
  });

  test('brings the licences', () => {
    assert.match(readFileSync(join(prefix, 'share/doc/vitrine/LICENSE'), 'utf8'), /^MIT License/);
    const notices = readFileSync(join(prefix, 'share/doc/vitrine/NOTICES.txt'), 'utf8');
    for (const name of ['Syoyo Fujita', 'Niels Lohmann']) assert.ok(notices.includes(name), name);
  });

  test('its program is a component of its own', () => {
    const alone = join(folder, 'program');
    run('cmake', ['--install', build, '--prefix', alone, '--component', 'vitrine_program']);
    assert.equal(run(join(alone, 'bin/vitrine'), ['--version']), `vitrine ${version}\n`);
    assert.deepEqual(readdirSync(alone).sort(), ['bin', 'share']);
  });
});

describe('a part of another project, shared', () => {
  const prefix = join(folder, 'shared');
  let outer;

  before(() => {
    const options = [`-DVITRINE_SOURCE=${root}`, '-DBUILD_SHARED_LIBS=ON', '-DVT_INSTALL=ON'];
    outer = buildWithCMake('outer', options, 'all');
    run('cmake', ['--install', outer, '--prefix', prefix]);
  });

  test('works there', () => use(join(outer, 'user')));

  test('exports what the header declares', () => {
    const exported = symbols(library(prefix, '.so'), ['-D']).map(({ name }) => name).sort();
    assert.ok(exported.length > 50);
    assert.deepEqual(exported, declared());
  });

  test('is found by find_package', () => {
    use(join(buildWithCMake('found-shared', [`-DCMAKE_PREFIX_PATH=${prefix}`], 'user'), 'user'));
  });

  test('is found by pkg-config', () => {
    use(buildWithPkgConfig('configured-shared', prefix), { LD_LIBRARY_PATH: dirname(library(prefix, '.so')) });
  });
});

describe('packed', () => {
  const missing = ['dpkg-deb', 'dpkg-shlibdeps'].filter((program) => !has(program));

  test('for Debian, it runs where it is unpacked', { skip: missing.length > 0 && `${missing} is not installed` }, () => {
    run('cpack', ['--config', join(build, 'CPackConfig.cmake'), '-B', folder]);
    const [deb] = readdirSync(folder).filter((name) => name.endsWith('.deb'));
    assert.ok(readdirSync(folder).some((name) => name.endsWith('.tar.gz')));
    const listed = run('dpkg-deb', ['--contents', join(folder, deb)]);
    for (const file of ['bin/vitrine', 'lib/libvitrine.a', 'include/vitrine/vitrine.h', 'include/vitrine/vitrine_limits.h',
      'lib/cmake/Vitrine/VitrineConfig.cmake', 'lib/pkgconfig/vitrine.pc', 'share/doc/vitrine/LICENSE',
      'share/doc/vitrine/NOTICES.txt', 'share/doc/vitrine/docs/embedding.md']) {
      assert.ok(listed.includes(` ./usr/${file}\n`), `${file} is not in\n${listed}`);
    }
    const scratch = join(folder, 'scratch');
    run('dpkg-deb', ['-x', join(folder, deb), scratch]);
    run(join(scratch, 'usr/bin/vitrine'), ['render', 'knot', '-o', join(folder, 'knot.png'), '--resolution', '64,48']);
    assert.ok(existsSync(join(folder, 'knot.png')));
    assert.match(run('dpkg-deb', ['--field', join(folder, deb), 'Depends']), /libc6/);
  });
});
