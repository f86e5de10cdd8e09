// Children with slot="hotspot-…" stand at points of the model. Loaded once an element has one.
const css = `
.hotspots { position: absolute; inset: 0; overflow: hidden; pointer-events: none; }
.hotspots div { position: absolute; left: 0; top: 0; pointer-events: auto; opacity: var(--max-hotspot-opacity, 1); transition: opacity 0.3s; }
.hotspots div.away { opacity: var(--min-hotspot-opacity, 0.25); pointer-events: none; }
`;
const lengths = { '': 1, m: 1, cm: 0.01, mm: 0.001 };
let sheet;

/** "x y z", in m, cm or mm. @returns {number[]|null} */
function readVector(text) {
  const parts = (text ?? '').trim().split(/\s+/).map((word) => /^([-+]?[\d.]+(?:e[-+]?\d+)?)(m|cm|mm)?$/i.exec(word));
  return parts.length === 3 && parts.every(Boolean) ? parts.map(([, digits, unit = '']) => Number(digits) * lengths[unit]) : null;
}

export class Hotspots {
  #host;
  #layer = document.createElement('div');

  /** @param {HTMLElement} host */
  constructor(host) {
    this.#host = host;
    if (sheet === undefined) {
      sheet = new CSSStyleSheet();
      sheet.replaceSync(css);
    }
    host.shadowRoot.adoptedStyleSheets.push(sheet);
    this.#layer.className = 'hotspots';
    host.shadowRoot.append(this.#layer);
  }

  /**
   * Puts them where their points are seen: data-position. One is away where data-normal (0 1 0) shows that its surface faces away; else
   * it has the attribute data-visible, or data- and what data-visibility-attribute says.
   * @param {import('./view.js').View} view
   * @returns {string[]} sentences
   */
  place(view) {
    const { clientWidth, clientHeight } = this.#host;
    const spots = [...this.#host.children].filter(({ slot }) => slot.startsWith('hotspot'));
    const names = new Set(spots.map(({ slot }) => slot));
    for (const box of [...this.#layer.children]) if (!names.has(box.firstChild.name)) box.remove();
    const problems = [];
    for (const spot of spots) {
      const position = readVector(spot.dataset.position);
      const normal = readVector(spot.dataset.normal ?? '0 1 0');
      const { visibilityAttribute = 'visible', position: text, normal: normalText } = spot.dataset;
      if (position === null) problems.push(`${spot.slot}: data-position is '${text ?? ''}'; it must be like '0m 0.5m 0m': x, y and z in m, cm or mm`);
      if (normal === null) problems.push(`${spot.slot}: data-normal is '${normalText}'; it must be three numbers`);
      const box = this.#boxOf(spot.slot);
      box.hidden = position === null || normal === null;
      if (box.hidden) continue;
      const [x, y] = view.project(position, clientWidth / clientHeight);
      const faces = view.eye.reduce((sum, value, i) => sum + (value - position[i]) * normal[i], 0) > 0;
      box.classList.toggle('away', !faces);
      box.style.transform = `translate(${(0.5 + 0.5 * x) * clientWidth}px, ${(0.5 - 0.5 * y) * clientHeight}px) translate(-50%, -50%)`;
      spot.toggleAttribute(`data-${visibilityAttribute}`, faces);
    }
    return problems;
  }

  #boxOf(name) {
    const known = [...this.#layer.children].find(({ firstChild }) => firstChild.name === name);
    if (known) return known;
    const box = document.createElement('div');
    box.append(Object.assign(document.createElement('slot'), { name }));
    this.#layer.append(box);
    return box;
  }
}
