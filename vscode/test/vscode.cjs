/** A VS Code without a window: enough of its API for the extension, and for the language client of VS Code that is in it. */
const Module = require('node:module');
const { pathToFileURL } = require('node:url');

/** Anything: to be called, made, read; what is not listed in `over` is there and does nothing. */
function anything(over = {}) {
  const made = () => anything({ dispose() {} });
  return new Proxy(class {}, {
    get(target, key) {
      if (key === 'prototype') return target.prototype;
      if (key in over) return over[key];
      if (key === 'then') return undefined;
      return key === Symbol.toPrimitive ? () => '' : anything();
    },
    apply: made,
    construct: made,
  });
}

class Disposable {
  constructor(end) {
    this.end = end;
  }
  dispose() {
    this.end?.();
  }
}

class EventEmitter {
  heard = [];
  event = (hear, self) => {
    this.heard.push(self ? hear.bind(self) : hear);
    return new Disposable();
  };
  fire(event) {
    for (const hear of this.heard) hear(event);
  }
  dispose() {}
}

class Uri {
  constructor(text) {
    this.text = text;
    this.scheme = text.split(':')[0];
  }
  toString() {
    return this.text;
  }
  static parse = (text) => new Uri(text);
  static file = (path) => new Uri(pathToFileURL(path).href);
}

class Place {
  constructor(line, character) {
    Object.assign(this, { line, character });
  }
}

class Range {
  constructor(line, character, endLine, endCharacter) {
    Object.assign(this, { start: new Place(line, character), end: new Place(endLine, endCharacter) });
  }
}

class CodeLens {
  constructor(range) {
    this.range = range;
  }
}

/** Loads the extension into such a VS Code. `settings` are those of Scanbench. */
exports.load = (settings) => {
  const opened = new EventEmitter();
  const providers = {};
  const found = new EventEmitter();
  const shown = [];
  const started = [];
  const commands = {};
  const executed = [];
  const vscode = anything({
    version: '1.85.0',
    Disposable,
    EventEmitter,
    Uri,
    Position: Place,
    Range,
    CodeLens,
    DebugAdapterExecutable: class {
      constructor(command, args) {
        Object.assign(this, { command, args });
      }
    },
    CancellationTokenSource: class {
      token = { isCancellationRequested: false, onCancellationRequested: () => new Disposable() };
      cancel() {}
      dispose() {}
    },
    env: anything({ language: 'en', appName: 'test' }),
    commands: anything({
      registerCommand: (name, run) => {
        commands[name] = run;
        return new Disposable();
      },
      executeCommand: async (...what) => executed.push(what),
    }),
    debug: anything({ registerDebugAdapterDescriptorFactory: (type, factory) => started.push([type, factory]) }),
    workspace: anything({
      workspaceFolders: undefined,
      textDocuments: [],
      notebookDocuments: [],
      onDidOpenTextDocument: opened.event,
      getConfiguration: () => ({ get: (key) => settings[key] }),
    }),
    languages: anything({
      match: () => 10,
      createDiagnosticCollection: () => ({
        set: (uri, problems) => found.fire({ uri: uri.toString(), problems }),
        delete() {},
        clear() {},
        dispose() {},
      }),
      registerCodeLensProvider: (_, provider) => {
        providers.lenses = provider;
        return new Disposable();
      },
      registerHoverProvider: (_, provider) => {
        providers.hover = provider;
        return new Disposable();
      },
    }),
    window: anything({
      visibleTextEditors: [],
      tabGroups: anything({ all: [], onDidChangeTabs: () => new Disposable() }),
      createOutputChannel: () => ({ append() {}, appendLine() {}, show() {}, dispose() {} }),
      showErrorMessage: async (message) => {
        shown.push(message);
      },
    }),
  });
  const usual = Module._load;
  Module._load = (name, ...rest) => (name === 'vscode' ? vscode : usual(name, ...rest));
  delete require.cache[require.resolve('../extension.js')];
  delete require.cache[require.resolve('../languageclient.js')];
  const extension = require('../extension.js');
  const once = () =>
    new Promise((resolve) => found.event(({ uri, problems }) => problems?.length && resolve({ uri, problems })));
  return { extension, opened, providers, commands, executed, shown, started, Uri, Place, firstProblems: once };
};
