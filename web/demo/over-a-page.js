// The pictures of the page, which are drawn here, and the lens that follows the pointer.
import '../element/vitrine-viewer.js';

/** Numbers that look like chance, the same each time. */
function makeChance(seed) {
  return () => {
    seed = (seed * 16807) % 2147483647;
    return seed / 2147483647;
  };
}

function fillWith(pen, gradient, stops, ...rectangle) {
  for (const [at, color] of stops) gradient.addColorStop(at, color);
  pen.fillStyle = gradient;
  pen.fillRect(...rectangle);
}

/** A line from left to right through points of so many waves. */
function ridge(pen, width, y, height, chance) {
  const waves = Array.from({ length: 6 }, (_, i) => [(1.5 + 2.4 * i) * (0.7 + 0.6 * chance()), 7 * chance(), height / (1 + 1.1 * i)]);
  for (let x = 0; x <= width; x += 3) pen.lineTo(x, y + waves.reduce((sum, [rate, phase, size]) => sum + size * Math.sin((rate * 2 * x) / width + phase), 0));
}

function drawHero(canvas) {
  const pen = canvas.getContext('2d'), { width, height } = canvas, chance = makeChance(23);
  const shore = 0.74 * height, sun = [0.66 * width, 0.44 * height];
  fillWith(pen, pen.createLinearGradient(0, 0, 0, shore), [[0, '#1d2b64'], [0.35, '#6a4c93'], [0.62, '#f0785a'], [0.82, '#ffc27a'], [1, '#ffe3ae']], 0, 0, width, shore);
  fillWith(pen, pen.createRadialGradient(...sun, 0, ...sun, 0.5 * height), [[0, 'rgb(255 244 210 / 0.95)'], [0.2, 'rgb(255 226 160 / 0.55)'], [1, 'rgb(255 200 130 / 0)']], 0, 0, width, shore);
  pen.fillStyle = '#fff8e2';
  pen.beginPath();
  pen.arc(...sun, 0.085 * height, 0, 7);
  pen.fill();
  for (let i = 0; i < 5; ++i) {
    pen.fillStyle = `hsl(${262 - 9 * i} ${28 + 4 * i}% ${58 - 11 * i}%)`;
    pen.beginPath();
    pen.moveTo(0, shore + 1);
    ridge(pen, width, (0.56 + 0.045 * i) * height, (0.062 - 0.006 * i) * height, chance);
    pen.lineTo(width, shore + 1);
    pen.fill();
  }
  pen.save(); // the lake mirrors them
  pen.translate(0, 2 * shore);
  pen.scale(1, -1);
  pen.drawImage(canvas, 0, 2 * shore - height, width, height - shore, 0, 2 * shore - height, width, height - shore);
  pen.restore();
  fillWith(pen, pen.createLinearGradient(0, shore, 0, height), [[0, 'rgb(40 36 90 / 0.35)'], [1, 'rgb(16 18 52 / 0.85)']], 0, shore, width, height - shore);
  for (let i = 0; i < 260; ++i) {
    const y = shore + (height - shore) * chance() ** 1.4, long = (20 + 120 * chance()) * (0.4 + (y - shore) / (height - shore));
    const x = sun[0] + (chance() + chance() - 1) * width * 0.5, near = Math.max(0, 1 - Math.abs(x - sun[0]) / (0.16 * width));
    pen.fillStyle = `rgb(255 ${190 + 50 * near} ${150 + 60 * near} / ${0.05 + 0.5 * near})`;
    pen.fillRect(x - long / 2, y, long, 2 + 2 * chance());
  }
}

function strokeAll(pen, lines, ...passes) {
  for (const [color, extra] of passes) {
    pen.strokeStyle = color;
    for (const [line, ...points] of lines) {
      pen.lineWidth = line + extra;
      pen.beginPath();
      pen.moveTo(...points[0]);
      if (points.length === 4) pen.bezierCurveTo(...points.slice(1).flat());
      else for (const point of points.slice(1)) pen.lineTo(...point);
      pen.stroke();
    }
  }
}

