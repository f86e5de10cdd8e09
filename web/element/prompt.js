// A hand that shows that the view can be turned, and turns it a little. Loaded where interaction-prompt asks for it.
const css = `
.prompt { position: absolute; left: 50%; top: 60%; width: 48px; height: 48px; margin: -24px; pointer-events: none; filter: drop-shadow(0 1px 3px rgba(0, 0, 0, 0.6)); }
`;
const hand = 'M9 20 4.5 14.5a1.6 1.6 0 0 1 2.4-2L9 14.4V4.6a1.5 1.5 0 0 1 3 0V10l5.5 1.2c1.5.4 2.2 1.3 2 2.8L18.500 20z';
const period = 5000; // milliseconds
const sway = Math.PI / 16; // to each side

/** No HTML is read, for pages with Trusted Types. */
function drawHand() {
  const [svg, path] = ['svg', 'path'].map((name) => document.createElementNS('http://www.w3.org/2000/svg', name));
  const attributes = { viewBox: '0 0 24 24', width: 48, height: 48, fill: '#fff', stroke: '#333', 'stroke-linejoin': 'round', 'aria-hidden': true };
  for (const [name, value] of Object.entries(attributes)) svg.setAttribute(name, value);
  path.setAttribute('d', hand);
  svg.append(path);
  return svg;
}

export class Prompt {
  #layer = document.createElement('div');
  #frame = 0;

  /**
   * @param {ShadowRoot} root
   * @param {boolean} moves not where the visitor prefers reduced motion
   * @param {(right: number) => void} turn the view, radians
   */
  constructor(root, moves, turn) {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(css);
    root.adoptedStyleSheets.push(sheet);
    this.#layer.className = 'prompt';
    const slot = document.createElement('slot');
    slot.name = 'interaction-prompt';
    slot.append(drawHand());
    this.#layer.append(slot);
    root.append(this.#layer);
    if (!moves) return;
    let start = null, before = 0;
    const step = (time) => {
      start ??= time;
      const now = sway * Math.sin((2 * Math.PI * (time - start)) / period);
      turn(now - before);
      this.#layer.style.transform = `translateX(${(-60 * now) / sway}px)`;
      before = now;
      this.#frame = requestAnimationFrame(step);
    };
    this.#frame = requestAnimationFrame(step);
  }

  stop() {
    cancelAnimationFrame(this.#frame);
    this.#layer.remove();
  }
}
