// Makes one .glb that the core reads of a glTF file in several files, or with packed geometry. A module of its own, which a
// page loads only for such a model; so are the decoders. Only what the core reads comes along: accessors and pictures.
// By the specifications of glTF 2.0, KHR_draco_mesh_compression, EXT_meshopt_compression and KHR_meshopt_compression.

const damaged = 'the file is damaged, export it again';
const mostBytes = 2 ** 31; // of files and unpacked data together, as src/gltf/gltf.h has it
const componentsOf = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT2: 4, MAT3: 9, MAT4: 16 };
const dracoName = 'KHR_draco_mesh_compression', meshoptNames = ['EXT_meshopt_compression', 'KHR_meshopt_compression'];
const textureNames = ['EXT_texture_webp', 'EXT_texture_avif', 'KHR_texture_basisu']; // whose pictures the core prefers

/** What is wrong with a file, in words for its user. */
class Problem extends Error {}

/** The texts of a .glb or .gltf. @param {Uint8Array} file */
function open(file) {
  if (file[0] !== 0x67) return { json: JSON.parse(new TextDecoder().decode(file)), bin: null };
  const words = new DataView(file.buffer, file.byteOffset, file.length), length = words.getUint32(12, true), next = 20 + length;
  const json = JSON.parse(new TextDecoder().decode(file.subarray(20, next)).replace(/[\0 ]+$/, ''));
  const hasBin = next + 8 <= file.length && words.getUint32(next + 4, true) === 0x4e4942;
  return { json, bin: hasBin ? file.subarray(next + 8, next + 8 + words.getUint32(next, true)) : null };
}

/** @param {object} json @param {Uint8Array[]} chunks each of a multiple of 4 bytes @param {number} length of all */
function join(json, chunks, length) {
  const text = new TextEncoder().encode(JSON.stringify(json)), room = (text.length + 3) & ~3;
  const file = new Uint8Array(28 + room + length).fill(32, 20, 20 + room);
  const words = new DataView(file.buffer);
  [0x46546c67, 2, file.length, room, 0x4e4f534a].forEach((word, i) => words.setUint32(4 * i, word, true));
  file.set(text, 20);
  words.setUint32(20 + room, length, true);
  words.setUint32(24 + room, 0x4e4942, true);
  let place = 28 + room;
  for (const chunk of chunks) {
    file.set(chunk, place);
    place += (chunk.length + 3) & ~3;
  }
  return file;
}

/** What a data: URL holds. A page's policy may forbid to fetch it. */
function decodeData(uri, what) {
  const comma = uri.indexOf(','), text = uri.slice(comma + 1).replace(/%([0-9a-f]{2})/gi, (_, code) => String.fromCharCode(parseInt(code, 16)));
  try {
    return Uint8Array.from(/;base64$/i.test(uri.slice(0, comma)) ? atob(text.replaceAll('-', '+').replaceAll('_', '/')) : text, (letter) => letter.charCodeAt(0));
  } catch {
    throw new Problem(`the data URI of a ${what} cannot be decoded; export it as .glb`);
  }
}

/** A decoder's module, and what its load gives. */
async function decoderOf(module, path) {
  try {
    const { load, decode } = await module;
    return { tool: await load(), decode };
  } catch (reason) {
    throw new Problem(`it is packed, and element/${path} cannot be loaded (${reason.message}); serve it with the element`, { cause: reason });
  }
}

/** One file on its way to be another. */
class Repacking {
  #json;
  #bin;
  #read;
  #files = new Map(); // promises by addresses
  #kept = new Map(); // promises of new views by their old numbers
  #decoders = {};
  #left = mostBytes;
  #views = [];
  #chunks = [];
  #length = 0;

  constructor({ json, bin }, read) {
    this.#json = json;
    this.#bin = bin;
    this.#read = read;
  }

  #spend = (bytes) => {
    if (!(bytes <= this.#left)) throw new Problem(`its data take more than ${mostBytes} bytes; simplify it`);
    this.#left -= bytes;
  };

  #element(list, index, what) {
    const element = this.#json[list]?.[index];
    if (typeof element !== 'object' || element === null) throw new Problem(`it refers to ${what} ${index}, which it has not; ${damaged}`);
    return element;
  }