function drawMap(canvas) {
  const pen = canvas.getContext('2d'), { width, height } = canvas, chance = makeChance(11);
  pen.lineCap = pen.lineJoin = 'round';
  pen.fillStyle = '#f1eee6';
  pen.fillRect(0, 0, width, height);
  pen.save(); // blocks of houses, a little turned
  pen.translate(width / 2, height / 2);
  pen.rotate(-0.12);
  for (let row = -9; row < 9; ++row) {
    for (let column = -13; column < 13; ++column) {
      const kind = chance(), x = 84 * column, y = 66 * row;
      pen.fillStyle = kind < 0.09 ? '#c6e2b4' : '#e6e1d5';
      pen.beginPath();
      pen.roundRect(x + 5, y + 5, 74, 56, 6);
      pen.fill();
      if (kind < 0.09) continue;
      pen.fillStyle = kind < 0.2 ? '#d8c3b0' : '#d6cfbf';
      for (let house = 0; house < 6; ++house) {
        if (chance() < 0.85) pen.fillRect(x + 10 + 23 * (house % 3), y + 10 + 26 * (house > 2), 12 + 7 * chance(), 11 + 9 * chance());
      }
    }
  }
  pen.restore();
  pen.fillStyle = '#bfe0ae';
  pen.beginPath();
  pen.ellipse(1260, 250, 170, 115, -0.2, 0, 7);
  pen.fill();
  pen.fillStyle = '#9fd0ec';
  pen.beginPath();
  pen.moveTo(width, 560);
  pen.bezierCurveTo(1560, 600, 1560, 760, 1350, height);
  pen.lineTo(width, height);
  pen.fill();
  strokeAll(pen, [[74, [-60, 640], [420, 340], [820, 960], [1900, 700]]], ['#f1eee6', 26], ['#9fd0ec', 0]);
  const roads = [[20, [-20, 160], [900, 330], [1820, 430]], [20, [520, -20], [610, 460], [560, 920]], [20, [1130, -20], [1040, 520], [1110, 920]]];
  const streets = [[11, [-20, 420], [520, 300], [1040, 520], [1820, 250]], [11, [180, -20], [260, 460], [140, 920]], [11, [800, -20], [840, 400], [800, 920]], [11, [1480, -20], [1420, 560]]];
  strokeAll(pen, streets, ['#cfc8b8', 4], ['#fffdf8', 0]);
  strokeAll(pen, roads, ['#d99a3d', 4], ['#ffd88a', 0]);
  strokeAll(pen, [[9, [250, 760], [252, 440], [585, 290], [610, 420], [842, 420], [1038, 520], [1260, 440]]], ['#fff', 5], ['#2f6fe4', 0]);
  pen.font = 'italic 600 22px Georgia, serif';
  pen.fillStyle = '#2e6f96';
  for (const [name, x, y, turn] of [['River Lens', 360, 566, 0.16], ['Bay of Glass', 1580, 800, 0]]) {
    pen.save();
    pen.translate(x, y);
    pen.rotate(turn);
    pen.fillText(name, 0, 0);
    pen.restore();
  }
  pen.lineWidth = 5;
  pen.strokeStyle = '#fffdf8';
  for (const [name, x, y, font, color] of [['Old Town', 640, 190, '700 30px', '#33404d'], ['Harbour', 1370, 640, '700 30px', '#33404d'], ['Glassworks', 880, 640, '700 30px', '#33404d'], ['Park of Prisms', 1175, 258, '600 22px', '#2c6b35'], ['Mirror Lane', 330, 240, '600 17px', '#5a6673'],
    ['Facet Street', 880, 300, '600 17px', '#5a6673'], ['Bevel Square', 620, 480, '600 19px', '#5a6673'], ['Caustic Road', 1180, 640, '600 17px', '#5a6673'], ['Snell Steps', 60, 330, '600 17px', '#5a6673'], ['Abbe Alley', 640, 800, '600 17px', '#5a6673']]) {
    pen.font = `${font} system-ui, sans-serif`;
    pen.fillStyle = color;
    pen.strokeText(name, x, y);
    pen.fillText(name, x, y);
  }
  pen.fillStyle = '#d8344b'; // where the route ends
  pen.beginPath();
  pen.arc(1260, 412, 19, Math.PI, 0);
  pen.quadraticCurveTo(1276, 430, 1260, 446);
  pen.quadraticCurveTo(1244, 430, 1241, 412);
  pen.fill();
  pen.fillStyle = '#fff';
  pen.beginPath();
  pen.arc(1260, 412, 7, 0, 7);
  pen.fill();
}

function drawPoster(canvas) {
  const pen = canvas.getContext('2d'), { width, height } = canvas;
  fillWith(pen, pen.createLinearGradient(0, 0, width, height), [[0, '#1b1464'], [0.5, '#5b1a8c'], [1, '#0b3d91']], 0, 0, width, height);
  const discs = [[300, 260, 250, '#ff6b6b', '#c81d77'], [760, 640, 300, '#ffd166', '#f3722c'], [1180, 250, 220, '#4cc9f0', '#3a0ca3'], [1520, 640, 290, '#06d6a0', '#118ab2'], [120, 800, 170, '#f15bb5', '#9b5de5'], [1000, 900, 140, '#fee440', '#f15bb5']];
  for (const [x, y, radius, light, dark] of discs) {
    const shade = pen.createLinearGradient(x - radius, y - radius, x + radius, y + radius);
    shade.addColorStop(0, light);
    shade.addColorStop(1, dark);
    pen.fillStyle = shade;
    pen.beginPath();
    pen.arc(x, y, radius, 0, 7);
    pen.fill();
  }
  pen.strokeStyle = 'rgb(255 255 255 / 0.8)';
  pen.lineWidth = 3;
  for (let i = 0; i < 15; ++i) {
    pen.beginPath();
    pen.arc(0.5 * width, 0.5 * height, 90 + 66 * i, 0, 7);
    pen.stroke();
  }
}

