/** The view "embedded checks": inlay text where the compiler checks a subrange, and where it proved that needless. */
import { t } from "../../logic/text";
import { useDocuments } from "../../store/documents";
import { usePrefs } from "../../store/prefs";
import type { EmbeddedCheck } from "../../wire/types";
import { Emitter, type editor, languages } from "./monaco";
import { LANGUAGE } from "./st";

const changed = new Emitter<void>();

languages.registerInlayHintsProvider(LANGUAGE, {
  onDidChangeInlayHints: changed.event,
  provideInlayHints: (model: editor.ITextModel, range) => {
    if (!usePrefs.getState().checks) return { hints: [], dispose: () => undefined };
    const path = model.uri.path.slice(1);
    const here = useDocuments.getState().checks.filter((check) => check.file === path);
    const seen = here.filter((check) => range.startLineNumber <= check.line && check.line <= range.endLineNumber);
    return { hints: seen.map(hint), dispose: () => undefined };
  },
});

function hint(check: EmbeddedCheck): languages.InlayHint {
  const { variable, low, high, needless } = check;
  return {
    label: needless ? `✓ ${low}..${high}` : `⊂ ${low}..${high}`,
    tooltip: needless
      ? t("checks.needless", { variable, why: needless })
      : t("checks.embedded", { variable, low, high }),
    position: { lineNumber: check.end_line, column: check.end_column },
    paddingLeft: true,
  };
}

useDocuments.subscribe((now, before) => {
  if (now.checks !== before.checks) changed.fire();
});
usePrefs.subscribe((now, before) => {
  if (now.checks !== before.checks) changed.fire();
});
