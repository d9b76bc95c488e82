/** A server of its own for a measurement, with a folder of its own. */
import { spawn } from 'node:child_process';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';

const COMMAND = process.env.SCANBENCH ?? resolve(import.meta.dirname, '../../.venv/bin/scanbench');

/** Calls `measure` with the address that the server printed, and ends the server afterwards, whatever happened. */
export async function withServer(name, measure) {
  const data = await mkdtemp(join(tmpdir(), `scanbench-${name}-`));
  const server = spawn(COMMAND, ['serve', '--port', '0', '--data', data], { detached: true });
  try {
    await measure(await printed(server));
  } finally {
    process.kill(-server.pid, 'SIGKILL');
    await rm(data, { recursive: true, force: true });
  }
}

function printed(server) {
  return new Promise((ready, failed) => {
    let said = '';
    const hear = (chunk) => {
      said += chunk;
      const found = /Scanbench is ready: (http:\/\/\S+)/.exec(said)?.[1];
      if (found) ready(found);
    };
    server.stdout.on('data', hear);
    server.stderr.on('data', hear);
    server.once('exit', () => failed(new Error(`the server ended: ${said}`)));
  });
}
