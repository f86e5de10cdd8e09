// Writes what the fuzz targets begin with: FOLDER/NAME/ of good inputs and FOLDER/NAME.dict of words, each taken from
// where the project has them. `node tests/fuzz/seeds.mjs FOLDER`
import { mkdirSync, readFileSync, readdirSync, statSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { deflateSync } from 'node:zlib';
import { moving } from '../moving-model.mjs';
import { apart, packDraco, packMeshopt, parts, within } from '../packed-models.mjs';
import { box, model } from '../case-models.mjs';

const root = dirname(dirname(dirname(fileURLToPath(import.meta.url))));
const folder = process.argv[2];
if (!folder) throw new Error('seeds.mjs: name the folder to write');
const cases = join(root, 'tests/cases');
const mark = Buffer.from('\n==\n');

function write(target, name, bytes) {
  mkdirSync(join(folder, target), { recursive: true });
  writeFileSync(join(folder, target, name), bytes);
}

// ------------------------------------------------------------------------------------------------ glTF

const small = readdirSync(cases).filter((name) => statSync(join(cases, name)).size < 16384);
for (const name of small.filter((one) => /\.gl(b|tf)$/.test(one))) write('gltf', name, readFileSync(join(cases, name)));
const { [`moving.gltf`]: text, ...beside } = apart(moving(), 'moving');
write('gltf', 'moving.glb', moving());
write('gltf', 'within.gltf', within(moving()));
write('gltf', 'apart.gltf', Buffer.concat([text, ...Object.values(beside).flatMap((file) => [mark, file])]));
const cube = model([{ mesh: box(1, 1, 1), material: {} }]);
for (const name of ['EXT_meshopt_compression', 'KHR_meshopt_compression']) write('gltf', `${name}.glb`, await packMeshopt(cube, name));
write('gltf', 'draco.glb', await packDraco(cube));

/** Packed bytes of a .glb behind the head that fuzz_packed.c reads. */
function packed(name, glb) {
  const { json, bin } = parts(glb);
  const modes = { ATTRIBUTES: 0, TRIANGLES: 1, INDICES: 2 }, filters = ['NONE', 'OCTAHEDRAL', 'QUATERNION', 'EXPONENTIAL', 'COLOR'];
  for (const [i, { byteOffset, byteLength, extensions }] of json.bufferViews.entries()) {
    const how = Object.entries(extensions ?? {})[0], view = how?.[1] ?? { byteOffset, byteLength };
    const head = how
      ? [modes[view.mode] << 1 | Number(how[0].startsWith('KHR')) << 3, Math.max(0, filters.indexOf(view.filter)), view.count, view.mode === 'ATTRIBUTES' ? view.byteStride / 4 : view.byteStride - 2, 6 << 2]
      : [1, 24, 6, 12, 1 | 1 << 3];
    write('packed', `${name}-${i}`, Buffer.concat([Buffer.from(head), bin.subarray(view.byteOffset ?? 0).subarray(0, view.byteLength), Buffer.alloc(3)]));
  }
}
packed('meshopt', await packMeshopt(cube));
packed('meshopt-new', await packMeshopt(cube, 'KHR_meshopt_compression'));
packed('draco', await packDraco(cube));
packed('draco-quantized', await packDraco(cube, { bits: 10 }));

/** Keys, joints, weights and a morph target, where fuzz_animation.c has them. */
for (const [name, head] of Object.entries({ moved: [3, 0, 0], skinned: [3, 0, 24], spline: [3, 0xaa, 8], stepped: [1, 0x55, 16] })) {
  const bytes = Buffer.alloc(8 + 1152);
  bytes.set([...head, 50, 120, 210, 0, 0]);
  const put = (at, numbers) => numbers.forEach((value, i) => bytes.writeFloatLE(value, 8 + at + 4 * i));
  put(0, [0, 0.5, 1, 2]);
  put(16, Array.from({ length: 36 }, (_, i) => (i % 7) / 4));
  put(160, Array.from({ length: 48 }, (_, i) => [0, 0, Math.sin(i / 8), Math.cos(i / 8)][i % 4]));
  put(352, Array.from({ length: 36 }, (_, i) => 1 + (i % 3) / 8));
  put(496, Array.from({ length: 24 }, (_, i) => (i % 2) / 2));
  for (let i = 0; i < 8; ++i) bytes.set([0, 1, 0, 0], 8 + 592 + 4 * i);
  put(624, Array.from({ length: 32 }, (_, i) => [0.5, 0.5, 0, 0][i % 4]));
  put(752, Array.from({ length: 24 }, (_, i) => (i % 5) / 10));
  put(848, Array.from({ length: 32 }, (_, i) => Number(i % 16 % 5 === 0)));
  write('animation', name, bytes);
}

// ---------------------------------------------------------------------------------------------- pictures

/** As PNG has it. */
function crc32(bytes) {
  let crc = -1;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; ++bit) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

function png(width, height, kind, depth, samples) {
  const chunk = (type, data) => {
    const body = Buffer.concat([Buffer.from(type), data]), out = Buffer.alloc(body.length + 8);
    out.writeUInt32BE(data.length);
    body.copy(out, 4);
    out.writeUInt32BE(crc32(body), body.length + 4);
    return out;
  };
  const head = Buffer.alloc(13), row = (width * samples * depth) / 8;
  head.writeUInt32BE(width);
  head.writeUInt32BE(height, 4);
  head.set([depth, kind], 8);
  const rows = Buffer.concat(Array.from({ length: height }, (_, y) => Buffer.from([y % 5, ...Array.from({ length: row }, (_unused, x) => (37 * (x + y)) & 255)])));
  return Buffer.concat([Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), chunk('IHDR', head), ...(kind === 3 ? [chunk('PLTE', Buffer.alloc(768, 99))] : []), chunk('IDAT', deflateSync(rows)), chunk('IEND', Buffer.alloc(0))]);
}

