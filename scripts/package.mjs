// Makes the npm package from build/web: build/package (its contents) and build/vitrine-viewer-VERSION.tgz.
//   node scripts/package.mjs            needs build/web (scripts/build-web.sh) and the packages of tests/
import { build } from '../tests/node_modules/esbuild/lib/main.js';
import { minify } from '../tests/node_modules/terser/main.js';
import { execFileSync } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { basename, dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { describeElement } from './describe-element.mjs';

const root = resolve(dirname(fileURLToPath(import.meta.url)), '..');
const web = join(root, 'build/web');
const folder = join(root, 'build/package');
const version = readFileSync(join(root, 'src/vitrine.h'), 'utf8').match(/VT_VERSION "([^"]+)"/)[1];

// Modules that are loaded only for files that need them; with two of them WebAssembly.
const decoders = ['exr', 'unpack', 'draco', 'meshopt', 'basis', 'animation'];
// Modules that are loaded once an element asks for what they do.
const extras = ['hotspots', 'prompt', 'backdrop', 'later-shaders'];
const decoderFiles = [...decoders.map((name) => `element/${name}.js`), 'element/draco.wasm', 'element/basis.wasm'];

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
for (const name of ['vitrine-core.wasm', 'vitrine-full.wasm', 'vitrine-three.wasm', 'vitrine-shaders.txt']) cpSync(join(web, name), join(folder, name));
const small = { format: 'esm', minify: true, target: 'es2022', logLevel: 'warning' };
for (const name of ['vitrine-core.js', 'vitrine-full.js', 'vitrine-three.js']) await build({ ...small, entryPoints: [join(web, name)], outdir: folder });
const { types, frameworkTypes, manifest } = await describeElement(join(web, 'element/attributes.js'));

/** Leaves out what the attributes are, in words: only the documentation reads it. */
const withoutDescriptions = {
  name: 'without descriptions',
  setup({ onLoad }) {
    onLoad({ filter: /element\/attributes\.js$/ }, ({ path }) => {
      const sentence = /'(?:[^'\\]|\\.)*\.'|`[^`]*\.`/; // that ends with a full stop
      return { contents: readFileSync(path, 'utf8').replace(/^ {2}(string|boolean|oneOf|number)\(.*$/gm, (row) => row.replace(sentence, "''")) };
    });
  },
};

// The element's modules in one: together they compress better, and a page waits for one only.
await build({
  ...small,
  entryPoints: [join(web, 'element/vitrine-viewer.js')],
  bundle: true,
  external: ['../vitrine-core.js', '../vitrine-full.js', ...[...decoders, ...extras].map((name) => `./${name}.js`)],
  plugins: [withoutDescriptions],
  sourcemap: true,
  outdir: join(folder, 'element'),
});

// Glass in three.js, and a component of React Three Fiber on it.
await build({ ...small, entryPoints: [join(web, 'three/index.js')], bundle: true, external: ['three', '../vitrine-three.js'], outdir: join(folder, 'three') });
await build({ ...small, entryPoints: [join(web, 'three/fiber.js')], outdir: join(folder, 'three') });
for (const name of ['index.d.ts', 'fiber.d.ts']) cpSync(join(root, 'web/three', name), join(folder, 'three', name));

writeFileSync(join(folder, 'index.d.ts'), types);
for (const [name, text] of Object.entries(frameworkTypes)) writeFileSync(join(folder, `${name}.d.ts`), text);
writeFileSync(join(folder, 'custom-elements.json'), `${JSON.stringify(manifest, null, 2)}\n`);
cpSync(join(root, 'docs/web.md'), join(folder, 'README.md'));
cpSync(join(root, 'LICENSE'), join(folder, 'LICENSE'));
for (const name of decoderFiles) cpSync(join(web, name), join(folder, name));
await build({ ...small, entryPoints: ['unpack', 'animation', ...extras].map((name) => join(web, `element/${name}.js`)), sourcemap: true, outdir: join(folder, 'element') });
const licences = ['parse-exr/LICENSE.md', 'fflate/LICENSE', 'meshoptimizer/LICENSE.md'].map((name) => `\nnpm: ${dirname(name)}\n\n${readFileSync(join(root, 'tests/node_modules', name), 'utf8')}`);
const apache = `
npm: draco3dgltf (Draco, Copyright 2016 The Draco Authors)
npm: three (its basis_transcoder: Basis Universal, Copyright 2016-2026 Binomial LLC, a trademark of theirs; Zstandard in it, Copyright Meta Platforms, Inc. and affiliates, BSD 3-Clause)

${readFileSync('/usr/share/common-licenses/Apache-2.0', 'utf8')}

${readFileSync('/usr/share/doc/libzstd1/copyright', 'utf8')}`;
writeFileSync(join(folder, 'NOTICES.txt'), readFileSync(join(web, 'NOTICES.txt'), 'utf8') + licences.join('') + apache);

