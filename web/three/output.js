// Where three.js draws what is not glass, where the glass is drawn, and the drawing that puts both together: by three.js,
// so that tones, colour space and depth are its own.
import { CustomBlending, DepthTexture, FloatType, HalfFloatType, LinearMipmapLinearFilter, NearestFilter, NoBlending, OneFactor, OneMinusSrcAlphaFactor, Vector4, WebGLRenderTarget } from 'three';
import { Screen } from './screen.js';

// Colours have their alpha in them; tones are mapped without, and of the background's colour not at all.
const fragmentShader = `
uniform sampler2D scene, glass;
uniform highp sampler2D sceneDepth, glassDepth;
uniform vec4 backdrop;
varying vec2 place;
void main() {
  vec4 before = texture2D(glass, place);
  vec4 light = before + (1.0 - before.a) * textureLod(scene, place, 0.0);
  float share = (1.0 - light.a) * backdrop.a;
  gl_FragDepth = min(texture2D(sceneDepth, place).r, texture2D(glassDepth, place).r);
  gl_FragColor = vec4(max(light.rgb - share * backdrop.rgb, 0.0) / max(light.a, 1e-6), light.a);
  #include <tonemapping_fragment>
  #include <colorspace_fragment>
  gl_FragColor.rgb *= light.a;
  gl_FragColor += share * linearToOutputTexel(vec4(backdrop.rgb, 1.0));
}`;

/** @param {boolean} hasLevels by which rough glass sees it */
function makeTarget(samples, hasLevels = false) {
  const options = { type: HalfFloatType, minFilter: hasLevels ? LinearMipmapLinearFilter : NearestFilter, magFilter: NearestFilter, generateMipmaps: hasLevels, samples };
  return new WebGLRenderTarget(1, 1, { ...options, depthTexture: new DepthTexture(1, 1, FloatType) });
}

function disposeTarget(target) {
  target.depthTexture.dispose();
  target.dispose();
}

export class Output {
  hasLevels = false;
  backdrop = new Vector4(); // the background's colour, which the scene has where its alpha is not 1
  #screen;

  constructor() {
    this.opaque = makeTarget(0);
    this.glass = makeTarget(0);
    const uniforms = { backdrop: { value: this.backdrop }, scene: {}, sceneDepth: {}, glass: { value: this.glass.texture }, glassDepth: { value: this.glass.depthTexture } };
    this.#screen = new Screen({ uniforms, fragmentShader, blendSrc: OneFactor, blendDst: OneMinusSrcAlphaFactor });
  }

  /** @param {number} samples of what three.js draws, a pixel @param {boolean} needsLevels from now on that has levels */
  setSize(width, height, samples, needsLevels) {
    if (samples !== this.opaque.samples || (needsLevels && !this.hasLevels)) {
      this.hasLevels ||= needsLevels;
      disposeTarget(this.opaque);
      this.opaque = makeTarget(samples, this.hasLevels);
    }
    this.opaque.setSize(width, height); // does nothing where they have it
    this.glass.setSize(width, height);
  }

  /** Draws both into the present target. @param {boolean} over what is there, in place of instead of it */
  draw(renderer, over) {
    const { uniforms } = this.#screen.material;
    uniforms.scene.value = this.opaque.texture;
    uniforms.sceneDepth.value = this.opaque.depthTexture;
    this.#screen.material.blending = over ? CustomBlending : NoBlending;
    this.#screen.draw(renderer);
  }

  dispose() {
    disposeTarget(this.opaque);
    disposeTarget(this.glass);
    this.#screen.dispose();
  }
}
