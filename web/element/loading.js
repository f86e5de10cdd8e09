// Files over the network, with progress from the bytes that have come.
import { environments, patterns, shapes } from './attributes.js';

/**
 * What an environment or a part of a scene is made from; kept, so that a restored context can have it again.
 * @typedef {object} Source
 * @property {string} url as in the attribute; a built-in name where contents is null
 * @property {string} name for sentences
 * @property {Uint8Array|ImageBitmap|null} contents
 * @property {string} [spec] of a part: name and keys as in the attribute `objects`; '': as it is
 * @property {'model'|'relief'} [kind] of a part
 * @property {string[]} [variants] of a file's materials, names
 * @property {boolean} [isAnimated] the file has animations
 */

/**
 * @typedef {object} Scene
 * @property {string} url that of its wish
 * @property {Source[]} parts
 * @property {'auto'|'thin'|'solid'} [walls] of the glass of files
 * @property {string} [variantName] of materials; '': as files have them
 * @property {Map<number, ImageBitmap>} [pictures] of the parts' materials, once they are decoded
 */

/** Attributes about a relief as the keys of `objects`. */
const reliefKeys = { reliefDepth: 'relief', reliefSlab: 'slab', reliefSmooth: 'smooth' };

function reliefOf(values) {
  const keys = Object.entries(reliefKeys).filter(([property]) => values[property] !== null).map(([property, key]) => `${key}=${values[property]}`);
  return { kind: 'relief', url: values.relief, spec: `relief:${keys}` };
}

/**
 * What `relief` or `src`, and `objects` ask for; `url` tells one wish from another.
 * @param {object} values of the attributes
 * @returns {{url: string, walls: string, variantName: string, parts: {kind: 'model'|'relief', url: string, spec: string}[]}}
 */
export function wishOf({ src, objects, relief, walls, variantName, placement = '', ...more }) {
  const specs = objects.split(/[;\n]/).map((text) => text.trim().replace(/\s*([:=,])\s*/g, '$1')).filter(Boolean);
  const parts = specs.map((spec) => ({ kind: 'model', url: spec.replace(/:[^:/]*$/, ''), spec })); // URLs have a slash behind their last colon
  if (relief !== '') parts.unshift(reliefOf({ relief, ...more }));
  else if (src !== '') parts.unshift({ kind: 'model', url: src, spec: placement && `model:${placement}` });
  const first = relief === '' ? src + placement : `${relief} ${parts[0].spec}`;
  const url = specs.length === 0 ? first : [first, ...specs].join('\n');
  const looks = parts.length === 0 || (walls === 'auto' && variantName === '') ? '' : `\n${walls}\n${variantName}`;
  return { url: url + looks, walls, variantName, parts };
}

/**
 * What a background says, as vtFrame_SetBackground in the core reads it: a vtBackground, a colour, degrees; null: nothing that can be.
 * @param {string} text @returns {{kind: number, color: number[], blur: number}|null}
 */
