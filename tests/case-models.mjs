// Small models that say what glTF's materials can say: what the tests of materials draw.
import { glb } from '../scripts/glb.mjs';

// ---------------------------------------------------------------------------------------------------- shapes

/** A rectangle in the plane z = 0 that faces +z; its picture stands upright on it. */
export function quad(width = 0.8, height = width) {
  const [x, y] = [width / 2, height / 2];
  return {
    positions: [-x, -y, 0, x, -y, 0, x, y, 0, -x, y, 0], normals: [0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1],
    texcoords: [0, 1, 1, 1, 1, 0, 0, 0], indices: [0, 1, 2, 0, 2, 3],
  };
}

/** A box about the origin; the picture stands upright on its front and lies as seen from there on its back. */
export function box(width, height, depth) {
  const mesh = { positions: [], normals: [], texcoords: [], indices: [] };
  for (const axis of [0, 1, 2]) {
    for (const side of [-1, 1]) {
      const [u, v] = [(axis + 1) % 3, (axis + 2) % 3], first = mesh.positions.length / 3;
      for (const [a, b] of side > 0 ? [[-1, -1], [1, -1], [1, 1], [-1, 1]] : [[-1, -1], [-1, 1], [1, 1], [1, -1]]) {
        const corner = [0, 0, 0], normal = [0, 0, 0];
        [corner[axis], corner[u], corner[v], normal[axis]] = [side, a, b, side];
        mesh.positions.push(...corner.map((place, i) => (place * [width, height, depth][i]) / 2));
        mesh.normals.push(...normal);
        mesh.texcoords.push((1 + corner[0]) / 2, (1 - corner[1]) / 2);
      }
      mesh.indices.push(...[0, 1, 2, 0, 2, 3].map((i) => first + i));
    }
  }
  return mesh;
}

/** A ball; its triangles from `from` to `to` of the rings, all of them unless said otherwise. */
export function ball(radius, rings = 16, from = 0, to = rings) {
  const mesh = { positions: [], normals: [], texcoords: [], indices: [] }, around = 2 * rings;
  for (let i = from; i <= to; ++i) {
    for (let k = 0; k <= around; ++k) {
      const [a, b] = [(Math.PI * i) / rings, (2 * Math.PI * (k % around)) / around];
      const out = i === rings ? 0 : Math.sin(a); // a pole is one point
      const normal = [out * Math.sin(b), Math.cos(a), out * Math.cos(b)];
      mesh.normals.push(...normal);
      mesh.positions.push(...normal.map((part) => radius * part));
      mesh.texcoords.push(k / around, i / rings);
      const at = (i - from) * (around + 1) + k;
      if (i < to && k < around) {
        if (i < rings - 1) mesh.indices.push(at, at + around + 1, at + around + 2);
        if (i > 0) mesh.indices.push(at, at + around + 2, at + 1);
      }
    }
  }
  return mesh;
}

/** With one colour, linear, RGBA, at every corner. */
export const colored = (mesh, ...color) => ({ ...mesh, colors: Array.from({ length: mesh.positions.length / 3 }, () => color).flat() });

/** With a second set of texture coordinates: the first, changed. */
export const withSecond = (mesh, change) => ({
  ...mesh, texcoords1: Array.from({ length: mesh.texcoords.length / 2 }, (_, i) => change(mesh.texcoords[2 * i], mesh.texcoords[2 * i + 1])).flat(),
});

// ------------------------------------------------------------------------------------------------- materials

const rgba = (color) => [...color, 1].slice(0, 4);

/** Opaque and matt. */
export const matt = (color, { extensions, pbr, ...more } = {}) => ({
  pbrMetallicRoughness: { baseColorFactor: rgba(color), metallicFactor: 0, roughnessFactor: 1, ...pbr }, ...(extensions && { extensions }), ...more,
});

/** Its colour, whatever light there is. */
export const unlit = (color, { extensions, ...more } = {}) => matt(color, { extensions: { KHR_materials_unlit: {}, ...extensions }, ...more });

/** A thin wall of glass. */
export const thin = (color = [1, 1, 1], { extensions, pbr, ...more } = {}) => matt(color, {
  extensions: { KHR_materials_transmission: { transmissionFactor: 1 }, ...extensions }, pbr: { roughnessFactor: 0, ...pbr }, ...more,
});

/** Solid glass. */
export const solid = (color, { extensions, ...more } = {}) => thin(color, { extensions: { KHR_materials_volume: { thicknessFactor: 1 }, ...extensions }, ...more });