  /** The file at an address, once. */
  #load(uri, what) {
    const load = async () => {
      const bytes = uri.startsWith('data:') ? decodeData(uri, what) : await this.#read(uri, what).catch((reason) => {
        throw new Problem(`its ${what} '${uri.slice(0, 120)}' cannot be read: ${reason.message}`, { cause: reason });
      });
      this.#spend(bytes.length);
      return bytes;
    };
    if (!this.#files.has(uri)) {
      this.#files.set(uri, load());
      this.#files.get(uri).catch(() => {}); // told to whoever needs it
    }
    return this.#files.get(uri);
  }

  /** Bytes of a buffer. */
  async #part({ buffer, byteOffset = 0, byteLength }) {
    const { uri } = this.#element('buffers', buffer, 'buffer');
    const bytes = uri !== undefined ? await this.#load(uri, 'buffer') : buffer === 0 && this.#bin;
    if (!bytes) throw new Problem(`it reads buffer ${buffer}, which has no data; ${damaged}`);
    if (!(byteOffset >= 0 && byteLength >= 0 && byteOffset + byteLength <= bytes.length)) throw new Problem(`it reads beyond the end of buffer ${buffer}; ${damaged}`);
    return bytes.subarray(byteOffset, byteOffset + byteLength);
  }

  #decoder(name) {
    this.#decoders[name] ??= name === 'draco' ? decoderOf(import('./draco.js'), 'draco.js') : decoderOf(import('./meshopt.js'), 'meshopt.js');
    return this.#decoders[name];
  }

  async #unpack(name, what, ...values) {
    const { tool, decode } = await this.#decoder(name);
    try {
      return decode(tool, ...values, this.#spend);
    } catch (reason) {
      throw reason instanceof Problem ? reason : new Problem(`${what} cannot be unpacked (${reason.message}); ${damaged}`, { cause: reason });
    }
  }

  /** @returns {number} of the new view */
  #add(bytes, byteStride) {
    this.#views.push({ buffer: 0, byteOffset: this.#length, byteLength: bytes.length, byteStride });
    this.#chunks.push(bytes);
    this.#length += (bytes.length + 3) & ~3;
    return this.#views.length - 1;
  }

  async #moveView(index) {
    const view = this.#element('bufferViews', index, 'buffer view');
    const packed = meshoptNames.map((name) => view.extensions?.[name]).find(Boolean);
    const bytes = packed ? await this.#unpack('meshopt', `buffer view ${index}`, await this.#part(packed), packed) : await this.#part(view);
    return this.#add(bytes, view.byteStride);
  }

  /** The view in the new file of one in the old. */
  #keep(index) {
    if (!this.#kept.has(index)) this.#kept.set(index, this.#moveView(index));
    return this.#kept.get(index);
  }

  async #keepIn(holder) {
    if (typeof holder === 'object' && holder !== null && holder.bufferView !== undefined) holder.bufferView = await this.#keep(holder.bufferView);
  }

  /** Unpacks a primitive into accessors of its own. */
  async #unpackPrimitive(primitive) {
    const { bufferView, attributes } = primitive.extensions[dracoName];
    delete primitive.extensions[dracoName];
    const wanted = new Map();
    for (const name of Object.keys(attributes).filter((one) => Object.hasOwn(primitive.attributes, one))) {
      const { componentType, type } = this.#element('accessors', primitive.attributes[name], 'accessor');
      wanted.set(name, { id: attributes[name], componentType, components: componentsOf[type] });
    }
    const bytes = await this.#part(this.#element('bufferViews', bufferView, 'buffer view'));
    const told = [primitive.indices, primitive.attributes.POSITION].map((index) => this.#json.accessors?.[index]?.count ?? 0);
    const most = Math.max(2 ** 20, ...told); // of a few, more than is told: some programs count them wrongly
    const { vertexCount, attributes: unpacked, indices } = await this.#unpack('draco', 'a packed primitive', bytes, wanted, most);
    const addAccessor = (data, like) => this.#json.accessors.push({ ...like, bufferView: this.#add(data), byteOffset: 0, sparse: undefined }) - 1;
    for (const [name, data] of unpacked) {
      primitive.attributes[name] = addAccessor(data, { ...this.#json.accessors[primitive.attributes[name]], count: vertexCount });
    }
    primitive.indices = addAccessor(indices, { componentType: 5125, type: 'SCALAR', count: indices.length / 4 });
    primitive.mode = 4; // whatever it was before it was packed
  }

  /** The pictures of textures, as the core chooses among several of one. */
  #pictures() {
    const numbers = (this.#json.textures ?? []).map(({ source, extensions }) => textureNames.map((name) => extensions?.[name]?.source).find((one) => one !== undefined) ?? source);
    return new Set(numbers.filter((one) => one !== undefined));
  }

  async repack() {
    const json = this.#json, olds = [...(json.accessors ?? [])], used = this.#pictures();
    const isFallback = ({ extensions = {} }) => meshoptNames.some((name) => extensions[name]?.fallback);
    for (const buffer of json.buffers ?? []) if (buffer.uri !== undefined && !isFallback(buffer)) this.#load(buffer.uri, 'buffer'); // side by side
    for (const [i, { uri }] of (json.images ?? []).entries()) if (used.has(i) && uri !== undefined) this.#load(uri, 'picture');
    for (const mesh of json.meshes ?? []) {
      for (const primitive of mesh.primitives ?? []) {
        if (primitive.extensions?.[dracoName]) await this.#unpackPrimitive(primitive);
      }
    }
    for (const accessor of olds) {
      await this.#keepIn(accessor);
      await this.#keepIn(accessor.sparse?.indices);
      await this.#keepIn(accessor.sparse?.values);
    }
    for (const [i, image] of (json.images ?? []).entries()) {
      if (used.has(i)) {
        if (image.uri !== undefined) image.bufferView = this.#add(await this.#load(image.uri, 'picture'));
        else await this.#keepIn(image);
      } else delete image.bufferView;
      delete image.uri;
    }
    json.bufferViews = this.#views;
    json.buffers = [{ byteLength: this.#length }];
    for (const list of ['extensionsUsed', 'extensionsRequired']) json[list] &&= json[list].filter((name) => name !== dracoName && !meshoptNames.includes(name));
    return join(json, this.#chunks, this.#length);
  }
}

/**
 * Where a file is that a model names: in the model's folder or one below.
 * @param {string} model URL, relative to the page
 * @param {string} uri
 * @param {string} what a buffer or a picture
 * @throws {Error} why it is not fetched
 */
export function urlBeside(model, uri, what) {
  const base = new URL(model, document.baseURI);
  if (!/^https?:$/.test(base.protocol)) throw new Error(`this model has no folder; export it as one .glb`); // dropped onto the page
  const { href, origin, pathname } = new URL(uri, base);
  const isInside = origin === base.origin && pathname.startsWith(new URL('.', base).pathname) && !/%2f|%5c/i.test(pathname);
  if (!isInside) throw new Error(`it lies outside the model's folder; put the ${what} beside the model`);
  return href;
}

/**
 * @param {Uint8Array} file .glb or .gltf
 * @param {string} name for sentences
 * @param {(uri: string, what: string) => Promise<Uint8Array>} read a file that it names
 * @returns {Promise<Uint8Array>} .glb; the file as it is where its JSON is broken, of which the core tells
 * @throws {Error} a sentence
 */
export async function unpack(file, name, read) {
  let parts;
  try {
    parts = open(file);
  } catch {
    return file;
  }
  try {
    return await new Repacking(parts, read).repack();
  } catch (reason) {
    if (reason instanceof TypeError) throw new Error(`model '${name}': its JSON is not glTF (${reason.message}); ${damaged}`, { cause: reason });
    throw reason instanceof Problem ? new Error(`model '${name}': ${reason.message}`, { cause: reason }) : reason;
  }
}