/** URL of a .glb of a lens: radius 1, both sides bulge by so much over a round rim of that thickness. */
function makeLens(bulge, rim) {
  const steps = 24, turns = 96;
  const cap = (side) => Array.from({ length: steps + 1 }, (_, i) => [i / steps, side * (rim / 2 + bulge * (1 - (i / steps) ** 2)), (2 * bulge * i) / steps, side]);
  const round = Array.from({ length: 13 }, (_, i) => [Math.sin((i * Math.PI) / 12), Math.cos((i * Math.PI) / 12)]);
  const profile = [...cap(1), ...round.map(([out, along]) => [1 + (rim / 2) * out, (rim / 2) * along, out, along]), ...cap(-1).reverse()]; // radius, height, normal
  const positions = [], normals = [], indices = [];
  for (const [i, [radius, z, out, along]] of profile.entries()) {
    for (let k = 0; k < turns; ++k) {
      const angle = (2 * Math.PI * k) / turns, length = Math.hypot(out, along);
      positions.push(radius * Math.cos(angle), radius * Math.sin(angle), z);
      normals.push((out * Math.cos(angle)) / length, (out * Math.sin(angle)) / length, along / length);
      const next = profile[i + 1], [a, b] = [i * turns + k, i * turns + ((k + 1) % turns)];
      if (!next || Math.hypot(next[0] - radius, next[1] - z) < 1e-9) continue; // an edge: only the normal turns
      if (radius > 0) indices.push(a, a + turns, b);
      if (next[0] > 0) indices.push(b, a + turns, b + turns);
    }
  }
  const data = [new Float32Array(positions), new Float32Array(normals), new Uint32Array(indices)];
  let place = 0;
  const bufferViews = data.map(({ byteLength }) => ({ buffer: 0, byteOffset: (place += byteLength) - byteLength, byteLength }));
  const json = {
    asset: { version: '2.0' }, buffers: [{ byteLength: place }], bufferViews,
    accessors: data.map(({ length }, i) => ({ bufferView: i, componentType: i < 2 ? 5126 : 5125, count: i < 2 ? length / 3 : length, type: i < 2 ? 'VEC3' : 'SCALAR', ...(i === 0 && { min: [-1 - rim / 2, -1 - rim / 2, -bulge - rim / 2], max: [1 + rim / 2, 1 + rim / 2, bulge + rim / 2] }) })),
    meshes: [{ primitives: [{ attributes: { POSITION: 0, NORMAL: 1 }, indices: 2 }] }], nodes: [{ mesh: 0 }], scenes: [{ nodes: [0] }], scene: 0,
  };
  const bytes = new TextEncoder().encode(JSON.stringify(json)), text = new Uint8Array(4 * Math.ceil(bytes.length / 4)).fill(32);
  text.set(bytes);
  const head = (...words) => new Uint32Array(words);
  const parts = [head(0x46546c67, 2, 28 + text.length + place, text.length, 0x4e4f534a), text, head(place, 0x4e4942), ...data];
  return URL.createObjectURL(new Blob(parts, { type: 'model/gltf-binary' }));
}

/** The lens goes where the pointer is: the view looks past it by as much, and the map stays. */
function moveLens(over, lens) {
  const at = { x: 0.41, y: 0.3 }; // of the map's sides
  const place = (x, y) => {
    Object.assign(at, { x: Math.min(0.97, Math.max(0.03, x)), y: Math.min(0.95, Math.max(0.05, y)) });
    const { width, height } = over.getBoundingClientRect(), tall = 2 * 11 * Math.tan(Math.PI / 18); // of camera-orbit and field-of-view
    lens.cameraTarget = `${(((0.5 - at.x) * tall * width) / height).toFixed(4)}m ${((at.y - 0.5) * tall).toFixed(4)}m 0m`;
  };
  const toPointer = ({ clientX, clientY }) => {
    const { left, top, width, height } = over.getBoundingClientRect();
    place((clientX - left) / width, (clientY - top) / height);
  };
  for (const type of ['pointermove', 'pointerdown']) over.addEventListener(type, toPointer);
  over.addEventListener('keydown', (event) => {
    const step = { ArrowLeft: [-0.03, 0], ArrowRight: [0.03, 0], ArrowUp: [0, -0.06], ArrowDown: [0, 0.06] }[event.key];
    if (!step) return;
    event.preventDefault();
    place(at.x + step[0], at.y + step[1]);
  });
  new ResizeObserver(() => place(at.x, at.y)).observe(over);
}

drawHero(document.getElementById('hero'));
drawMap(document.getElementById('map'));
drawPoster(document.getElementById('poster'));
const lens = document.getElementById('lens');
lens.src = makeLens(0.12, 0.08);
moveLens(document.getElementById('under-lens'), lens);
