// Numbers of three.js's attributes.

/** The numbers of an attribute, `size` a vertex and side by side; null without. */
export function numbersOf(attribute, size) {
  if (!attribute) return null;
  if (!attribute.isInterleavedBufferAttribute && !attribute.normalized && attribute.itemSize === size && attribute.array instanceof Float32Array) {
    return attribute.array.subarray(0, size * attribute.count);
  }
  const numbers = new Float32Array(size * attribute.count);
  for (let i = 0; i < attribute.count; ++i) {
    for (let part = 0; part < size; ++part) numbers[size * i + part] = attribute.getComponent(i, part);
  }
  return numbers;
}
