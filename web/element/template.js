// The inside of the element. Constructed sheets pass a Content Security Policy of style-src 'self'.
const css = `
:host { display: block; position: relative; contain: strict; width: 300px; height: 150px; }
:host([hidden]) { display: none; }
.view, canvas, .poster, .poster img { position: absolute; inset: 0; width: 100%; height: 100%; }
.view { outline: none; -webkit-user-select: none; user-select: none; }
.view.active { cursor: grab; }
.view.active:active { cursor: grabbing; }
.view:focus-visible { outline: 3px solid Highlight; outline-offset: -3px; box-shadow: inset 0 0 0 4px Canvas; z-index: 1; }
canvas { display: block; pointer-events: none; }
.poster { background: var(--poster-color, transparent); pointer-events: none; }
.poster img { object-fit: contain; }
.poster ::slotted(*) { width: 100%; height: 100%; object-fit: contain; }
.bar { position: absolute; left: 0; right: 0; top: 0; height: 5px; pointer-events: none; }
.bar div { height: 100%; width: 100%; transform-origin: left; transform: scaleX(0); background: var(--progress-bar-color, rgba(64, 128, 224, 0.8)); }
.message { position: absolute; left: 8px; right: 8px; bottom: 8px; margin: 0; padding: 6px 10px; border-radius: 6px;
  max-height: calc(100% - 16px); box-sizing: border-box; overflow: auto;
  font: 13px/1.4 system-ui, sans-serif; color: #fff; background: #7a1622; overflow-wrap: anywhere; }
.unseen { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap; }
[hidden] { display: none !important; }
`;

/** An element with attributes and what is in it; no HTML is read, so that pages with Trusted Types need no policy for it. */
function make(name, attributes = {}, ...inside) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...inside);
  return element;
}

const slider = (name, label, min, max) => make('input', { type: 'range', class: name, 'aria-label': label, min, max, step: 5, tabindex: -1 });

const inside = () => [
  make('div', { class: 'view', role: 'img' }, make('canvas', { part: 'canvas', 'aria-hidden': true })),
  make('div', { class: 'unseen sliders', role: 'group', 'aria-label': 'View', hidden: '' }, slider('turn', 'Turn', -180, 180), slider('tilt', 'Tilt', -85, 85), slider('distance', 'Distance', 25, 400)),
  make('div', { class: 'poster', part: 'poster' }, make('slot', { name: 'poster' }, make('img', { alt: '', hidden: '' }))),
  make('slot', { name: 'progress-bar' }, make('div', { class: 'bar', part: 'progress-bar', role: 'progressbar', 'aria-label': 'Loading', 'aria-valuemin': 0, 'aria-valuemax': 100, hidden: '' }, make('div'))),
  make('p', { class: 'unseen status', role: 'status' }),
  make('p', { class: 'message', part: 'message', role: 'alert', hidden: '' }),
];

let sheet;

/** Fills the element's shadow root; returns its parts by name. */
export function createShadow(host) {
  if (sheet === undefined) {
    sheet = new CSSStyleSheet();
    sheet.replaceSync(css);
  }
  const root = host.attachShadow({ mode: 'open' });
  root.adoptedStyleSheets = [sheet];
  root.append(...inside());
  const names = ['view', 'sliders', 'turn', 'tilt', 'distance', 'poster', 'bar', 'status', 'message'];
  return Object.fromEntries(names.map((name) => [name, root.querySelector(`.${name}`)]));
}
