// What all programs that drive Chromium share: where it is, how it is started, and a server for what it shows.
import { existsSync, readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join } from 'node:path';

export const chromiumPath = process.env.CHROMIUM ?? '/usr/bin/chromium';

/** Mesa's llvmpipe is the faster of the two software GPUs; SwiftShader is Chromium's own. */
export const gpus = {
  llvmpipe: ['--use-gl=angle', '--use-angle=gl-egl', '--ignore-gpu-blocklist'],
  swiftshader: ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  gpu: process.platform === 'linux' ? ['--use-gl=angle', '--use-angle=gl-egl', '--ignore-gpu-blocklist'] : ['--ignore-gpu-blocklist'],
};

const quiet = ['--no-sandbox', '--disable-sync', '--disable-quic', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-gpu-watchdog'];

/** Chromium without a window. @param {'llvmpipe'|'swiftshader'|'gpu'} gpu */
export async function launch(gpu = 'llvmpipe', options = {}) {
  const { chromium } = await import('playwright-core');
  return chromium.launch({ executablePath: chromiumPath, args: [...quiet, ...gpus[gpu]], ...options });
}

const types = {
  '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.css': 'text/css', '.json': 'application/json',
  '.wasm': 'application/wasm', '.png': 'image/png', '.glb': 'model/gltf-binary', '.hdr': 'image/vnd.radiance',
};

export const typeOf = (path) => types[extname(path)] ?? 'application/octet-stream';

/** A server on a free port of this machine. @param {import('node:http').RequestListener} answer */
export async function listen(answer) {
  const server = createServer(answer);
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  return { address: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
}

/** Answers with a file of the folder; a path that ends in a slash means its index.html. */
export function answerWithFile(folder, pathname, response) {
  const file = join(folder, pathname.endsWith('/') ? `${pathname}index.html` : pathname);
  if (!file.startsWith(folder) || !extname(file) || !existsSync(file)) {
    response.writeHead(404).end();
    return;
  }
  const body = readFileSync(file);
  response.writeHead(200, { 'content-type': typeOf(file), 'content-length': body.length }).end(body);
}

/** Serves a folder. @returns {Promise<{address: string, close: () => void}>} */
export function serve(folder) {
  return listen((request, response) => answerWithFile(folder, new URL(request.url, 'http://localhost').pathname, response));
}

/** What of [there, name] is missing, as the reason to skip; false where nothing is. */
export function skipWithout(...needs) {
  const missing = needs.filter(([there]) => !there).map(([, name]) => name);
  return missing.length > 0 && `missing: ${missing.join(', ')}`;
}