export function readBackground(text) {
  const value = { kind: ['environment', 'transparent'].indexOf(text), color: [0, 0, 0], blur: 6 };
  const [, blur] = /^blurred:?(.*)$/.exec(text) ?? [];
  const digits = /^#([\da-fA-F]{3}){1,2}$/.test(text) ? text.slice(1).replace(/^(.)(.)(.)$/, '$1$1$2$2$3$3') : '';
  if (text === 'blurred' || (Number(blur) >= 1 && Number(blur) <= 90)) Object.assign(value, { kind: 3, blur: Number(blur) || 6 });
  else if (digits) Object.assign(value, { kind: 2, color: digits.match(/../g).map((pair) => parseInt(pair, 16) / 255) });
  else if (/[./]/.test(text) && !/^(#|blurred)/.test(text)) value.kind = 4; // a URL
  return value.kind < 0 ? null : value;
}

/** The built-in of that name, or null. @returns {Source|null} */
export function builtIn(kind, url) {
  const names = { model: [...shapes, ...patterns], relief: patterns, environment: environments, background: [] }[kind];
  return names.includes(url) ? { url, name: url, contents: null } : null;
}

/** Why a fetch failed, as far as a browser tells; whether another server is there, a request shows whose answer nobody may read. */
async function explain(href, { message }) {
  const { origin, host } = new URL(href);
  if (navigator.onLine === false) return 'the browser is offline; try again once it is not';
  if (origin === location.origin) return `the server cannot be reached (${message})`;
  const isThere = await fetch(href, { method: 'HEAD', mode: 'no-cors' }).then(() => true, () => false);
  return isThere ? `${host} does not let this page read it; it has to answer with Access-Control-Allow-Origin` : `${host} cannot be reached (${message})`;
}

/**
 * @param {string} url relative to the page
 * @param {AbortSignal} signal
 * @param {(received: number, total: number) => void} onBytes total is 0 where the server does not say
 * @param {number} most bytes: a server may send without end
 * @returns {Promise<Source>} @throws {Error} a sentence
 */
export async function fetchSource(url, signal, onBytes, most = 2 ** 31) {
  const { href, pathname } = new URL(url, document.baseURI);
  const name = pathname.split('/').pop() || url;
  const response = await fetch(href, { signal }).catch(async (reason) => {
    if (signal.aborted) throw reason;
    throw new Error(`${name}: cannot be fetched: ${await explain(href, reason)}`, { cause: reason });
  });
  if (!response.ok) {
    const answer = `the server answered ${response.status} ${response.statusText}`.trim();
    throw new Error(/[./]/.test(url) ? `${name}: ${answer}` : `${name}: neither a built-in name nor a file: ${answer}`);
  }
  // A compressed transfer counts other bytes than its length.
  const plain = !response.headers.get('content-encoding');
  const total = plain ? Number(response.headers.get('content-length')) || 0 : 0;
  const chunks = [], reader = response.body.getReader();
  let received = 0;
  try {
    while (Math.max(received, total) <= most) {
      const { done, value } = await reader.read();
      if (done) break;
      chunks.push(value);
      onBytes((received += value.length), total);
    }
  } catch (reason) {
    if (signal.aborted) throw reason;
    throw new Error(`${name}: broke off after ${received} bytes: ${reason.message}`, { cause: reason });
  }
  if (Math.max(received, total) > most) {
    reader.cancel().catch(() => {});
    throw new Error(`${name}: it has more than ${most} bytes; make it smaller, or allow more (max-memory)`);
  }
  const bytes = new Uint8Array(received);
  let place = 0;
  for (const chunk of chunks) {
    bytes.set(chunk, place);
    place += chunk.length;
  }
  return { url, name, contents: bytes };
}

/**
 * What has to be known of a model before the core reads it.
 * @param {Uint8Array} bytes .glb or .gltf
 * @returns {{isPacked: boolean, isAnimated: boolean, variants: string[]}} isPacked: in several files, or geometry is packed, which unpack.js mends
 */
export function lookInto(bytes) {
  const isBinary = bytes[0] === 0x67 && bytes.length > 20;
  const text = new TextDecoder().decode(isBinary ? bytes.subarray(20, 20 + new DataView(bytes.buffer).getUint32(12, true)) : bytes);
  const isPacked = /"KHR_draco_mesh_compression"|"(EXT|KHR)_meshopt_compression"|"uri"\s*:\s*"(?!data:)/.test(text);
  let variants = [];
  try {
    if (/"KHR_materials_variants"/.test(text)) variants = JSON.parse(text).extensions.KHR_materials_variants.variants.map(({ name }) => String(name));
  } catch {} // the core says what is wrong
  return { isPacked, isAnimated: /"animations"\s*:/.test(text), variants };
}

/** One number from 0 to 1 for all files of a load; it never goes back. */
export class Progress {
  static ofBytes = 0.9; // the rest is decoding and the first frame
  #parts = new Map();
  #value = 0;
  #tell;

  /** @param {(value: number) => void} tell called at each change */
  constructor(tell) {
    this.#tell = tell;
    tell(0);
  }

  expect(key) {
    this.#parts.set(key, { received: 0, total: 0 });
  }

  bytes(key, received, total) {
    this.#parts.set(key, { received, total });
    let sum = 0, all = 0;
    for (const part of this.#parts.values()) {
      sum += part.received;
      all += part.total || Math.max(2 * part.received, 1e5); // unknown: half of it is assumed to be here
    }
    this.advance(Progress.ofBytes * Math.min(1, sum / all));
  }

  advance(value) {
    if (value > this.#value) this.#tell((this.#value = value));
  }
}

/** A sentence where no file has the variant that is asked for; their materials are as they are then. */
export function variantProblem({ variantName = '', parts }) {
  const names = parts.flatMap(({ variants }) => variants ?? []);
  if (variantName === '' || names.includes(variantName)) return '';
  return `variant-name is '${variantName}'; ${names.length > 0 ? `the files have ${names.map((name) => `'${name}'`).join(', ')}` : 'the files have none; leave it away'}`;
}

/** Has it a part that the smaller core cannot show: a file with animations, or a panel? @param {Scene|Source|null|undefined} source */
export function needsFull(source) {
  return source?.parts?.some(({ isAnimated, url }) => isAnimated || url === 'panel') ?? false;
}
