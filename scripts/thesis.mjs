// The figures of Wang & Chi 2014 made anew, as a page with its pictures. The thesis's models cannot be shipped: for those that
// the folder of --models lacks a built-in shape stands in, or they are left out; the page says so. Needs build/release and the
// packages of tests/.
//   node scripts/thesis.mjs -o FOLDER [--models FOLDER] [--size PIXELS] [--only 4.5,4.6,table]
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { methodFigures } from './thesis/method.mjs';
import { escape, text } from './thesis/parts.mjs';
import { resultFigures, table } from './thesis/results.mjs';
import { fail, ior, only, output, side, studio } from './thesis/subject.mjs';

const figures = [...methodFigures, ...resultFigures];
const ids = [...figures, table].map(([id]) => id), unknown = only?.find((id) => !ids.includes(id));
if (unknown) fail(`--only names '${unknown}'; the figures are ${ids.join(', ')}`);
const isAsked = ([id]) => !only || only.includes(id);

async function draw([id, title, make]) {
  const html = await make(id);
  console.error(`thesis: ${title}`);
  return `<section id="${id}"><h2>${escape(title)}</h2>\n${html}</section>`;
}

async function drawPage() {
  mkdirSync(output, { recursive: true });
  const version = (await studio.run('--version')).trim().split(' ').at(-1);
  const parts = await Promise.all(figures.filter(isAsked).map(draw));
  if (isAsked(table)) parts.push(await draw(table)); // after all pictures: it measures time
  writeFileSync(join(output, 'index.html'), `<!doctype html>
<html lang="en"><meta charset="utf-8"><title>Wang &amp; Chi 2014, made anew</title>
<style>
body { font: 16px/1.5 system-ui, sans-serif; max-width: 1900px; margin: 2rem auto; padding: 0 1rem }
.row { display: flex; flex-wrap: wrap; gap: 12px; margin-bottom: 12px }
figure { margin: 0; width: 300px }
figure.wide { width: 900px }
img { width: 100%; height: auto }
figcaption { font-size: 14px }
code { display: block; font-size: 11px; color: #555; overflow-wrap: anywhere }
table { border-collapse: collapse }
td, th { padding: .3rem .8rem; border: 1px solid #bbb; text-align: right }
</style>
<h1>Image Space Real-time Multi-refraction Technology, made anew</h1>
<p>The figures of Shi-Hao Wang and Ming-Te Chi (National Chengchi University, 2014) by Vitrine ${version}: ${side} x ${side}, index of
refraction ${ior} (section 3.1.2), no Fresnel reflection. <i>Ours</i> is technique <code style="display: inline">layered</code>, the thesis's method as this program has it: 50
linear steps, at most four refractions and one total internal reflection, which are five events. Ray tracing is exact, with at most 64
events where no other number stands. Under each picture is the command that drew it.</p>
${parts.join('\n')}
${text(`Not here: diagrams (2.1 to 2.3, 2.8 to 2.10, 3.1, 3.2, 3.5, 3.6, 3.8, 3.9, 3.11, 3.14, 3.18, 3.19, 3.21, 3.22, 3.27, 3.28, 3.30 to 3.32), other people's
pictures (2.5 to 2.7, 2.11 to 2.16), and 3.7, a teapot drawn to a texture.`)}
</html>
`);
  console.error(`thesis: ${join(output, 'index.html')}`);
}

drawPage().catch((reason) => fail(reason.message));
