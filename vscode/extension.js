/** Tells VS Code how to start the debug adapter and the language server. Everything else is in package.json, and in `scanbench dap` and `scanbench lsp`. */
const vscode = require('vscode');

const setting = (name) => vscode.workspace.getConfiguration('scanbench').get(name);
/** Ours, and those that other extensions for ST give to the same files. */
const LANGUAGES = ['iec61131', 'st', 'structured-text', '61131-3-st'];

let client;

/** A command that shows the places which the language server counted, with its arguments: a document and a position. */
const lists = (command, method, more) =>
  vscode.commands.registerCommand(command, async (uri, position) => {
    const found = await client.sendRequest(method, { textDocument: { uri }, position, ...more });
    const { asPosition, asLocation } = client.protocol2CodeConverter;
    const places = found.map(asLocation);
    await vscode.commands.executeCommand(
      'editor.action.showReferences',
      vscode.Uri.parse(uri),
      asPosition(position),
      places,
    );
  });

exports.activate = async (context) => {
  context.subscriptions.push(
    vscode.debug.registerDebugAdapterDescriptorFactory('scanbench', {
      createDebugAdapterDescriptor: () => new vscode.DebugAdapterExecutable(setting('command'), ['dap']),
    }),
  );
  if (!setting('languageServer')) return;
  const { LanguageClient } = require('./languageclient.js');
  client = new LanguageClient(
    'scanbench',
    'Scanbench',
    { command: setting('command'), args: ['lsp'] },
    {
      documentSelector: LANGUAGES.map((language) => ({ scheme: 'file', language })),
      initializationOptions: { lists: true, embeddedChecks: setting('embeddedChecks') === true },
    },
  );
  context.subscriptions.push(
    lists('scanbench.showInstances', 'scanbench/instances', {}),
    lists('scanbench.showReferences', 'textDocument/references', { context: { includeDeclaration: false } }),
  );
  try {
    await client.start();
  } catch {
    client = undefined;
    await vscode.window.showErrorMessage(
      `Scanbench: the language server could not be started with ${setting('command')} lsp. Set scanbench.command to the file of the command (.../.venv/bin/scanbench), then reload the window.`,
    );
  }
};

exports.deactivate = () => client?.stop();
