// What surrounds a scene of three.js's, as one equirectangular picture of floats: three.js draws it, whatever kind of
// texture it is, and it is read back.
import { Color, CubeReflectionMapping, CubeRefractionMapping, EquirectangularReflectionMapping, EquirectangularRefractionMapping, Euler, FloatType, Matrix4, REVISION } from 'three';
import { readScreen } from './screen.js';

const CubeUVReflectionMapping = 306; // of PMREMGenerator, which later gives a cube; not exported

// Rows are read from the lowest on, and the top one is asked for first.
const body = `
varying vec2 place;
#ifdef IS_CUBE
  uniform samplerCube source;
#else
  uniform sampler2D source;
#endif
void main() {
  float around = (place.x - 0.5) * 6.283185307179586, up = (0.5 - place.y) * 3.141592653589793;
  vec3 direction = vec3(cos(up) * cos(around), sin(up), cos(up) * sin(around));
  #ifdef IS_CUBE
    gl_FragColor = textureLod(source, vec3(FLIP * direction.x, direction.yz), 0.0);
  #elif defined(CUBEUV_MAX_MIP)
    gl_FragColor = textureCubeUV(source, direction, 0.0);
  #else
    gl_FragColor = textureLod(source, vec2(place.x, 1.0 - place.y), 0.0);
  #endif
}`;

const ofEarlierPmrem = `
#define ENVMAP_TYPE_CUBE_UV
#include <common>
#include <cube_uv_reflection_fragment>
`;

const mostColumns = 4096;

/** Of a texture: what the shader is told, and columns of the picture; null where it is no surroundings. */
function describe(texture) {
  const { mapping, image } = texture;
  const side = (Array.isArray(image) ? image[0]?.width ?? image[0]?.image?.width : image?.width) ?? 0;
  if (mapping === CubeUVReflectionMapping) { // as three.js's WebGLProgram has it
    const height = image.height, levels = Math.log2(height) - 2;
    const defines = { CUBEUV_TEXEL_WIDTH: 1 / (3 * Math.max(2 ** levels, 7 * 16)), CUBEUV_TEXEL_HEIGHT: 1 / height, CUBEUV_MAX_MIP: `${levels}.0` };
    return { defines, columns: height };
  }
  if (texture.isCubeTexture && [CubeReflectionMapping, CubeRefractionMapping].includes(mapping)) {
    return { defines: { IS_CUBE: '', FLIP: texture.isRenderTargetTexture ? '1.0' : '-1.0' }, columns: 4 * side };
  }
  return mapping === EquirectangularReflectionMapping || mapping === EquirectangularRefractionMapping ? { defines: {}, columns: side } : null;
}

/** The texture as floats: {pixels (3 each, top row first), width, height}. */
function readBack(renderer, texture, { defines, columns }) {
  const width = Math.min(Math.max(columns, 4), mostColumns), height = width / 2;
  const fragmentShader = ('CUBEUV_MAX_MIP' in defines ? ofEarlierPmrem : '') + body;
  const read = readScreen(renderer, { uniforms: { source: { value: texture } }, defines, fragmentShader }, width, height, FloatType);
  const pixels = new Float32Array(3 * width * height);
  for (let i = 0; i < width * height; ++i) {
    for (let part = 0; part < 3; ++part) pixels[3 * i + part] = Math.min(Math.max(read[4 * i + part], 0), 65504) || 0;
  }
  return { pixels, width, height };
}

function ofColor({ r, g, b }) {
  const pixels = new Float32Array(3 * 4 * 2);
  for (let i = 0; i < 8; ++i) pixels.set([r, g, b], 3 * i);
  return { pixels, width: 4, height: 2 };
}

const noRotation = new Euler(), angles = new Euler();
const clearColor = new Color();

export class Environment {
  /** From three.js's world to that of the core, in which the picture is not turned. */
  rotation = new Matrix4();
  intensity = 1;
  #shown = ''; // what of it the core has

  /** The texture that is the surroundings, or a colour. */
  #choose(renderer, scene, note) {
    const { environment, background } = scene;
    for (const texture of [environment, background]) {
      if (!texture?.isTexture) continue;
      const kind = describe(texture);
      if (kind?.columns > 0) {
        const isOwn = texture === environment;
        this.intensity = Math.max((isOwn ? scene.environmentIntensity : scene.backgroundIntensity) ?? 1, 1e-6); // exposure is its logarithm
        return { texture, kind, rotation: (isOwn ? scene.environmentRotation : scene.backgroundRotation) ?? noRotation };
      }
      if (!kind && texture === environment) note('scene.environment is neither equirectangular nor a cube nor made by PMREMGenerator; glass is drawn without it');
    }
    this.intensity = 1;
    const color = background?.isColor ? background : renderer.getClearAlpha() > 0 ? renderer.getClearColor(clearColor) : clearColor.set(0);
    return { color, rotation: noRotation };
  }

  /** As three.js turns surroundings: the other way round, and before 0.184 with angles of the other sign. */
  #turn({ x, y, z, order }) {
    if (Number.parseInt(REVISION, 10) >= 184) this.rotation.makeRotationFromEuler(angles.set(x, y, z, order)).transpose();
    else this.rotation.makeRotationFromEuler(angles.set(-x, -y, -z, order));
  }

  /** Gives the core what surrounds the scene, if it has changed. @param {(sentence: string) => void} note */
  update(renderer, scene, core, note) {
    const { texture, kind, color, rotation } = this.#choose(renderer, scene, note);
    this.#turn(rotation);
    const wanted = texture ? `${texture.uuid} ${texture.version} ${texture.pmremVersion ?? 0} ${kind.columns}` : `${color.r} ${color.g} ${color.b}`;
    if (wanted === this.#shown) return;
    if (kind?.columns > mostColumns) note(`scene.environment has ${kind.columns} columns; glass sees it with ${mostColumns}`);
    const { pixels, width, height } = texture ? readBack(renderer, texture, kind) : ofColor(color);
    core.attempt('SetEnvironment', core.place(pixels), width, height);
    this.#shown = wanted;
  }

  /** Asks for the surroundings anew: a render target's texture does not tell that it was drawn. */
  forget() {
    this.#shown = '';
  }
}
