/** The extension with VS Code's own language client, at the real language server; only the window is not there. */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { test } from 'node:test';
import { COMMAND, HERE } from './command.mjs';

const { load } = createRequire(import.meta.url)('./vscode.cjs');

test('the language client of VS Code gets problems and declarations from the server, and ends it', async () => {
  const { extension, opened, providers, started, firstProblems, Uri, Place } = load({
    command: COMMAND,
    languageServer: true,
  });
  await extension.activate({ subscriptions: [] });
  assert.deepEqual({ ...started[0][1].createDebugAdapterDescriptor() }, { command: COMMAND, args: ['dap'] });
  const path = join(HERE, 'broken.st');
  const text = readFileSync(path, 'utf8');
  const document = { uri: Uri.file(path), languageId: 'iec61131', version: 1, getText: () => text };
  const first = firstProblems();
  opened.fire(document);
  const { uri, problems } = await first;
  assert.equal(uri, String(document.uri));
  assert.ok(problems.length > 0);
  const at = text.slice(0, text.indexOf('n :')).split('\n');
  const place = new Place(at.length - 1, at.at(-1).length);
  const token = { isCancellationRequested: false, onCancellationRequested: () => ({ dispose() {} }) };
  const hover = await providers.hover.provideHover(document, place, token);
  assert.ok(hover);
  await extension.deactivate();
});

test('without the language server only the debug adapter is set up', async () => {
  const { extension, started, shown } = load({ command: '/nowhere/scanbench', languageServer: false });
  await extension.activate({ subscriptions: [] });
  assert.equal(started.length, 1);
  assert.deepEqual(shown, []);
  await extension.deactivate();
});

test('a command that cannot be started is told with what to do', async () => {
  const { extension, shown } = load({ command: '/nowhere/scanbench', languageServer: true });
  await extension.activate({ subscriptions: [] });
  assert.match(shown.at(-1), /could not be started with \/nowhere\/scanbench lsp\. Set scanbench\.command/);
});

test('the number above a block lists what it counts', async () => {
  const { extension, opened, providers, commands, executed, firstProblems, Uri } = load({
    command: COMMAND,
    languageServer: true,
  });
  await extension.activate({ subscriptions: [] });
  const text =
    'FUNCTION_BLOCK Adder\nVAR_INPUT by : INT; END_VAR\nEND_FUNCTION_BLOCK\nPROGRAM Adding\nVAR a, b : Adder; END_VAR\na(by := 1;\nEND_PROGRAM\n';
  const document = { uri: Uri.file(join(HERE, 'lens.st')), languageId: 'iec61131', version: 1, getText: () => text };
  const first = firstProblems();
  opened.fire(document);
  await first;
  const token = { isCancellationRequested: false, onCancellationRequested: () => ({ dispose() {} }) };
  const [, lens] = await providers.lenses.provideCodeLenses(document, token);
  const { command } = await providers.lenses.resolveCodeLens(lens, token);
  assert.equal(`${command.title} ${command.command}`, 'at least 1 reference scanbench.showReferences');
  await commands[command.command](...command.arguments);
  const [name, uri, position, places] = executed.at(-1);
  assert.deepEqual([name, String(uri), position.line], ['editor.action.showReferences', String(document.uri), 0]);
  assert.equal(places.length, 1);
  await extension.deactivate();
});
