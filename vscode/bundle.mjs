/** Makes `languageclient.js`, VS Code's own language client in one file, and the licences of what is in it. Others install without Node. */
import { readFile, writeFile } from 'node:fs/promises';
import { build } from 'esbuild';

const [library, notices] = process.argv.slice(2);
const made = await build({
  entryPoints: ['vscode-languageclient/node'],
  bundle: true,
  platform: 'node',
  target: 'node20',
  external: ['vscode'],
  minify: true,
  metafile: true,
  legalComments: 'none',
  banner: { js: '// Made by `npm run bundle` from vscode-languageclient; NOTICES.md has the licences.' },
  outfile: library,
});
const packages = new Set(
  Object.keys(made.metafile.inputs)
    .map((path) => /^node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(path)?.[1])
    .filter((name) => name !== undefined),
);
const parts = ['# Licences of what is in this extension\n'];
for (const name of [...packages].sort()) {
  const { version, license } = JSON.parse(await readFile(`node_modules/${name}/package.json`, 'utf8'));
  parts.push(`## ${name} ${version} (${license})\n\n${(await licenceOf(name)).trim()}\n`);
}
await writeFile(
  notices,
  parts
    .join('\n')
    .replaceAll('\r', '')
    .replaceAll(/[ \t]+$/gm, ''),
);

async function licenceOf(name) {
  for (const file of ['LICENSE', 'LICENSE.md', 'License.txt', 'LICENSE.txt', 'license.txt']) {
    const text = await readFile(`node_modules/${name}/${file}`, 'utf8').catch(() => null);
    if (text !== null) return text;
  }
  throw new Error(`${name} has no licence file`);
}