const pfm = (width, height, kind = 'PF') => Buffer.concat([Buffer.from(`${kind}\n${width} ${height}\n-1.0\n`), Buffer.from(Float32Array.from({ length: width * height * (kind === 'PF' ? 3 : 1) }, (_, i) => (i % 9) / 4).buffer)]);
const hdr = (width, height) => Buffer.concat([Buffer.from(`#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`), Buffer.from(Array.from({ length: 4 * width * height }, (_, i) => (i % 4 === 3 ? 128 : 60 + i % 99)))]);
const { json, bin } = parts(readFileSync(join(cases, 'webp-picture.glb')));
const { byteOffset = 0, byteLength } = json.bufferViews[json.images[0].bufferView];
const pictures = { 'grey.png': png(4, 4, 0, 8, 1), 'deep.png': png(4, 4, 2, 16, 3), 'palette.png': png(8, 4, 3, 8, 1), 'alpha.png': png(4, 2, 6, 8, 4), 'light.pfm': pfm(4, 2), 'heights.pfm': pfm(4, 4, 'Pf'), 'light.hdr': hdr(4, 2), 'tall.hdr': hdr(16, 8), 'picture.webp': bin.subarray(byteOffset, byteOffset + byteLength) };
for (const name of small.filter((one) => /\.(jpg|exr|hdr)$/.test(one))) pictures[name] = readFileSync(join(cases, name));
for (const [name, bytes] of Object.entries(pictures)) {
  write('image', name, bytes);
  write('environment', name, bytes);
  write('relief', name, Buffer.concat([bytes, Buffer.from(new Float32Array([0.1, 0.1, 1]).buffer)]));
}
for (const [width, height] of [[6, 1], [1, 6], [12, 2], [4, 3], [3, 4], [8, 6], [6, 8]]) {
  write('environment', `faces-${width}x${height}.pfm`, pfm(width, height));
  write('environment', `faces-${width}x${height}.hdr`, hdr(width, height));
}

