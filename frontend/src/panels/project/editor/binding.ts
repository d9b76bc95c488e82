/** Ties a text of Monaco to the text that several people edit at once: what is typed here goes there, what others type comes here. */
import { textChange } from "../../../logic/project/textChange";
import { edit } from "../../../store/project/documents";
import { followDeltas, sharedText } from "../../../store/project/drafts";
import type { Delta } from "../../../store/project/sharedText";
import { editor, type IRange } from "./monaco";

/** Monaco's declarations leave out how its commands take something back. */
interface Undoing {
  undo(): void;
  redo(): void;
  pushStackElement(): void;
}

const bound = new Map<string, editor.ITextModel>();
/** Texts that change now because they do elsewhere. */
const following = new Set<editor.ITextModel>();

export function bind(path: string, model: editor.ITextModel): void {
  bound.set(path, model);
  model.onDidChangeContent(({ changes }) => {
    if (following.has(model)) return;
    const shared = sharedText(path);
    if (!shared) {
      edit(path, model.getValue());
      return;
    }
    shared.typed(changes);
    if (shared.length !== model.getValueLength()) shared.replace(model.getValue());
  });
  model.onWillDispose(() => bound.get(path) === model && bound.delete(path));
  takeBackOwnOnly(path, model);
}

/** Becomes a text that is different elsewhere; carets outside of what is different keep their places. */
export function follow(model: editor.ITextModel, text: string): void {
  const change = textChange(model.getValue(), text);
  if (!change) return;
  const { start, end } = change.range;
  const range = {
    startLineNumber: start.line + 1,
    startColumn: start.character + 1,
    endLineNumber: end.line + 1,
    endColumn: end.character + 1,
  };
  quietly(model, () => model.pushEditOperations([], [{ range, text: change.text }], () => null));
}

function quietly(model: editor.ITextModel, deed: () => unknown): void {
  following.add(model);
  try {
    deed();
  } finally {
    following.delete(model);
  }
}

followDeltas((path, delta) => {
  const model = bound.get(path);
  if (model) quietly(model, () => model.applyEdits(editsOf(model, delta)));
});

/** All places are those before the change. */
function editsOf(model: editor.ITextModel, delta: Delta): { range: IRange; text: string }[] {
  const edits: { start: number; end: number; text: string }[] = [];
  let at = 0;
  let open: (typeof edits)[number] | null = null;
  for (const { retain, delete: gone, insert } of delta) {
    if (retain !== undefined) {
      at += retain;
      open = null;
      continue;
    }
    if (!open) {
      open = { start: at, end: at, text: "" };
      edits.push(open);
    }
    if (typeof insert === "string") open.text += insert;
    at += gone ?? 0;
    open.end = at;
  }
  return edits.map(({ start, end, text }) => ({ range: rangeOf(model, start, end), text }));
}

function rangeOf(model: editor.ITextModel, start: number, end: number): IRange {
  const from = model.getPositionAt(start);
  const to = model.getPositionAt(end);
  return {
    startLineNumber: from.lineNumber,
    startColumn: from.column,
    endLineNumber: to.lineNumber,
    endColumn: to.column,
  };
}

/** Undo and redo are of one's own changes; Monaco's would not know the others' in between. */
function takeBackOwnOnly(path: string, model: editor.ITextModel): void {
  const inner = model as unknown as Undoing;
  const monaco = {
    undo: inner.undo.bind(model),
    redo: inner.redo.bind(model),
    pushStackElement: inner.pushStackElement.bind(model),
  };
  inner.undo = () => back(model, () => sharedText(path)?.undo() ?? monaco.undo());
  inner.redo = () => back(model, () => sharedText(path)?.redo() ?? monaco.redo());
  inner.pushStackElement = () => {
    monaco.pushStackElement();
    sharedText(path)?.endStep();
  };
}

/** The caret goes to where something was taken back. */
function back(model: editor.ITextModel, deed: () => unknown): void {
  let last: IRange | null = null;
  const listening = model.onDidChangeContent(({ changes }) => {
    for (const { range, text } of changes) last ??= endOf(model, range, text);
  });
  deed();
  listening.dispose();
  const code = editor.getEditors().find((one) => one.getModel() === model && one.hasTextFocus());
  if (!code || !last) return;
  code.setSelection(last);
  code.revealRange(last);
}

function endOf(model: editor.ITextModel, range: IRange, text: string): IRange {
  const start = model.getOffsetAt({ lineNumber: range.startLineNumber, column: range.startColumn });
  return rangeOf(model, start + text.length, start + text.length);
}
