// The examples of the gallery page: what each shows, and the code that shows it, which is run as it stands.

/** Once a page, before any of them. */
export const setup = '<script type="module" src="vitrine-viewer.bundle.js"></script>';

/** @type {{title: string, text: string, code: string}[]} */
export const examples = [
  {
    title: 'A goblet to turn',
    text: 'A built-in shape; the URL of a .glb takes its place. Drag, wheel, arrow keys.',
    code: `<vitrine-viewer src="goblet" camera-controls
  environment-image="sky" skybox-image
  alt="A goblet of glass before a sky"
  style="width: 100%; height: 320px">
</vitrine-viewer>`,
  },
  {
    title: 'A diamond with fire',
    text: 'Index and dispersion of diamond. It lies on the page: nothing is drawn around it.',
    code: `<vitrine-viewer src="diamond" camera-controls
  ior="2.417" dispersion="0.362"
  camera-orbit="20deg 65deg auto" alt="A diamond"
  style="width: 100%; height: 320px">
</vitrine-viewer>`,
  },
  {
    title: 'Water in a tumbler',
    text: 'Several objects, each of its own index, before a chequered plane.',
    code: `<vitrine-viewer camera-controls
  objects="tumbler; water:ior=1.333;
    plane:checker=24,scale=4,at=0,0,-3"
  camera-orbit="10deg 76deg auto"
  alt="Water in a tumbler"
  style="width: 100%; height: 320px">
</vitrine-viewer>`,
  },
  {
    title: 'Hammered glass',
    text: 'A pane from a pattern of heights. The URL of a picture makes it from that: white is high.',
    code: `<vitrine-viewer relief="hammered" camera-controls
  environment-image="sky" skybox-image
  camera-orbit="-14deg 80deg auto"
  alt="A pane of hammered glass"
  style="width: 100%; height: 320px">
</vitrine-viewer>`,
  },
  {
    title: 'Standing on a table',
    text: 'The glass throws its shadow and its light on a matt ground under a sun.',
    code: `<vitrine-viewer src="goblet" camera-controls
  ground ground-color="0.3,0.2,0.12"
  sun="-0.6,1,-0.3,1,6,5.5,5" exposure="0.6"
  alt="A goblet of glass on a table"
  style="width: 100%; height: 320px">
</vitrine-viewer>`,
  },
  {
    title: 'Frosted glass',
    text: 'Roughness 0.25, before a colour.',
    code: `<vitrine-viewer src="torus" camera-controls
  roughness="0.25" background="#27405c"
  camera-orbit="30deg 50deg auto"
  alt="A ring of frosted glass"
  style="width: 100%; height: 320px">
</vitrine-viewer>`,
  },
  {
    title: 'A bottle with a label',
    text: 'A child with slot="hotspot-…" stands at its point of the glass. The view stays within limits.',
    code: `<vitrine-viewer src="bottle" camera-controls
  min-camera-orbit="auto 45deg auto"
  max-camera-orbit="auto 90deg 200%"
  alt="A bottle of glass"
  style="width: 100%; height: 320px">
  <button slot="hotspot-neck"
    data-position="0 0.9 0.2" data-normal="0 0 1">
    Neck
  </button>
</vitrine-viewer>`,
  },
  {
    title: 'Glass behind glass',
    text: 'Light goes through any number of objects, in any order.',
    code: `<vitrine-viewer camera-controls
  objects="cube; knot:at=0,0,-2" skybox-image
  camera-orbit="12deg 82deg auto"
  alt="A knot of glass behind a cube of glass"
  style="width: 100%; height: 320px">
</vitrine-viewer>`,
  },
  {
    title: 'A knot that turns by itself',
    text: 'Not for visitors who prefer reduced motion, and not out of view.',
    code: `<vitrine-viewer src="knot" auto-rotate
  environment-image="sky" camera-controls
  alt="A knot of glass, turning"
  style="width: 100%; height: 320px">
</vitrine-viewer>`,
  },
];
