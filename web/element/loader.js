// The files of one element: fetched side by side, shown environment first, dropped where the wish has changed.
import { Progress, builtIn, fetchSource, lookInto } from './loading.js';
import { decodePicture, mayBePicture } from './picture.js';

/** The part that was made from the same. */
const findPart = (parts, { kind, url }) => parts.find((part) => part.kind === kind && part.url === url);

export class Loader {
  /** Of the model that is loading, or came last. @type {Progress|null} */
  progress = null;
  #told;
  #abort = null;
  #most; // bytes of a file

  /**
   * @param {object} told
   * @param {(value: number) => void} told.progress 0 to 1
   * @param {(kind: 'model'|'environment', source: import('./loading.js').Source) => void} told.loaded
   * @param {(kind: 'model'|'environment', reason: Error) => void} told.failed
   */
  constructor(told) {
    this.#told = told;
  }

  abort() {
    this.#abort?.abort();
  }

  /**
   * Loads what differs from what is held, in place of any load before.
   * @param {{environment: {url: string}, background: {url: string}, model: ReturnType<import('./loading.js').wishOf>}} wishes url '': none
   * @param {{environment: object|null, background: object|null, model: object|null}} held sources
   * @param {number} [most] bytes of a file
   * @returns {Promise<boolean>} false where another load has begun, or this was aborted
   */
  async load(wishes, held, most) {
    this.abort();
    this.#most = most;
    const { signal } = (this.#abort = new AbortController());
    const isNew = (kind) => wishes[kind].url !== '' && held[kind]?.url !== wishes[kind].url;
    const parts = held.model?.parts ?? [];
    if (isNew('model') && !wishes.model.parts.every((part) => findPart(parts, part))) this.progress = new Progress(this.#told.progress);
    const kinds = ['environment', 'background', 'model'].filter(isNew); // the first frame shall have the first two
    const fetches = kinds.map((kind) => this.#fetch(kind, wishes[kind], parts, signal));
    for (const [i, kind] of kinds.entries()) {
      const source = await fetches[i];
      if (signal.aborted) return false;
      if (source !== null) this.#told.loaded(kind, source);
    }
    return !signal.aborted;
  }

  /** Null where it failed. */
  async #fetch(kind, { url, parts, walls, variantName }, held, signal) {
    try {
      if (kind === 'model') return { url, walls, variantName, parts: await this.#fetchParts(parts, held, signal) };
      const source = await this.#fetchOne(kind, url, signal);
      if (source.contents !== null) source.contents = await decodePicture(source.contents);
      return source;
    } catch (reason) {
      if (!signal.aborted) this.#told.failed(kind, reason);
      return null;
    }
  }

  /** What several parts have in common is fetched once; what is held, not at all. */
  #fetchParts(parts, held, signal) {
    const files = new Map();
    const fileOf = (part) => {
      const key = `${part.kind} ${part.url}`;
      if (!files.has(key)) files.set(key, findPart(held, part) ?? this.#fetchPart(part, signal));
      return files.get(key);
    };
    return Promise.all(parts.map(async (part) => ({ ...(await fileOf(part)), kind: part.kind, spec: part.spec })));
  }

  async #fetchPart({ kind, url }, signal) {
    const source = await this.#fetchOne(kind, url, signal);
    if (source.contents === null) return source;
    if (mayBePicture(source.contents)) source.contents = await decodePicture(source.contents);
    else await this.#openModel(source, signal);
    return source;
  }

  /** A model becomes one file that the core reads. */
  async #openModel(source, signal) {
    const { isPacked, ...known } = lookInto(source.contents);
    Object.assign(source, known);
    if (!isPacked) return;
    const { unpack, urlBeside } = await import('./unpack.js').catch((reason) => {
      throw new Error(`${source.name}: it is packed, or in several files, and element/unpack.js cannot be loaded (${reason.message}); serve it with the element`, { cause: reason });
    });
    source.contents = await unpack(source.contents, source.name, async (uri, what) => {
      const file = await this.#fetchFile('file', urlBeside(source.url, uri, what), signal);
      return file.contents;
    });
  }

  async #fetchOne(kind, url, signal) {
    const known = builtIn(kind, url);
    if (!known) return this.#fetchFile(kind, url, signal);
    this.progress?.expect(`${kind} ${url}`);
    this.progress?.bytes(`${kind} ${url}`, 1, 1);
    return known;
  }

  #fetchFile(kind, url, signal) {
    const { progress } = this;
    const key = `${kind} ${url}`;
    progress?.expect(key);
    return fetchSource(url, signal, (received, total) => progress?.bytes(key, received, total), this.#most);
  }
}
