// A drawing by three.js that covers its whole target, and the reading back of one.
import { Mesh, NoBlending, OrthographicCamera, PlaneGeometry, ShaderMaterial, UnsignedByteType, WebGLRenderTarget } from 'three';

// `place`: of the pixel, from 0 to 1, from the lower left.
const vertexShader = `
varying vec2 place;
void main() {
  place = uv;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;

/** @param {object} parameters of ShaderMaterial */
export class Screen {
  #camera = new OrthographicCamera();
  #mesh;

  constructor(parameters) {
    this.material = new ShaderMaterial({ vertexShader, fog: false, ...parameters });
    this.#mesh = new Mesh(new PlaneGeometry(2, 2), this.material);
    this.#mesh.frustumCulled = false;
  }

  draw(renderer) {
    renderer.render(this.#mesh, this.#camera);
  }

  dispose() {
    this.#mesh.geometry.dispose();
    this.material.dispose();
  }
}

/** The numbers that a shader draws, 4 a pixel, the lowest row first. Leaves its own target set. @param {object} parameters of ShaderMaterial */
export function readScreen(renderer, parameters, width, height, type = UnsignedByteType) {
  const target = new WebGLRenderTarget(width, height, { type, depthBuffer: false });
  const screen = new Screen({ ...parameters, blending: NoBlending, depthTest: false });
  renderer.resetState();
  renderer.setRenderTarget(target);
  screen.draw(renderer);
  const numbers = new (type === UnsignedByteType ? Uint8Array : Float32Array)(4 * width * height);
  renderer.readRenderTargetPixels(target, 0, 0, width, height, numbers);
  renderer.setRenderTarget(null);
  screen.dispose();
  target.dispose();
  return numbers;
}
