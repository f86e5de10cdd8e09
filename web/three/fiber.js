// React Three Fiber: <Glass> anywhere in a <Canvas> draws its frames, glass by Vitrine.
import { useFrame, useThree } from '@react-three/fiber';
import { useEffect, useRef } from 'react';
import { createGlass } from './index.js';

/**
 * Takes over the drawing of the canvas. Until everything is there three.js draws as always.
 * @param {import('./fiber.d.ts').GlassProps} props options of createGlass, looked at when it is mounted; onReady(glass); onError(reason), else it is printed
 */
export function Glass({ onReady, onError = console.error, renderPriority = 1, ...options }) {
  const gl = useThree((state) => state.gl), invalidate = useThree((state) => state.invalidate);
  const glass = useRef(null);
  useEffect(() => {
    let isGone = false;
    createGlass(gl, options).then((made) => {
      if (isGone) return made.dispose();
      glass.current = made;
      invalidate();
      onReady?.(made);
    }).catch(onError);
    return () => {
      isGone = true;
      glass.current?.dispose();
      glass.current = null;
    };
  }, [gl]);
  useFrame(({ gl: renderer, scene, camera }) => {
    if (!glass.current) return renderer.render(scene, camera);
    glass.current.render(scene, camera);
    if (glass.current.isWaiting) invalidate(); // frameloop 'demand' draws when asked
  }, renderPriority);
  return null;
}
