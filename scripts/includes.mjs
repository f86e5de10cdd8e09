// Who uses whom, among the modules in C and C++ of src/, native/ and web/: prints circles and what looks upwards in
// the table of CONTRIBUTING.md, and exits 1 where there is any. --graph prints what each module uses.
//
// A module is x.h with x.c or x.cpp, or x.h alone where it declares what several files define. A module uses those whose
// headers it includes, and those whose functions it names: vitrine.h and its like do not tell where a function is.
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = join(dirname(fileURLToPath(import.meta.url)), '..');
const kinds = ['.h', '.c', '.cpp'];
const findFiles = (folder) => readdirSync(join(root, folder), { withFileTypes: true }).flatMap((entry) => {
  const path = join(folder, entry.name);
  return entry.isDirectory() ? findFiles(path) : kinds.includes(extname(path)) ? [path] : [];
});
const files = ['src', 'native', 'web'].flatMap(findFiles);
const withoutKind = (file) => file.slice(0, -extname(file).length);

// ---------------------------------------------------------------------------------------------------- what uses what

const withoutComments = (text) => text.replace(/\/\/.*|\/\*[^]*?\*\//g, '');
const withoutTexts = (text) => text.replace(/^\s*#.*|"(\\.|[^"\\])*"/gm, '');
const texts = new Map(files.map((file) => [file, withoutComments(readFileSync(join(root, file), 'utf8'))]));
const words = (file) => new Set(withoutTexts(texts.get(file)).match(/\b[A-Za-z_]\w+\b/g));

/** The file that an include names: beside the one that includes it, or in a folder that compilers search. */
function findIncluded(from, name) {
  return [dirname(from), 'src', 'native', 'web', '.'].map((folder) => join(folder, name)).find((file) => texts.has(file));
}

const definedIn = new Map(); // function -> files: one for each kind of build may define it
const ownNames = new Map(); // file -> functions that it defines, static ones too
for (const [file, text] of texts) {
  const found = [...withoutTexts(text).matchAll(/^(?!typedef|return)([A-Za-z_][\w \t*]*?)\b(\w+)\([^;{}]*\)\s*\{/gm)];
  ownNames.set(file, new Set(found.map(([, , name]) => name)));
  for (const [, before, name] of found) {
    if (extname(file) !== '.h' && !/\bstatic\b/.test(before)) definedIn.set(name, [...(definedIn.get(name) ?? []), file]);
  }
}

/** Does this header declare what other files than its own define? */
function isShared(header) {
  return [...words(header)].some((name) => !ownNames.get(header).has(name) &&
    (definedIn.get(name) ?? []).some((file) => withoutKind(file) !== withoutKind(header)));
}
const modules = new Map(files.map((file) => [file, extname(file) === '.h' && isShared(file) ? file : withoutKind(file)]));

const uses = new Map([...modules.values()].map((name) => [name, new Map()])); // module -> module -> why
for (const [file, text] of texts) {
  const add = (used, why) => {
    const [from, to] = [modules.get(file), modules.get(used)];
    if (from !== to && !uses.get(from).has(to)) uses.get(from).set(to, why);
  };
  for (const [, name] of text.matchAll(/^\s*#include "([^"]+)"/gm)) {
    const included = findIncluded(file, name);
    if (included) add(included, `${file} includes ${name}`);
  }
  if (extname(file) === '.h') continue;
  for (const name of words(file)) {
    if (!ownNames.get(file).has(name)) definedIn.get(name)?.forEach((used) => add(used, `${file} uses ${name}`));
  }
}

// ----------------------------------------------------------------------------------------------------------- circles

/** Tarjan's strongly connected components of more than one module. */
function findCircles() {
  const order = new Map(), lowest = new Map(), stack = [], circles = [];
  const visit = (name) => {
    order.set(name, order.size);
    lowest.set(name, order.get(name));
    stack.push(name);
    for (const used of uses.get(name).keys()) {
      if (!order.has(used)) visit(used);
      if (stack.includes(used)) lowest.set(name, Math.min(lowest.get(name), lowest.get(used)));
    }
    if (lowest.get(name) < order.get(name)) return;
    const circle = stack.splice(stack.indexOf(name));
    if (circle.length > 1) circles.push(circle);
  };
  for (const name of uses.keys()) if (!order.has(name)) visit(name);
  return circles;
}

// ----------------------------------------------------------------------------------------------------------- upwards

/** The table's rows: of each, the folders, and files, named in its first column. */
function readTable() {
  const rows = readFileSync(join(root, 'CONTRIBUTING.md'), 'utf8').match(/^\| `[^|]*(?=\|)/gm);
  return rows.map((row) => [...row.matchAll(/`([^`]+)`/g)].map(([, place]) => place));
}

/** The row that the module is in, by the longest name that it begins with; -1: none. */
function findRow(table, name) {
  let row = -1, length = 0;
  table.forEach((places, i) => places.forEach((place) => {
    const part = modules.get(place) ?? place; // a file's module
    if (`${name}/`.startsWith(`${part}/`) && part.length > length) [row, length] = [i, part.length];
  }));
  return row;
}

const problems = findCircles().map((circle) => {
  const within = circle.flatMap((name) => [...uses.get(name)].filter(([used]) => circle.includes(used)).map(([, why]) => `  ${why}`));
  return [`circle: ${circle.join(' ')}`, ...within].join('\n');
});
const table = readTable();
for (const [name, used] of uses) {
  const row = findRow(table, name);
  if (row < 0) problems.push(`nowhere: ${name} is in no folder of the table in CONTRIBUTING.md`);
  for (const [other, why] of used) {
    if (row >= 0 && findRow(table, other) > row) problems.push(`upwards: ${why} of ${other}`);
  }
}
if (process.argv.includes('--graph')) {
  for (const [name, used] of uses) console.log(`${name}: ${[...used.keys()].join(' ')}`);
}
problems.forEach((problem) => console.error(problem));
process.exitCode = problems.length > 0 ? 1 : 0;
