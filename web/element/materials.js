// The materials of what is shown, for pages: objects whose properties can be read and set.

/** Properties that can be set, and their keys in the attribute `objects`, which says what they mean. */
const keys = { ior: 'ior', tint: 'tint', absorption: 'absorb', absorptionDistance: 'distance', roughness: 'roughness', dispersion: 'dispersion' };

/**
 * @param {(index: number) => object|null} read the present values of a material
 * @param {(index: number, text: string) => void} write "key=value"; throws a sentence
 */
export function listMaterials(read, write) {
  const list = [];
  for (let index = 0; read(index) !== null; ++index) {
    const { opaque } = read(index);
    const properties = Object.entries(keys).map(([property, key]) => [property, {
      enumerable: true,
      get: () => read(index)?.[property],
      set: (value) => write(index, `${key}=${value}`),
    }]);
    list.push(Object.defineProperties({ opaque }, Object.fromEntries(properties)));
  }
  return list;
}
