/** The view "embedded checks": inlay text where the compiler checks a subrange, and where it proved that no check is needed. */

import { usePrefs } from "../../../store/page/prefs";
import { useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";
import type { EmbeddedCheck } from "../../../wire/types";
import { inlaysChanged, onInlaysChanged } from "./inlayChanges";
import { PAST } from "./models";
import { type editor, languages } from "./monaco";
import { LANGUAGE } from "./st";

languages.registerInlayHintsProvider(LANGUAGE, {
  onDidChangeInlayHints: onInlaysChanged,
  provideInlayHints: (model: editor.ITextModel, range) => {
    if (!usePrefs.getState().checks) return { hints: [], dispose: () => undefined };
    // The compiler reports them for the edited texts, not for the program that ran in the past.
    if (model.uri.scheme === PAST) return { hints: [], dispose: () => undefined };
    const path = model.uri.path.slice(1);
    const here = useDocuments.getState().checks.filter((check) => check.file === path);
    const seen = here.filter((check) => range.startLineNumber <= check.line && check.line <= range.endLineNumber);
    return { hints: seen.map((check) => hint(check, sharesItsEnd(check, seen))), dispose: () => undefined };
  },
});

/** The last operand and the whole assigned expression end at the same place: then each inlay names its expression. */
function sharesItsEnd(check: EmbeddedCheck, all: readonly EmbeddedCheck[]): boolean {
  return all.some(
    (other) => other !== check && other.end_line === check.end_line && other.end_column === check.end_column,
  );
}

function hint(check: EmbeddedCheck, named: boolean): languages.InlayHint {
  const { variable, low, high, needless } = check;
  const range = `${needless ? "✓" : "⊂"} ${low}..${high}`;
  return {
    label: named ? `${variable} ${range}` : range,
    tooltip: needless
      ? t("checks.needless", { variable, why: needless })
      : t("checks.embedded", { variable, low, high }),
    position: { lineNumber: check.end_line, column: check.end_column },
    paddingLeft: true,
  };
}

useDocuments.subscribe((now, before) => {
  if (now.checks !== before.checks) inlaysChanged();
});
usePrefs.subscribe((now, before) => {
  if (now.checks !== before.checks) inlaysChanged();
});
