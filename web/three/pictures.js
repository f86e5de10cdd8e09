// The pictures of materials, read back from three.js's textures: whatever they come from, three.js can draw them.
import { readScreen } from './screen.js';

// Rows are read from the lowest on, and the top one is asked for first.
const fragmentShader = `
varying vec2 place;
uniform sampler2D source;
uniform bool isLinear, turnsGreen;
void main() {
  vec4 color = textureLod(source, vec2(place.x, 1.0 - place.y), 0.0);
  color = isLinear ? color : sRGBTransferOETF(color);
  color.g = turnsGreen ? 1.0 - color.g : color.g;
  gl_FragColor = color;
}`;

const mostSide = 2048;

function readBack(renderer, { texture, linear, turnsGreen, width, height }) {
  const uniforms = { source: { value: texture }, isLinear: { value: linear }, turnsGreen: { value: turnsGreen } };
  return readScreen(renderer, { uniforms, fragmentShader }, width, height);
}

export class Pictures {
  #list = []; // by the number of the image in the core
  #isStale = false;

  /** The image of a texture; -1 until it is loaded. @param {boolean} linear its numbers are no colours @param {boolean} turnsGreen a normal map whose green points down */
  use(texture, linear, turnsGreen) {
    const { image, version } = texture;
    const width = Math.min(image?.width ?? 0, mostSide), height = Math.min(image?.height ?? 0, mostSide);
    if (width === 0 || height === 0) return -1;
    let number = this.#list.findIndex((one) => one.texture === texture && one.linear === linear && one.turnsGreen === turnsGreen);
    if (number < 0) number = this.#list.push({ texture, linear, turnsGreen }) - 1;
    const picture = this.#list[number];
    this.#isStale ||= picture.version !== version || picture.width !== width || picture.height !== height;
    Object.assign(picture, { version, width, height, isUsed: true });
    return number;
  }

  /** Gives the core what materials have asked for, if it has changed. */
  update(renderer, core) {
    if (!this.#isStale) return;
    const places = this.#list.map((picture) => core.place(readBack(renderer, picture)));
    const table = core.place(new Uint32Array(this.#list.flatMap(({ width, height, linear }, i) => [width, height, Number(linear), places[i]])));
    try {
      core.attempt('SetImages', table, this.#list.length);
      this.#isStale = false;
    } finally {
      for (const place of [table, ...places]) core.free(place);
    }
  }
}
