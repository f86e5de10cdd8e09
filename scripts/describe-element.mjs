// What the element is, told three ways from one source (web/element/attributes.js and the lists below): types
// and manifest for the npm package, and docs/attributes.md.
//   node scripts/describe-element.mjs           writes docs/attributes.md
//   node scripts/describe-element.mjs --check   fails where it is out of date
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = resolve(dirname(fileURLToPath(import.meta.url)), '..');

const events = [
  { name: 'load', detail: '{ url: string }', description: 'The model of the present src is in the picture.' },
  { name: 'progress', detail: '{ totalProgress: number }', description: 'Share of the bytes that have arrived, 0 to 1.' },
  {
    name: 'error',
    detail: "{ type: 'loadfailure' | 'webglcontextlost' | 'unsupported' | 'invalid'; sourceError: Error }",
    description: 'Something failed; the last good picture stays.',
  },
  {
    name: 'warning',
    detail: '{ sentences: string[] }',
    description: 'Something of the model’s files is left out or changed, as ignored extensions; the property `warnings` keeps it.',
  },
  { name: 'play', detail: 'null', description: 'An animation begins to play.' },
  { name: 'pause', detail: 'null', description: 'It stands still.' },
  { name: 'loop', detail: 'null', description: 'It begins anew.' },
  { name: 'frame', detail: '{ milliseconds: number }', description: 'A frame is on the screen, and how long it took.' },
  { name: 'camera-change', detail: "{ source: 'user-interaction' | 'none' }", description: 'The view has changed.' },
  {
    name: 'render-scale',
    detail:
      '{ reportedDpr: number; renderedDpr: number; minimumDpr: number; pixelWidth: number; pixelHeight: number; preset: string; layers: number; steps: number; maxEvents: number; branches: number; wavelengths: number; reason: string }',
    description: 'The quality in force has changed; what the preset decides as it decided.',
  },
];

const properties = [
  { name: 'loaded', type: 'boolean', description: 'True while a model is shown.' },
  { name: 'warnings', type: 'string[]', description: 'What of the model’s files is left out or changed, sentences; `VitrineViewer.statistics()` has those of all elements.' },
  { name: 'modelIsVisible', type: 'boolean', description: 'The poster is gone and the model can be seen.' },
  {
    name: 'materials',
    type: '{ readonly opaque: boolean; ior: number; tint: number[]; absorption: number[]; absorptionDistance: number; roughness: number; dispersion: number }[]',
    description: 'Of what is shown, in the order of the files; each property can be set, as the keys of `objects` have it, and stays until there is another model.',
  },
  { name: 'availableVariants', type: 'string[]', description: 'Names of the variants of materials that the files shown have, for variant-name.' },
  { name: 'availableAnimations', type: 'string[]', description: 'Names of the animations that the files shown have, for animation-name.' },
  { name: 'duration', type: 'number', description: 'Seconds of the animation; 0 without any.' },
  { name: 'paused', type: 'boolean', description: 'True unless an animation plays.' },
  { name: 'currentTime', type: 'number', writable: true, description: 'Of the animation, seconds; setting it shows that time.' },
];

const methods = [
  { signature: 'toBlob(options?: { mimeType?: string; qualityArgument?: number }): Promise<Blob>', description: 'The picture at full quality.' },
  { signature: 'toDataURL(type?: string, qualityArgument?: number): string', description: 'The same as a data URL.' },
  { signature: 'dismissPoster(): void', description: 'Shows the model where reveal is manual.' },
  {
    signature: 'getCameraOrbit(): { theta: number; phi: number; radius: number }',
    description: 'The view as camera-orbit has it: radians, and the model’s unit.',
  },
  { signature: 'getCameraTarget(): { x: number; y: number; z: number }', description: 'The point looked at, world.' },
  { signature: 'getFieldOfView(): number', description: 'Vertical, degrees, as it is now.' },
  { signature: 'jumpCameraToGoal(): void', description: 'The view is where attributes and visitor want it, without the way there.' },
  { signature: 'getDimensions(): { x: number; y: number; z: number } | null', description: 'Sides of the box around all that is shown; null where nothing is.' },
  { signature: 'getBoundingBoxCenter(): { x: number; y: number; z: number } | null', description: 'Its middle, world.' },
  { signature: 'project(points: number[][]): number[][]', description: 'World points in client coordinates, as they are seen now.' },
  {
    signature:
      "pathAt(clientX: number, clientY: number): { events: { kind: 'refraction' | 'reflection'; in: number; out: number }[]; points: number[][]; screen: number[][]; exited: boolean } | null",
    description: 'The exact path of light through a point of the page; null where no glass is. Angles to the normal in degrees.',
  },
  { signature: 'play(): void', description: 'Plays the animation round and round, while the element is in view.' },
  { signature: 'pause(): void', description: 'Stops it where it is.' },
  { signature: 'resetView(): void', description: 'Back to the view that the attributes ask for.' },
];