// What others wrote of it, and its versions, for those who watch for advisories (CycloneDX 1.5).
const versionOf = (name) => JSON.parse(readFileSync(join(root, 'tests/node_modules', name, 'package.json'), 'utf8')).version;
const debian = (name) => execFileSync('dpkg-query', ['-W', '-f', '${Version}', name]).toString();
const component = (purl, name, itsVersion, licence, description) => ({ type: 'library', name, version: itsVersion, description, licenses: [{ license: { id: licence } }], purl: `pkg:${purl}/${name}@${encodeURIComponent(itsVersion)}` });
const components = [
  ...[['libtinygltf-dev', 'MIT', 'reads glTF'], ['nlohmann-json3-dev', 'MIT', 'reads JSON'], ['emscripten', 'MIT', 'compiler, with its C and C++ libraries']].map(([name, ...more]) => component('deb/debian', name, debian(name), ...more)),
  ...[['parse-exr', 'MIT', 'element/exr.js'], ['fflate', 'MIT', 'element/exr.js'], ['meshoptimizer', 'MIT', 'element/meshopt.js'], ['draco3dgltf', 'Apache-2.0', 'element/draco.wasm'], ['three', 'MIT', 'element/basis.wasm, its transcoder of Basis Universal (Apache-2.0)']].map(([name, ...more]) => component('npm', name, versionOf(name), ...more)),
];
const bill = { bomFormat: 'CycloneDX', specVersion: '1.5', version: 1, metadata: { component: { type: 'library', name: 'vitrine-viewer', version, licenses: [{ license: { id: 'MIT' } }], purl: `pkg:npm/vitrine-viewer@${version}` } }, components };
writeFileSync(join(folder, 'sbom.cdx.json'), `${JSON.stringify(bill, null, 2)}\n`);

const decodersBeside = {
  name: 'decoders beside',
  setup({ onResolve }) {
    onResolve({ filter: new RegExp(`/(${decoders.join('|')})\\.js$`) }, ({ path }) => ({ path: `./element/${basename(path)}`, external: true }));
    onResolve({ filter: /\/vitrine-full\.js$/ }, () => ({ path: './vitrine-full.js', external: true }));
  },
};

// One file with everything in it, vitrine-shaders.txt too, but decoders and the larger core, for a <script type="module"> from anywhere.
await build({
  stdin: {
    contents: `import wasm from './vitrine-core.wasm';
      import { VitrineViewer } from './element/vitrine-viewer.js';
      import laterShaders from './vitrine-shaders.txt';
      Object.assign(VitrineViewer, { wasmBinary: wasm, laterShaders });
      export { VitrineViewer };`,
    resolveDir: folder,
  },
  ...small,
  bundle: true,
  plugins: [decodersBeside],
  loader: { '.wasm': 'binary' },
  outfile: join(folder, 'vitrine-viewer.bundle.js'),
});

// What esbuild bundled, smaller still: of vitrine-core.js a seventh, of most a fiftieth.
for (const name of readdirSync(folder, { recursive: true }).filter((one) => one.endsWith('.js'))) {
  const file = join(folder, name), mapFile = `${file}.map`;
  const sourceMap = existsSync(mapFile) && { content: readFileSync(mapFile, 'utf8'), url: basename(mapFile), includeSources: true };
  const { code, map } = await minify(readFileSync(file, 'utf8'), { module: true, ecma: 2022, compress: { passes: 3 }, sourceMap });
  writeFileSync(file, code);
  if (map) writeFileSync(mapFile, map);
}

