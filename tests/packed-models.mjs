// The same models packed: by Draco, by meshoptimizer, their pictures by Basis Universal, in several files.
import { createRequire } from 'node:module';
import { glb } from '../scripts/glb.mjs';

const widths = { 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4 };
const lengths = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };

/** The parts of a .glb. @returns {{json: object, bin: Buffer}} */
export function parts(file) {
  const length = file.readUInt32LE(12);
  return { json: JSON.parse(file.subarray(20, 20 + length).toString()), bin: file.subarray(28 + length) };
}

const viewBytes = ({ json, bin }, index) => bin.subarray(json.bufferViews[index].byteOffset ?? 0).subarray(0, json.bufferViews[index].byteLength);

/** An accessor of tightly packed floats or 16-bit numbers, as scripts/glb.mjs and case-models.mjs write them. */
function numbers(file, accessor) {
  const bytes = Uint8Array.from(viewBytes(file, accessor.bufferView));
  return accessor.componentType === 5126 ? new Float32Array(bytes.buffer) : new Uint16Array(bytes.buffer);
}

/** New views one after the other. */
class Bin {
  views = [];
  #chunks = [];
  #length = 0;

  /** @returns {number} of the view */
  add(bytes, more = {}) {
    const place = { byteOffset: this.#length, byteLength: bytes.length };
    this.#chunks.push(Buffer.from(bytes), Buffer.alloc(-bytes.length & 3));
    this.#length += (bytes.length + 3) & ~3;
    return this.views.push({ buffer: 0, ...place, ...more }) - 1;
  }

  get bytes() {
    return Buffer.concat(this.#chunks);
  }
}

function requireExtension(json, name) {
  json.extensionsUsed = [...(json.extensionsUsed ?? []), name];
  json.extensionsRequired = [...(json.extensionsRequired ?? []), name];
}

function keepImages(file, bin) {
  for (const image of file.json.images ?? []) image.bufferView = bin.add(viewBytes(file, image.bufferView));
}

/**
 * A .glb whose primitives are packed by Draco: normals and places quantized where bits are given, colours of 8 bits; one
 * triangle after the other where it is inOrder, not by Edgebreaker; with metadata of the mesh and of its places.
 */
export async function packDraco(bytes, { bits, inOrder = false, metadata = false } = {}) {
  const draco = await createRequire(import.meta.url)('draco3dgltf').createEncoderModule();
  const file = parts(bytes), { json } = file, bin = new Bin();
  const kinds = { POSITION: draco.POSITION, NORMAL: draco.NORMAL, TEXCOORD_0: draco.TEX_COORD, COLOR_0: draco.COLOR };
  for (const primitive of json.meshes.flatMap(({ primitives }) => primitives)) {
    const encoder = new draco.Encoder(), builder = new draco.MeshBuilder(), mesh = new draco.Mesh(), packed = new draco.DracoInt8Array();
    const indices = json.accessors[primitive.indices], ids = {};
    builder.AddFacesToMesh(mesh, indices.count / 3, Uint32Array.from(numbers(file, indices)));
    for (const [name, index] of Object.entries(primitive.attributes)) {
      const accessor = json.accessors[index], data = numbers(file, accessor), each = lengths[accessor.type];
      if (name === 'COLOR_0') {
        ids[name] = builder.AddUInt8Attribute(mesh, kinds[name], accessor.count, each, Uint8Array.from(data, (value) => Math.round(255 * value)));
        Object.assign(accessor, { componentType: 5121, normalized: true });
      } else {
        ids[name] = builder.AddFloatAttribute(mesh, kinds[name], accessor.count, each, data);
        if (bits) encoder.SetAttributeQuantization(kinds[name], bits);
      }
    }
    if (metadata) {
      const about = new draco.MetadataBuilder(), all = new draco.Metadata(), places = new draco.Metadata();
      for (const one of [all, places]) {
        about.AddStringEntry(one, 'name', 'a name '.repeat(40));
        about.AddIntEntry(one, 'number', 7);
      }
      builder.AddMetadata(mesh, all);
      builder.SetMetadataForAttribute(mesh, ids.POSITION, places);
    }
    encoder.SetEncodingMethod(inOrder ? draco.MESH_SEQUENTIAL_ENCODING : draco.MESH_EDGEBREAKER_ENCODING);
    const size = encoder.EncodeMeshToDracoBuffer(mesh, packed);
    const view = bin.add(Uint8Array.from({ length: size }, (_, i) => packed.GetValue(i)));
    primitive.extensions = { ...primitive.extensions, KHR_draco_mesh_compression: { bufferView: view, attributes: ids } };
  }
  for (const accessor of json.accessors) delete accessor.bufferView;
  keepImages(file, bin);
  Object.assign(json, { bufferViews: bin.views, buffers: [{ byteLength: bin.bytes.length }] });
  requireExtension(json, 'KHR_draco_mesh_compression');
  return glb({ json, bin: bin.bytes });
}

/** As meshoptimizer's filter has them: 16 bits a part, and its last number is of no use. */
const octahedral = (encoder, data) => encoder.encodeFilterOct(Float32Array.from({ length: (data.length / 3) * 4 }, (_, i) => (i % 4 === 3 ? 0 : data[(i >> 2) * 3 + (i % 4)])), data.length / 3, 8, 16);

/** A .glb whose views are packed by meshoptimizer; normals by a filter. @param {'EXT_meshopt_compression'|'KHR_meshopt_compression'} name the latter in its newer coding, colours by its own filter */
export async function packMeshopt(bytes, name = 'EXT_meshopt_compression') {
  const { MeshoptEncoder } = await import('meshoptimizer/encoder');
  await MeshoptEncoder.ready;
  const file = parts(bytes), { json } = file, bin = new Bin(), isNew = name === 'KHR_meshopt_compression', indices = new Set(), normals = new Set(), colors = new Set();
  let length = 0; // of what is unpacked
  for (const primitive of json.meshes.flatMap(({ primitives }) => primitives)) {
    indices.add(primitive.indices);
    normals.add(primitive.attributes.NORMAL);
    colors.add(primitive.attributes.COLOR_0);
  }
  for (const [i, accessor] of json.accessors.entries()) {
    const data = numbers(file, accessor), { count } = accessor, how = { buffer: 0, count };
    let unpacked = data;
    if (indices.has(i)) Object.assign(how, { mode: 'TRIANGLES', byteStride: 2 });
    else if (normals.has(i)) {
      unpacked = octahedral(MeshoptEncoder, data);
      Object.assign(accessor, { componentType: 5122, normalized: true });
      Object.assign(how, { mode: 'ATTRIBUTES', filter: 'OCTAHEDRAL', byteStride: 8 });
    } else if (isNew && colors.has(i)) {
      unpacked = MeshoptEncoder.encodeFilterColor(data, count, 4, 8);
      Object.assign(accessor, { componentType: 5121, normalized: true });
      Object.assign(how, { mode: 'ATTRIBUTES', filter: 'COLOR', byteStride: 4 });
    } else Object.assign(how, { mode: 'ATTRIBUTES', byteStride: widths[accessor.componentType] * lengths[accessor.type] });
    const packed = MeshoptEncoder.encodeGltfBuffer(new Uint8Array(unpacked.buffer, unpacked.byteOffset, unpacked.byteLength), count, how.byteStride, how.mode, isNew ? 1 : 0);
    accessor.bufferView = bin.add(packed);
    const view = bin.views[accessor.bufferView];
    how.byteOffset = view.byteOffset;
    how.byteLength = view.byteLength;
    bin.views[accessor.bufferView] = { buffer: 1, byteOffset: length, byteLength: count * how.byteStride, ...(!indices.has(i) && { byteStride: how.byteStride }), extensions: { [name]: how } };
    length += (count * how.byteStride + 3) & ~3;
  }
  keepImages(file, bin);
  Object.assign(json, { bufferViews: bin.views, buffers: [{ byteLength: bin.bytes.length }, { byteLength: length, extensions: { [name]: { fallback: true } } }] });
  requireExtension(json, name);
  return glb({ json, bin: bin.bytes });
}

/** A picture as KTX 2. @param {{width: number, height: number, data: Uint8Array}} picture RGBA @param {boolean} isUastc else ETC1S */
export async function packPicture({ width, height, data }, isUastc) {
  const { encodeToKTX2 } = await import('ktx2-encoder');
  const say = console.log; // the encoder tells what it does
  console.log = () => {};
  try {
    return Buffer.from(await encodeToKTX2(data, { isUASTC: isUastc, generateMipmap: true, needSupercompression: true, imageDecoder: async () => ({ width, height, data }) }));
  } finally {
    console.log = say;
  }
}

/** A .glb with another picture in place of its first one, by an extension of its textures. */
export function withPicture(bytes, picture, name, mimeType) {
  const file = parts(bytes), { json } = file;
  const start = file.bin.length + (-file.bin.length & 3);
  json.images[0] = { bufferView: json.bufferViews.push({ buffer: 0, byteOffset: start, byteLength: picture.length }) - 1, mimeType };
  json.buffers[0].byteLength = start + picture.length;
  json.textures = json.textures.map((texture) => {
    const { source, ...rest } = texture;
    return source === 0 ? { ...rest, extensions: { [name]: { source } } } : texture;
  });
  requireExtension(json, name);
  return glb({ json, bin: Buffer.concat([file.bin, Buffer.alloc(start - file.bin.length), picture]) });
}

/** The same as .gltf, its buffer in a file of its own, and its pictures in others. @returns {Record<string, Buffer>} by their names */
export function apart(bytes, name) {
  const file = parts(bytes), { json } = file, files = {};
  for (const [i, image] of (json.images ?? []).entries()) {
    files[`${name} pictures/${i}.png`] = viewBytes(file, image.bufferView);
    json.images[i] = { uri: `${encodeURIComponent(`${name} pictures`)}/${i}.png` };
  }
  json.buffers[0].uri = `${name}.bin`;
  return { ...files, [`${name}.bin`]: file.bin, [`${name}.gltf`]: Buffer.from(JSON.stringify(json)) };
}

/** The same as .gltf with all in it. */
export function within(bytes) {
  const { json, bin } = parts(bytes);
  json.buffers[0].uri = `data:application/octet-stream;base64,${bin.toString('base64')}`;
  return Buffer.from(JSON.stringify(json));
}
