/** Tells VS Code how to start the debug adapter. Everything else is in package.json, and in `scanbench dap`. */
const vscode = require('vscode');

exports.activate = (context) => {
  context.subscriptions.push(
    vscode.debug.registerDebugAdapterDescriptorFactory('scanbench', {
      createDebugAdapterDescriptor: () =>
        new vscode.DebugAdapterExecutable(vscode.workspace.getConfiguration('scanbench').get('command'), ['dap']),
    }),
  );
};
