// Keys, fingers and the wheel on the canvas. The mouse's drag reaches the core through GLFW. `call` calls the
// core: see Orbit and Zoom in viewer.c.
const radiansPerPixel = 0.01;
const radiansPerKey = Math.PI / 36;

export function listenToInput(canvas, call, resetView) {
  const keys = {
    ArrowLeft: () => call('Orbit', -radiansPerKey, 0),
    ArrowRight: () => call('Orbit', radiansPerKey, 0),
    ArrowUp: () => call('Orbit', 0, radiansPerKey),
    ArrowDown: () => call('Orbit', 0, -radiansPerKey),
    '+': () => call('Zoom', 0.9),
    '=': () => call('Zoom', 0.9),
    '-': () => call('Zoom', 1 / 0.9),
    Home: resetView,
  };
  canvas.addEventListener('keydown', (event) => {
    if (!Object.hasOwn(keys, event.key) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    keys[event.key]();
  });

  const fingers = new Map(); // where each was last
  const spread = () => {
    const [a, b] = [...fingers.values()];
    return Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
  };
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId); // a drag may leave the canvas
    if (event.pointerType === 'touch') fingers.set(event.pointerId, event);
  });
  canvas.addEventListener('pointermove', (event) => {
    const last = fingers.get(event.pointerId);
    if (last === undefined) return;
    const before = fingers.size === 2 ? spread() : 0;
    fingers.set(event.pointerId, event);
    if (fingers.size === 2) {
      if (before > 0 && spread() > 0) call('Zoom', before / spread());
    } else {
      const across = event.clientX - last.clientX, down = event.clientY - last.clientY;
      call('Orbit', -across * radiansPerPixel, down * radiansPerPixel);
    }
  });
  for (const end of ['pointerup', 'pointercancel']) {
    canvas.addEventListener(end, (event) => fingers.delete(event.pointerId));
  }
}

/** What GLFW's port would do wrong: keep Tab for itself, take a wheel's pixels for notches, half of touch. */
export function listenBeforeGlfw(canvas, call) {
  const early = (type, act) => window.addEventListener(type, act, { capture: true, passive: false });
  early('keydown', (event) => {
    if (event.key === 'Tab' || event.key === 'Backspace') event.stopImmediatePropagation();
  });
  early('wheel', (event) => {
    if (event.target !== canvas) return;
    event.stopImmediatePropagation();
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : 33);
    call('Zoom', Math.exp(Math.max(-300, Math.min(300, pixels)) * 0.001));
  });
  for (const type of ['touchstart', 'touchmove', 'touchend', 'touchcancel']) {
    early(type, (event) => event.target === canvas && event.stopImmediatePropagation());
  }
}
