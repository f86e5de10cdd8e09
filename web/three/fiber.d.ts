import type { Glass as GlassOfRenderer, GlassOptions } from './index.js';

export interface GlassProps extends GlassOptions {
  /** Of useFrame; above 0 it takes the drawing over. Default 1. */
  renderPriority?: number;
  onReady?: (glass: GlassOfRenderer) => void;
  /** Default: the sentence is printed. */
  onError?: (reason: Error) => void;
}

/** Anywhere in a <Canvas>: draws its frames, glass by Vitrine. Options are looked at when it is mounted. */
export function Glass(props: GlassProps): null;
