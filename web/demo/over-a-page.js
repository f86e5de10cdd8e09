// The pictures of the page, which are drawn here, and the lens that follows the pointer.

/** Numbers that look like chance, the same each time. */
function makeChance(seed) {
  return () => {
    seed = (seed * 16807) % 2147483647;
    return seed / 2147483647;
  };
}

function drawHero(canvas) {
  const context = canvas.getContext('2d'), { width, height } = canvas;
  const sky = context.createLinearGradient(0, 0, 0, height);
  for (const [at, color] of [[0, '#23336b'], [0.45, '#e2795b'], [0.7, '#ffd9a0'], [1, '#ffe9c4']]) sky.addColorStop(at, color);
  context.fillStyle = sky;
  context.fillRect(0, 0, width, height);
  context.fillStyle = '#fff3cf';
  context.beginPath();
  context.arc(0.6 * width, 0.45 * height, 0.13 * height, 0, 7);
  context.fill();
  const chance = makeChance(7);
  for (let ridge = 0; ridge < 5; ++ridge) {
    context.fillStyle = `hsl(${228 - 6 * ridge} ${26 + 6 * ridge}% ${52 - 10 * ridge}%)`;
    const waves = Array.from({ length: 4 }, (_, i) => [(2 + 3 * i) * (1 + chance()), 7 * chance(), (0.05 * height) / (1 + i)]);
    context.beginPath();
    context.moveTo(0, height);
    for (let x = 0; x <= width; x += 4) {
      context.lineTo(x, waves.reduce((y, [rate, phase, size]) => y + size * Math.sin((rate * x) / width + phase), (0.52 + 0.1 * ridge) * height));
    }
    context.lineTo(width, height);
    context.fill();
  }
}

function drawMap(canvas) {
  const context = canvas.getContext('2d'), { width, height } = canvas, chance = makeChance(11);
  context.fillStyle = '#e9e4d6';
  context.fillRect(0, 0, width, height);
  for (let row = 0; row < 15; ++row) {
    for (let column = 0; column < 26; ++column) {
      const kind = chance();
      context.fillStyle = kind < 0.12 ? '#bcd9a6' : kind < 0.5 ? '#dcd3bf' : '#d3c7ae';
      context.fillRect(64 * column + 6, 64 * row + 6, 52, 52);
      context.fillStyle = '#b9a98a';
      for (let house = 0; house < 4 && kind >= 0.12; ++house) context.fillRect(64 * column + 10 + 22 * (house % 2), 64 * row + 10 + 22 * (house >> 1), 10 + 9 * chance(), 10 + 9 * chance());
    }
  }
  const river = (line, color) => {
    context.strokeStyle = color;
    context.lineWidth = line;
    context.beginPath();
    context.moveTo(-40, 0.75 * height);
    context.bezierCurveTo(0.3 * width, 0.2 * height, 0.55 * width, 1.05 * height, width + 40, 0.3 * height);
    context.stroke();
  };
  river(110, '#f4efe2');
  river(92, '#8fc1e0');
  context.strokeStyle = '#f6b95b';
  context.lineWidth = 12;
  for (const [x1, y1, x2, y2] of [[0, 0.2, 1, 0.62], [0.32, 0, 0.4, 1], [0.72, 0, 0.66, 1]]) {
    context.beginPath();
    context.moveTo(x1 * width, y1 * height);
    context.lineTo(x2 * width, y2 * height);
    context.stroke();
  }
  context.fillStyle = '#33414d';
  context.font = '600 24px system-ui, sans-serif';
  for (const [name, x, y] of [['Old Town', 0.14, 0.32], ['Glassworks', 0.46, 0.28], ['Harbour', 0.8, 0.3], ['Mirror Lane', 0.2, 0.88], ['Prism Square', 0.5, 0.86], ['Lens Grinders', 0.78, 0.8]]) {
    context.fillText(name, x * width, y * height);
  }
}

function drawStripes(canvas, seconds) {
  const context = canvas.getContext('2d'), { width, height } = canvas;
  context.fillStyle = '#101b33';
  context.fillRect(0, 0, width, height);
  for (let i = -4; i < 22; ++i) {
    context.fillStyle = `hsl(${(i * 37 + 720) % 360} 78% 60%)`;
    context.save();
    context.translate(80 * i + ((20 * seconds) % 80), 0);
    context.transform(1, 0, 0.35, 1, 0, 0);
    context.fillRect(0, 0, 42, height);
    context.restore();
  }
  context.fillStyle = '#fff';
  context.font = '700 150px system-ui, sans-serif';
  context.fillText('REFRACTION', 0.15 * width, 0.56 * height);
}

/** The lens goes where the pointer is: the camera looks past it by as much, and the map stays. */
function followPointer(viewer) {
  viewer.addEventListener('pointermove', ({ clientX, clientY }) => {
    const { left, top, width, height } = viewer.getBoundingClientRect();
    const tall = 2 * viewer.getCameraOrbit().radius * Math.tan((viewer.getFieldOfView() * Math.PI) / 360);
    const [x, y] = [(clientX - left) / width - 0.5, 0.5 - (clientY - top) / height];
    viewer.cameraTarget = `${(-x * tall * width) / height}m ${-y * tall}m 0m`;
  });
}

drawHero(document.getElementById('hero'));
drawMap(document.getElementById('map'));
drawStripes(document.getElementById('stripes'), 0);
followPointer(document.getElementById('lens'));
