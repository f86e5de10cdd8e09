import type { Camera, Scene, WebGLRenderer } from 'three';

export interface GlassOptions {
  /** Work a pixel may be: numbers of events and branches. Default 'medium'. */
  preset?: 'low' | 'medium' | 'high';
  /** Samples a pixel of the glass, 1 to 4096, each as costly as the first. Default 1. */
  samples?: number;
  /** Refractions and internal reflections of a path, 1 to 64; 0, the default: the preset's. */
  maxEvents?: number;
  /** How often light that left a path is followed, 1 to 4; -1: never; 0, the default: the preset's. */
  branches?: number;
  /** Reflection at surfaces. Default true. */
  fresnel?: boolean;
  /** Where vitrine-three.wasm and vitrine-shaders.txt are, if not beside the module. */
  locateFile?: (name: string) => string;
  /** The contents of vitrine-three.wasm, in place of fetching it. */
  wasmBinary?: BufferSource;
}

export interface Glass {
  /**
   * Draws the scene into the renderer's present target, as `renderer.render` does, its glass by Vitrine.
   * False: three.js drew all of it, as there is no glass, something is still to come (shaders, geometry, a
   * lost context), or it cannot be drawn (see `notes`).
   */
  render(scene: Scene, camera: Camera): boolean;
  /** Draws until nothing is still to come. */
  compileAsync(scene: Scene, camera: Camera): Promise<void>;
  /** The last frame, or a part of its glass, was three.js's as something is still to come: draw again. */
  readonly isWaiting: boolean;
  /** Reads the surroundings anew with the next frame: a render target's texture does not tell that it was drawn. */
  updateEnvironment(): void;
  /** Sentences on what is drawn otherwise than the scene asks; each was printed once. */
  readonly notes: string[];
  /** What is held: geometries in the core, meshes drawn by the last frame, bytes of the WebAssembly's memory. */
  readonly statistics: { geometries: number; objects: number; heapBytes: number };
  /** Gives everything back but the renderer. */
  dispose(): void;
}

/** Glass for a renderer without logarithmic or reversed depth buffer. Rejects with a sentence. */
export function createGlass(renderer: WebGLRenderer, options?: GlassOptions): Promise<Glass>;