writeFileSync(
  join(folder, 'package.json'),
  `${JSON.stringify(
    {
      name: 'vitrine-viewer',
      version,
      description: 'A custom element that draws a mesh in real-time glass, refraction by refraction',
      license: 'MIT',
      type: 'module',
      main: './element/vitrine-viewer.js',
      types: './index.d.ts',
      exports: {
        '.': { types: './index.d.ts', default: './element/vitrine-viewer.js' },
        './bundle': { types: './index.d.ts', default: './vitrine-viewer.bundle.js' },
        './three': { types: './three/index.d.ts', default: './three/index.js' },
        './fiber': { types: './three/fiber.d.ts', default: './three/fiber.js' },
        './vitrine-core.wasm': './vitrine-core.wasm',
        './vitrine-full.wasm': './vitrine-full.wasm',
        './vitrine-three.wasm': './vitrine-three.wasm',
        './vitrine-shaders.txt': './vitrine-shaders.txt',
        './custom-elements.json': './custom-elements.json',
        './package.json': './package.json',
        ...Object.fromEntries(Object.keys(frameworkTypes).map((name) => [`./${name}`, { types: `./${name}.d.ts` }])),
      },
      sideEffects: ['./element/vitrine-viewer.js', './vitrine-viewer.bundle.js'],
      peerDependencies: { '@react-three/fiber': '>=8', react: '>=18', three: '>=0.180' },
      peerDependenciesMeta: Object.fromEntries(['@react-three/fiber', 'react', 'three'].map((name) => [name, { optional: true }])),
      files: ['element', 'three', 'vitrine-core.js', 'vitrine-core.wasm', 'vitrine-full.js', 'vitrine-full.wasm', 'vitrine-three.js', 'vitrine-three.wasm', 'vitrine-shaders.txt', 'vitrine-viewer.bundle.js', '*.d.ts', 'custom-elements.json', 'NOTICES.txt', 'sbom.cdx.json'],
      customElements: 'custom-elements.json',
      keywords: ['glass', 'refraction', 'webgl', 'wasm', 'gltf', 'custom-element', 'web-components'],
    },
    null,
    2,
  )}\n`,
);

const packed = execFileSync('npm', ['pack', '--silent', '--pack-destination', join(root, 'build')], { cwd: folder });
console.log(`build/${packed.toString().trim()}`);

// What the element loads, as a server would send it.
const loaded = ['vitrine-core.wasm', 'vitrine-core.js', 'element/vitrine-viewer.js'];
const weigh = (name, when = '') => {
  const bytes = gzipSync(readFileSync(join(folder, name)), { level: 9 }).length;
  console.log(`  ${name}: ${statSync(join(folder, name)).size} bytes, ${bytes} gzip${when}`);
  return bytes;
};
const [coreWasm, coreScript, element] = loaded.map((name) => weigh(name));
console.log(`  all that the element loads: ${((coreWasm + coreScript + element) / 1000).toFixed(1)} KB gzip`);
const full = ['vitrine-full.wasm', 'vitrine-full.js'].reduce((bytes, name) => bytes + weigh(name, ', in place of vitrine-core with a ground, a backdrop or animations'), 0);
console.log(`  all that such an element loads: ${((full + element) / 1000).toFixed(1)} KB gzip`);
const ofThree = ['vitrine-three.wasm', 'vitrine-three.js', 'three/index.js'].reduce((bytes, name) => bytes + weigh(name, ', of vitrine-viewer/three'), 0);
console.log(`  all that vitrine-viewer/three loads: ${(ofThree / 1000).toFixed(1)} KB gzip`);
weigh('vitrine-shaders.txt', ', loaded once a picture needs it');
for (const name of decoderFiles) weigh(name, ', loaded once a file needs it');
for (const name of extras) weigh(`element/${name}.js`, ', loaded once an element asks for it');