// -------------------------------------------------------------------------------------------------- text

['sphere', 'ripples:relief=0.2,samples=16,slab=0.3', 'cube:at=1,2,3,scale=2,rotate=10,20,30,ior=1.5,priority=3', 'a.glb:opaque,colour=0.1,0.2,0.3,checker=4,image=a.png', 'torus:glass=flint,thin,dispersion=0.3', '#f0e8d8', 'blurred:20', 'studio'].forEach((line, i) => write('object', `${i}`, line));
const keys = '0 1,2,3 0,0,0\n1.5 2,2,2 0,1,0 40\n';
['render\nknot\n-o\nout.png\n-r\n64,32\n--ground=0\n--sun\n1,2,3,0.5\n--object\ncube:at=1,0,0', `render\nknot\n-o\n{name}-{frame}.exr\n--camera-keys\nkeys.txt\n--frames\n1:20\n--part\n2/3\n==\n${keys}`, 'render\n--list\nlist.txt\n-o\n{name}.png\n--turntable\n36\n==\na.glb\nb.glb\n', 'bench\nknot\n--sweep\ntriangles\n--json', 'view\nwater\n--glass\ndiamond\n--dispersion\nabbe:30\n--background\nblurred:9', 'ladder\ncube\n--table\n-', 'rays\nripples\n--relief-size\n64', 'render\n--help'].forEach((words, i) => write('command', `${i}`, words));
write('command', 'inspect', Buffer.concat([Buffer.from('inspect\na.glb\n--json'), mark, moving()]));
write('command', 'compare', Buffer.concat([Buffer.from('compare\na.pfm\nb.pfm\n--json\n--threshold\n3'), mark, pfm(16, 12), mark, pfm(16, 12)]));

// ------------------------------------------------------------------------------------------------- words

/** The words between quotation marks in sources. */
function words(...files) {
  const found = new Set();
  for (const file of files) for (const [, word] of readFileSync(join(root, file), 'utf8').matchAll(/"([A-Za-z_][\w-]{1,40})"/g)) found.add(word);
  return [...found];
}
const listed = (under, end) => readdirSync(join(root, under)).filter((name) => name.endsWith(end)).map((name) => `${under}/${name}`);
const dictionaries = {
  gltf: [...words(...listed('src/gltf', '.cpp'), 'src/gltf/features.c'), 'bufferViews', 'accessors', 'componentType', 'byteOffset', 'byteStride', 'sparse', 'scenes', 'nodes', 'children', 'matrix', 'primitives', 'attributes', 'mode', '\\x0a==\\x0a', '..', '%2e%2e/', 'data:application/octet-stream;base64,'],
  object: words('src/scene/object_spec.c', 'src/scene/glass.c', 'src/shapes/shapes.c', 'src/relief/relief_patterns.c'),
  command: [...words('native/cli/options.c', 'src/technique/settings.c', 'native/lab/compare.c', 'src/scene/object_spec.c').flatMap((word) => [word, `--${word}`]), '\\x0a==\\x0a', '{name}', '{frame}', '.mp4', 'auto/'],
  image: ['IHDR', 'IDAT', 'PLTE', 'tRNS', 'gAMA', 'IEND', 'RIFF', 'WEBPVP8 ', 'VP8X', 'VP8L', 'ALPH', '#?RADIANCE', '-Y ', '+X ', 'PF\\x0a', 'Pf\\x0a', 'channels', 'chlist', 'compression', 'dataWindow', 'tiles', '\\xff\\xd8\\xff', '\\xff\\xda', '\\xff\\xc0', '\\xff\\xc2', 'nan', 'inf'],
};
for (const [name, list] of Object.entries(dictionaries)) writeFileSync(join(folder, `${name}.dict`), list.map((word) => `"${word}"\n`).join(''));
for (const name of ['environment', 'relief']) writeFileSync(join(folder, `${name}.dict`), readFileSync(join(folder, 'image.dict')));