const slots = [
  { name: 'poster', description: 'Stands until the first frame.' },
  { name: 'progress-bar', description: 'In place of the built-in progress bar.' },
  {
    name: 'hotspot-…',
    description:
      'Stands at the point of the model that data-position says. Where data-normal (0 1 0) faces away it is pale; else it has the attribute data-visible, or data- and what data-visibility-attribute says.',
  },
  { name: 'interaction-prompt', description: 'In place of the hand.' },
];
const parts = ['canvas', 'poster', 'progress-bar', 'message'];
const cssProperties = [
  { name: '--progress-bar-color', description: 'Colour of the progress bar.' },
  { name: '--poster-color', description: 'Behind the poster.' },
  { name: '--min-hotspot-opacity', description: 'Of a hotspot whose surface faces away; 0.25.' },
  { name: '--max-hotspot-opacity', description: 'Of the others; 1.' },
];

/** Of properties that take more than their attributes. */
const widerTypes = { backdrop: 'string | HTMLImageElement | HTMLVideoElement | HTMLCanvasElement | OffscreenCanvas | ImageBitmap' };

function typeOf(row) {
  const type = row.type === 'enum' ? row.values.map((value) => `'${value}'`).join(' | ') : row.type;
  return type + (row.default === null ? ' | null' : '');
}

function defaultOf(row) {
  if (row.default === null) return row.defaultText;
  return row.type === 'boolean' ? 'absent' : row.default === '' ? '' : `\`${row.default}\``;
}

function rangeOf(row) {
  if (row.type === 'number') return `${row.min} to ${row.max}`;
  return row.type === 'enum' ? row.values.map((value) => `\`${value}\``).join(' ') : '';
}

function makeTypes(attributes) {
  const listeners = events.map(({ name, detail }) => `  '${name}': CustomEvent<${detail}>;`);
  return `// Made by scripts/describe-element.mjs.
export interface VitrineViewerEventMap {
${listeners.join('\n')}
}

/** A mesh in glass. */
export declare class VitrineViewer extends HTMLElement {
  /** Where vitrine-core.wasm and vitrine-shaders.txt are served from, if not beside vitrine-core.js. Set before the first element. */
  static locateFile: ((name: string) => string) | null;
  /** The WebAssembly itself, where nothing is to be fetched. Set before the first element. */
  static wasmBinary: ArrayBuffer | Uint8Array | null;
  /** What vitrine-shaders.txt has in it, where that is not to be fetched either. Set before the first element. */
  static laterShaders: string | null;
  /** What all elements of the page hold, what of the files they show is left out or changed, and of those that move and are drawn in less than full quality the detail of render-scale. */
  static statistics: () => Promise<{ contexts: number; viewers: number; gpuBytes: number; heapBytes: number; warnings: string[]; lessened: VitrineViewerEventMap['render-scale']['detail'][] }>;
${attributes.map((row) => `  /** ${row.description} Default: ${defaultOf(row) || 'empty'}. */\n  ${row.property}: ${widerTypes[row.property] ?? typeOf(row)};`).join('\n')}
${properties.map(({ name, type, writable, description }) => `  /** ${description} */\n  ${writable ? '' : 'readonly '}${name}: ${type};`).join('\n')}
${methods.map(({ signature, description }) => `  /** ${description} */\n  ${signature};`).join('\n')}
  addEventListener<K extends keyof VitrineViewerEventMap>(type: K, listener: (event: VitrineViewerEventMap[K]) => void, options?: boolean | AddEventListenerOptions): void;
  addEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | AddEventListenerOptions): void;
}

/** What can be written in markup. */
export interface VitrineViewerAttributes {
${attributes.map((row) => `  '${row.attribute}'?: ${row.type === 'boolean' ? "boolean | ''" : row.type === 'number' ? 'number | string' : typeOf({ ...row, default: '' })};`).join('\n')}
}

declare global {
  interface HTMLElementTagNameMap {
    'vitrine-viewer': VitrineViewer;
  }
}
`;
}

