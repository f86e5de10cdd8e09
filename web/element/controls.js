// Mouse, touch, pen, wheel and keys on a canvas. Pointer events cover the first three.
const radiansPerKey = Math.PI / 36;
const zoomPerKey = 0.9;
const zoomPerPixel = 0.001; // of the wheel

/**
 * @param {HTMLElement} target
 * @param {object} view told what to do
 * @param {() => boolean} view.isActive false: events are left to the page
 * @param {() => boolean} view.canZoom
 * @param {() => boolean} view.canPan
 * @param {(right: number, up: number) => void} view.turn radians
 * @param {(right: number, up: number) => void} view.pan parts of the canvas's height
 * @param {(factor: number) => void} view.zoom
 * @param {() => void} view.reset
 */
export function listenToControls(target, view) {
  const zoom = (factor) => view.canZoom() && view.zoom(factor);
  const keys = {
    ArrowLeft: () => view.turn(-radiansPerKey, 0),
    ArrowRight: () => view.turn(radiansPerKey, 0),
    ArrowUp: () => view.turn(0, radiansPerKey),
    ArrowDown: () => view.turn(0, -radiansPerKey),
    '+': () => zoom(zoomPerKey),
    '=': () => zoom(zoomPerKey),
    '-': () => zoom(1 / zoomPerKey),
    Home: () => view.reset(),
  };
  target.addEventListener('keydown', (event) => {
    const isOurs = Object.hasOwn(keys, event.key) && !event.ctrlKey && !event.metaKey && !event.altKey;
    if (!isOurs || !view.isActive()) return;
    event.preventDefault();
    keys[event.key]();
  });
  target.addEventListener('wheel', (event) => {
    if (!view.isActive() || !view.canZoom() || event.ctrlKey) return; // Ctrl and the wheel zoom the page
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : 33);
    view.zoom(Math.exp(Math.max(-300, Math.min(300, pixels)) * zoomPerPixel));
  }, { passive: false });
  listenToPointers(target, view, zoom);
}

function listenToPointers(target, view, zoom) {
  const pan = (right, up) => view.canPan() && view.pan(right, up);
  target.addEventListener('contextmenu', (event) => view.isActive() && view.canPan() && event.preventDefault()); // its button pans
  const points = new Map(); // of the pointers that are down: where each was last
  const middle = () => {
    const [a, b] = [...points.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, spread: Math.hypot(a.x - b.x, a.y - b.y) };
  };
  target.addEventListener('pointerdown', (event) => {
    if (!view.isActive() || (event.button !== 0 && event.button !== 2)) return;
    target.setPointerCapture(event.pointerId); // a drag may leave the canvas
    points.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  target.addEventListener('pointermove', (event) => {
    const last = points.get(event.pointerId);
    if (last === undefined || !view.isActive()) return;
    const now = { x: event.clientX, y: event.clientY };
    const height = target.clientHeight || 1;
    if (points.size === 2) {
      const before = middle();
      points.set(event.pointerId, now);
      const after = middle();
      if (before.spread > 0 && after.spread > 0) zoom(before.spread / after.spread);
      pan((before.x - after.x) / height, (after.y - before.y) / height);
      return;
    }
    points.set(event.pointerId, now);
    if (points.size > 2) return;
    const right = (now.x - last.x) / height, down = (now.y - last.y) / height;
    if (event.shiftKey || event.buttons === 2) pan(-right, down);
    else view.turn(-right * Math.PI, down * Math.PI); // the height is half a turn, whatever the size
  });
  for (const end of ['pointerup', 'pointercancel', 'lostpointercapture']) {
    target.addEventListener(end, (event) => points.delete(event.pointerId));
  }
}
