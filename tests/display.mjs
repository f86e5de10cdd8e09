// A display without a screen, for programs that open windows.
import { spawn } from 'node:child_process';

export const xvfbPath = '/usr/bin/Xvfb';

/** Xvfb on a display of its own choice. @returns {Promise<{display: string, stop: () => void}>} */
export async function startDisplay() {
  const server = spawn(xvfbPath, ['-displayfd', '3', '-screen', '0', '1280x1024x24', '+extension', 'GLX', '-noreset'], { stdio: ['ignore', 'ignore', 'ignore', 'pipe'] });
  const number = await new Promise((done, fail) => {
    server.stdio[3].once('data', (text) => done(String(text).trim()));
    server.once('exit', () => fail(new Error('Xvfb does not start')));
  });
  return { display: `:${number}`, stop: () => server.kill() };
}
