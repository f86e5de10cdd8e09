// The table and the sheet of glass.mjs.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

export const median = (values) => {
  const sorted = [...values].sort((a, b) => a - b);
  const middle = Math.floor(sorted.length / 2);
  return sorted.length % 2 === 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
};

const titles = {
  empty: 'nothing (a cleared canvas)',
  physical: 'three.js MeshPhysicalMaterial',
  'physical-double': 'three.js MeshPhysicalMaterial, both sides',
  transmission: 'drei MeshTransmissionMaterial, no dispersion, no blur',
  'transmission-default': 'drei MeshTransmissionMaterial, its defaults',
  'transmission-backside': 'drei MeshTransmissionMaterial, no dispersion, no blur, backside',
  refraction: 'drei MeshRefractionMaterial, 4 bounces',
};
/** A technique without Fresnel reflection is named with -plain. */
export const isPlain = (name) => name.endsWith('-plain');
export const techniqueOf = (name) => name.replace(/-plain$/, '');
const vitrineTitle = (name) => `Vitrine ${techniqueOf(name)}, ${isPlain(name) ? 'no reflection' : 'its defaults'}`;
export const titleOf = ({ kind, name }) => (kind === 'vitrine' ? vitrineTitle(name) : titles[name]);

const angle = (value) => (value === null ? 'no such pixel' : `${value.toFixed(3)}°`);
const percent = (share) => `${(100 * share).toFixed(1)} %`;

const numbers = (vector) => vector.map((value) => Number(value.toPrecision(4))).join(', ');

/** The report as Markdown. */
export function markdown(report) {
  const { contestants, camera, versions } = report;
  const rows = contestants.map((entry) => {
    const plain = entry.plainMilliseconds === undefined ? '–' : `${entry.plainMilliseconds.toFixed(1)} ms`;
    const time = `${entry.milliseconds.toFixed(1)} ms | ${plain} | ${entry.fastest.toFixed(1)}–${entry.slowest.toFixed(1)} ms | ${entry.ratio === null ? '–' : entry.ratio.toFixed(2)}`;
    const quality = entry.kind === 'empty' ? '– | – | – | – | – | –'
      : [percent(entry.within1), percent(entry.within5), `${entry.medianAngle.toFixed(2)}°`, entry.flip.toFixed(3), entry.flipReflecting?.toFixed(3) ?? '–',
        entry.thickness === null ? '–' : entry.thickness.toFixed(3)].join(' | ');
    return `| ${titleOf(entry)} | ${time} | ${quality} |`;
  });
  const calibrations = contestants.filter(({ kind }) => kind === 'peer').map(({ name, calibration }) => `${name} ${angle(calibration.median)} (at most ${angle(calibration.largest)})`);
  const natives = contestants.filter(({ kind }) => kind === 'vitrine').map(({ name, asNative, comparedPixels }) => `${name} ${percent(asNative)} of ${comparedPixels}`);
  const packages = Object.entries(versions).map(([name, version]) => `${name} ${version}`).join(', ');
  return `${report.date}; ${report.renderer}; Chromium ${report.browser}; ${report.processors} × ${report.processor || 'processor'}${report.threads === null ? '' : `, LP_NUM_THREADS ${report.threads}`}

\`${report.model}\` (${report.triangles} triangles, normals ${report.normals}), \`${report.environment}\`, ${report.size} × ${report.size} pixels, index ${report.ior},
eye ${numbers(camera.eye)}, target ${numbers(camera.target)}, ${camera.fov}°; ${report.rounds} rounds in turns, medians.
${packages && `Packages: ${packages}.
`}
| glass | a frame | not reflecting | fastest–slowest | ratio | within 1° | within 5° | median | FLIP | FLIP, reflecting | thickness |
|---|---|---|---|---|---|---|---|---|---|---|
${rows.join('\n')}
${report.absent.map((entry) => `\nLeft out: ${titleOf(entry)} (${entry.problem}).\n`).join('')}
A frame: each as it is by default; "not reflecting": those that reflect, without that. Ratio: to MeshPhysicalMaterial by default. Directions: of the ${report.judgedPixels} pixels whose true path has 1 to 4 events. FLIP: mean over the picture
(${percent(report.background)} of it background), all without reflection, against the ray tracer without; "reflecting": each as it is by default, against the ray tracer
with Fresnel reflection, ${report.samples} paths a pixel. Thickness: ${report.thicknessGiven ? 'as given' : 'what suited the material best of five'}; the mean chord is ${report.meanChord.toFixed(3)}.

Decoded background pixels are off by, median: ${calibrations.join(', ') || '–'}. Vitrine's directions are the native program's; in the browser
they are the same within 2° (8 bits a channel), of those pixels where the truth changes by at most 15° to each neighbour, in: ${natives.join(', ') || '–'}.
`;
}

/** The text with the report between its marks `<!-- glass NAME -->` and `<!-- end -->`, NAME the model's. */
export function insert(text, report) {
  const [start, end] = [`<!-- glass ${report.model} -->\n`, '<!-- end -->'];
  const from = text.indexOf(start), to = text.indexOf(end, from);
  if (from < 0 || to < 0) throw new Error(`no marks '${start.trim()}' and '${end}' in the file of --into`);
  return `${text.slice(0, from + start.length)}\n${markdown(report)}\n${text.slice(to)}`;
}

/** All pictures side by side, named. */
export async function sheet(browser, report, out) {
  const picture = (name) => `data:image/png;base64,${readFileSync(join(out, `${name}.png`)).toString('base64')}`;
  const figures = [
    { name: 'reference', title: 'ray-traced reference', text: '' },
    ...report.contestants.filter(({ kind }) => kind !== 'empty').map((entry) => ({
      name: entry.name, title: titleOf(entry), text: `${entry.milliseconds.toFixed(0)} ms, ${percent(entry.within1)} within 1°, FLIP ${entry.flip.toFixed(3)}`,
    })),
  ];
  const page = await browser.newPage({ viewport: { width: 4 * 400 + 5 * 12, height: 400 } });
  await page.setContent(`<!doctype html><style>
    body { margin: 12px; font: 15px/1.35 sans-serif; display: grid; grid-template-columns: repeat(4, 400px); gap: 12px; }
    figure { margin: 0; } img { width: 400px; display: block; } figcaption { padding-top: 4px; }
    </style>${figures.map(({ name, title, text }) => `<figure><img src="${picture(name)}"><figcaption>${title}<br>${text}</figcaption></figure>`).join('')}`);
  await page.screenshot({ path: join(out, 'sheet.png'), fullPage: true });
  await page.close();
}