// ---------------------------------------------------------------------------------------------------- models

const components = { VEC2: 2, VEC3: 3, VEC4: 4, SCALAR: 1 };
const attributes = { positions: ['POSITION', 'VEC3'], normals: ['NORMAL', 'VEC3'], texcoords: ['TEXCOORD_0', 'VEC2'], texcoords1: ['TEXCOORD_1', 'VEC2'], colors: ['COLOR_0', 'VEC4'] };

function extensionsIn(value, found) {
  if (value === null || typeof value !== 'object') return found;
  if (!Array.isArray(value)) Object.keys(value.extensions ?? {}).forEach((name) => found.add(name));
  Object.values(value).forEach((part) => extensionsIn(part, found));
  return found;
}

/**
 * A .glb. A part is a node: what it says but `mesh`, `material` and `primitives` (several of those) goes into the node.
 * @param {object[]} parts
 * @param {{pictures?: Buffer[], textures?: object[], samplers?: object[], lights?: object[], variants?: string[]}} [more] .png files; a texture each, unless said otherwise
 * @returns {Buffer}
 */
export function model(parts, { pictures = [], textures = pictures.map((_, source) => ({ source })), samplers, lights, variants } = {}) {
  const json = { asset: { version: '2.0' }, bufferViews: [], accessors: [], meshes: [], materials: [], nodes: [] }, chunks = [];
  const addView = (bytes) => {
    const byteOffset = chunks.reduce((sum, { length }) => sum + length, 0);
    chunks.push(bytes, Buffer.alloc((4 - (bytes.length % 4)) % 4));
    return json.bufferViews.push({ buffer: 0, byteOffset, byteLength: bytes.length }) - 1;
  };
  const add = (numbers, type) => {
    const isIndex = type === 'SCALAR', each = components[type];
    const accessor = { bufferView: addView(Buffer.from((isIndex ? new Uint16Array(numbers) : new Float32Array(numbers)).buffer)), componentType: isIndex ? 5123 : 5126, count: numbers.length / each, type };
    if (type === 'VEC3') {
      const bounds = (pick) => Array.from({ length: each }, (_, k) => pick(...numbers.filter((_unused, i) => i % each === k).map(Math.fround)));
      Object.assign(accessor, { min: bounds(Math.min), max: bounds(Math.max) });
    }
    return json.accessors.push(accessor) - 1;
  };
  const materialOf = (material) => {
    const at = json.materials.indexOf(material);
    return at >= 0 ? at : json.materials.push(material) - 1;
  };
  const primitive = ({ mesh, material, extensions }) => ({
    attributes: Object.fromEntries(Object.entries(attributes).filter(([key]) => mesh[key]).map(([key, [name, type]]) => [name, add(mesh[key], type)])),
    indices: add(mesh.indices, 'SCALAR'), material: materialOf(material),
    ...(extensions && { extensions: { KHR_materials_variants: { mappings: extensions.map(({ material: other, ...rest }) => ({ ...rest, material: materialOf(other) })) } } }),
  });
  for (const { mesh, material, variantsOf, primitives, ...node } of parts) {
    const all = primitives ?? (mesh ? [{ mesh, material, extensions: variantsOf }] : []);
    if (all.length > 0) node.mesh = json.meshes.push({ primitives: all.map(primitive) }) - 1;
    json.nodes.push(node);
  }
  Object.assign(json, { scenes: [{ nodes: json.nodes.map((_, i) => i) }], scene: 0 });
  if (pictures.length > 0) Object.assign(json, { images: pictures.map((bytes) => ({ bufferView: addView(bytes), mimeType: 'image/png' })), textures });
  if (samplers) json.samplers = samplers;
  if (lights) json.extensions = { KHR_lights_punctual: { lights } };
  if (variants) json.extensions = { ...json.extensions, KHR_materials_variants: { variants: variants.map((name) => ({ name })) } };
  const bin = Buffer.concat(chunks);
  json.buffers = [{ byteLength: bin.length }];
  const used = [...extensionsIn(json, new Set())].sort();
  if (used.length > 0) json.extensionsUsed = used;
  return glb({ json, bin });
}

/** A .glb whose JSON is changed. @param {Buffer} bytes @param {(json: object) => void} change */
export function edited(bytes, change) {
  const length = bytes.readUInt32LE(12), json = JSON.parse(bytes.subarray(20, 20 + length).toString());
  change(json);
  return glb({ json, bin: bytes.subarray(28 + length) });
}
