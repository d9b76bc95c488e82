/** One Monaco model for each open file, synchronised with the document store in both directions; diagnostics become markers. */

import { movedTo } from "../../../logic/plc/sourceLines";
import { isRequirements, isTable } from "../../../logic/project/explorer";
import { usePlc } from "../../../store/plc/plc";
import { useDocuments } from "../../../store/project/documents";
import { shownText } from "../../../store/project/shownProgram";
import { savedText } from "../../../store/project/sourceText";
import type { Problem, Violation } from "../../../wire/types";
import { bind, follow } from "./binding";
import { editor, MarkerSeverity, Uri } from "./monaco";
import { LANGUAGE } from "./st";

/** A table of inputs: Monaco's name for what has no syntax. */
const TEXT = "plaintext";
const models = new Map<string, editor.ITextModel>();
const OWNER = "scanbench";
const RUNTIME = "scanbench.runtime";

const SEVERITY: Record<Problem["severity"], MarkerSeverity> = {
  error: MarkerSeverity.Error,
  warning: MarkerSeverity.Warning,
  info: MarkerSeverity.Info,
};

/** URI scheme of texts as they ran. */
export const PAST = "scanbench-past";

/** A text as it ran in the past: it is read-only, and its editor disposes of it. */
export const pastModel = (path: string, text: string): editor.ITextModel =>
  editor.createModel(
    text,
    isTable(path) || isRequirements(path) ? TEXT : LANGUAGE,
    Uri.from({ scheme: PAST, path: `/${path}` }),
  );

export const uriOfPath = (path: string) => Uri.from({ scheme: "scanbench", path: `/${path}` });

/** Texts of files that are not open, which Monaco shows beside a place in them. */
const shown = new Map<string, editor.ITextModel>();

/** Gives Monaco the text of a file, open or not. */
export async function presentModel(path: string): Promise<void> {
  if (models.has(path)) return;
  const text = (await savedText(path)) ?? "";
  if (models.has(path)) return;
  const known = shown.get(path);
  if (known) known.setValue(text);
  else
    shown.set(path, editor.createModel(text, isTable(path) || isRequirements(path) ? TEXT : LANGUAGE, uriOfPath(path)));
}

export function modelOf(path: string, text: string): editor.ITextModel {
  const known = models.get(path);
  if (known && !known.isDisposed()) return known;
  shown.get(path)?.dispose();
  shown.delete(path);
  const model = editor.createModel(text, isTable(path) || isRequirements(path) ? TEXT : LANGUAGE, uriOfPath(path));
  model.setEOL(editor.EndOfLineSequence.LF);
  bind(path, model);
  models.set(path, model);
  markModel(path, model);
  markViolations(path, model);
  return model;
}

function markModel(path: string, model: editor.ITextModel): void {
  const { problems } = useDocuments.getState();
  editor.setModelMarkers(
    model,
    OWNER,
    problems
      .filter((problem) => problem.file === path)
      .map((problem) => ({
        severity: SEVERITY[problem.severity],
        message: problem.message,
        code: problem.code,
        startLineNumber: problem.line,
        startColumn: problem.column,
        endLineNumber: problem.end_line,
        endColumn: Math.max(problem.end_column, problem.line === problem.end_line ? problem.column + 1 : 1),
      })),
  );
}

/** A marker where an embedded check found a value outside its subrange while the program ran; none where the line was edited since. */
function markViolations(path: string, model: editor.ITextModel): void {
  const here = usePlc.getState().diagnostics.violations.filter(({ file }) => file === path);
  const { built, text } = shownText(path);
  const marker = (violation: Violation) => ({
    severity: MarkerSeverity.Warning,
    message: `${violation.text} (${violation.times}x)`,
    startLineNumber: violation.line,
    startColumn: violation.column,
    endLineNumber: violation.end_line,
    endColumn: violation.end_column,
  });
  editor.setModelMarkers(model, RUNTIME, movedTo(text, built, here).map(marker));
}

usePlc.subscribe((now, before) => {
  if (now.diagnostics === before.diagnostics) return;
  for (const [path, model] of models) markViolations(path, model);
});

// A text that changed in the store but not by typing (theirs was taken, or a colleague saved) goes into the model.
useDocuments.subscribe((now, before) => {
  // From its first moment on, so that every change of it can be taken back, also one that nobody typed.
  for (const { path, text } of Object.values(now.open)) if (!before.open[path]) modelOf(path, text);
  for (const [path, model] of models) {
    const document = now.open[path];
    if (!document) {
      model.dispose();
      models.delete(path);
      continue;
    }
    if (document.text !== before.open[path]?.text && document.text !== model.getValue()) {
      follow(model, document.text);
    }
    if (now.problems !== before.problems) markModel(path, model);
  }
});
