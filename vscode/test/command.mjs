/** What the tests start. */
import { dirname, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

export const HERE = dirname(fileURLToPath(import.meta.url));
export const COMMAND = process.env.SCANBENCH ?? resolve(HERE, '../../.venv/bin/scanbench');
