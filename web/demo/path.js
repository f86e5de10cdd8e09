// The path of light through one pixel, drawn over the picture and told in words, event by event.
const namespace = 'http://www.w3.org/2000/svg';
const clickDistance = 5, clickTime = 500; // pixels and milliseconds: more is a drag

function draw(name, attributes, text) {
  const node = document.createElementNS(namespace, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  return node;
}

export class PathOverlay {
  #parts;
  #path = null;
  #frame = 0;

  /** @param {{svg: SVGElement, list: HTMLElement, hint: HTMLElement, viewer: HTMLElement, stage: HTMLElement}} parts */
  constructor(parts) {
    this.#parts = parts;
    this.words = parts.hint.textContent;
    let down = null;
    parts.viewer.addEventListener('pointerdown', (event) => (down = event.isPrimary && event.button === 0 ? event : null));
    parts.viewer.addEventListener('pointerup', (event) => {
      if (down === null || event.pointerId !== down.pointerId) return;
      const distance = Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY);
      if (distance <= clickDistance && event.timeStamp - down.timeStamp < clickTime) this.trace(event.clientX, event.clientY);
    });
    parts.viewer.addEventListener('keydown', (event) => {
      if (event.key === 'Enter') this.traceCentre();
      if (event.key === 'Escape') this.clear();
    });
  }

  /** The first point of the picture, outwards from its middle, whose path meets the glass. */
  traceCentre() {
    const { left, top, width, height } = this.#parts.viewer.getBoundingClientRect();
    for (let ring = 0; ring < 6; ++ring) {
      const angle = 2.4 * ring, away = 0.05 * height * ring;
      if (this.trace(left + width / 2 + away * Math.cos(angle), top + height / 2 + away * Math.sin(angle))) return;
    }
  }

  /** @returns {boolean} whether there is glass */
  trace(clientX, clientY) {
    const { viewer } = this.#parts;
    if (typeof viewer.pathAt !== 'function') return false;
    this.#path = viewer.pathAt(clientX, clientY);
    if (!this.#path?.events.length) {
      this.clear('No glass there: that ray passes by.');
      return false;
    }
    this.#tell();
    this.#draw(this.#path.screen);
    const behavior = matchMedia('(prefers-reduced-motion: reduce)').matches ? 'instant' : 'smooth';
    this.#parts.list.scrollIntoView({ block: 'nearest', behavior });
    return true;
  }

  /** The points stay where they are in space where the viewer can project them; else the path is out of date. */
  cameraChanged() {
    if (this.#path === null || this.#frame !== 0) return;
    this.#frame = requestAnimationFrame(() => {
      this.#frame = 0;
      if (this.#path === null) return;
      const screen = this.#parts.viewer.project?.(this.#path.points);
      if (screen) this.#draw(screen);
      else this.clear();
    });
  }

  clear(words = this.words) {
    this.#path = null;
    this.#parts.svg.replaceChildren();
    this.#parts.list.replaceChildren();
    this.#parts.hint.textContent = words;
  }

  #tell() {
    const { events } = this.#path;
    const reflections = events.filter(({ kind }) => kind === 'reflection').length;
    const count = (number, word) => `${number} ${word}${number === 1 ? '' : 's'}`;
    this.#parts.hint.textContent = `${count(events.length - reflections, 'refraction')}, ${count(reflections, 'total reflection')}. Angles to the normal, before and after:`;
    this.#parts.list.replaceChildren(...events.map((event) => {
      const item = document.createElement('li');
      item.className = event.kind;
      const [name, angles] = [document.createElement('span'), document.createElement('span')];
      name.textContent = event.kind === 'reflection' ? 'Total reflection' : 'Refraction';
      angles.textContent = `${event.in.toFixed(1)}° → ${event.out.toFixed(1)}°`;
      item.append(name, angles);
      return item;
    }));
  }

  #draw(screen) {
    const { svg } = this.#parts;
    const { events } = this.#path;
    const { left, top } = svg.getBoundingClientRect();
    const points = screen.map(([x, y]) => [x - left, y - top]);
    const nodes = [];
    const line = ([x1, y1], [x2, y2], kind) => {
      for (const layer of ['halo', kind]) nodes.push(draw('line', { x1, y1, x2, y2, class: layer }));
    };
    for (let i = 1; i < points.length; ++i) line(points[i - 1], points[i], i < events.length ? 'inside' : 'exit');
    events.forEach(({ kind }, i) => {
      const [cx, cy] = points[i];
      nodes.push(draw('circle', { cx, cy, r: 9, class: kind }));
      nodes.push(draw('text', { x: cx, y: cy, dy: '0.36em' }, i + 1));
    });
    svg.replaceChildren(...nodes);
  }
}