/** Of frameworks' markup, by their names: each a module of its own, which needs the framework's types. */
const frameworkTypes = {
  react: `import type { DetailedHTMLProps, HTMLAttributes } from 'react';
import type { VitrineViewer, VitrineViewerAttributes } from './index.js';

declare module 'react' {
  namespace JSX {
    interface IntrinsicElements {
      'vitrine-viewer': DetailedHTMLProps<HTMLAttributes<VitrineViewer>, VitrineViewer> & VitrineViewerAttributes;
    }
  }
}
`,
  vue: `import type { DefineComponent } from 'vue';
import type { VitrineViewerAttributes } from './index.js';

declare module 'vue' {
  interface GlobalComponents {
    'vitrine-viewer': DefineComponent<VitrineViewerAttributes>;
  }
}
`,
  svelte: `import type { HTMLAttributes } from 'svelte/elements';
import type { VitrineViewer, VitrineViewerAttributes } from './index.js';

declare module 'svelte/elements' {
  interface SvelteHTMLElements {
    'vitrine-viewer': HTMLAttributes<VitrineViewer> & VitrineViewerAttributes;
  }
}
`,
};

function makeManifest(attributes) {
  const path = 'element/vitrine-viewer.js';
  return {
    schemaVersion: '1.0.0',
    modules: [
      {
        kind: 'javascript-module',
        path,
        declarations: [
          {
            kind: 'class',
            name: 'VitrineViewer',
            customElement: true,
            tagName: 'vitrine-viewer',
            description: 'A mesh in glass.',
            attributes: attributes.map((row) => ({
              name: row.attribute,
              fieldName: row.property,
              type: { text: typeOf(row) },
              default: row.default === null ? row.defaultText : String(row.default),
              description: row.description,
            })),
            members: methods.map(({ signature, description }) => ({ kind: 'method', name: signature.split('(')[0], description })),
            events: events.map(({ name, description, detail }) => ({ name, description, type: { text: `CustomEvent<${detail}>` } })),
            slots,
            cssParts: parts.map((name) => ({ name })),
            cssProperties,
          },
        ],
        exports: [{ kind: 'custom-element-definition', name: 'vitrine-viewer', declaration: { name: 'VitrineViewer', module: path } }],
      },
    ],
  };
}

function makePage(attributes) {
  const row = (cells) => `| ${cells.map((cell) => String(cell).replaceAll('|', '\\|')).join(' | ')} |`;
  return `# \`<vitrine-viewer>\`

Made by \`scripts/describe-element.mjs\`; do not edit. [web.md](web.md) shows the element in use.

## Attributes

Each is a property too, in camelCase.

${row(['attribute', 'default', 'range', 'meaning'])}
|---|---|---|---|
${attributes.map((each) => row([`\`${each.attribute}\``, defaultOf(each), rangeOf(each), each.description])).join('\n')}

## Events

${row(['event', 'detail', 'when'])}
|---|---|---|
${events.map(({ name, detail, description }) => row([`\`${name}\``, `\`${detail}\``, description])).join('\n')}

## Properties without an attribute

${properties.map(({ name, type, description }) => `- \`${name}: ${type}\`: ${description}`).join('\n')}

## Methods

${methods.map(({ signature, description }) => `- \`${signature}\`: ${description}`).join('\n')}

## Slots, parts, CSS variables

${slots.map(({ name, description }) => `- slot \`${name}\`: ${description}`).join('\n')}
- parts: ${parts.map((name) => `\`${name}\``).join(', ')}
${cssProperties.map(({ name, description }) => `- \`${name}\`: ${description}`).join('\n')}
`;
}

/** The element's table, types, manifest and page; the table lies at `path`. */
export async function describeElement(path) {
  // As a data URL it is a module for Node 18 too, which otherwise asks for a package.json beside it.
  const { attributes } = await import(`data:text/javascript;base64,${readFileSync(path).toString('base64')}`);
  return { attributes, types: makeTypes(attributes), frameworkTypes, manifest: makeManifest(attributes), page: makePage(attributes) };
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const target = join(root, 'docs/attributes.md');
  const { page } = await describeElement(join(root, 'web/element/attributes.js'));
  if (process.argv[2] === '--check') {
    if (readFileSync(target, 'utf8') !== page) {
      console.error('docs/attributes.md is out of date; run node scripts/describe-element.mjs');
      process.exit(1);
    }
  } else {
    writeFileSync(target, page);
  }
}
