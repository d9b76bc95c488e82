/** Monaco, set up once: worker, language, and themes in the colours of the design's tokens. */
import { editor, KeyCode, KeyMod, languages } from "monaco-editor/editor";
import EditorWorker from "monaco-editor/editor/editor.worker?worker";
import { usePrefs } from "../../../store/page/prefs";
import { t } from "../../../text";
import "./features";
import { configuration, LANGUAGE, tokenizer } from "./st";

self.MonacoEnvironment = { getWorker: () => new EditorWorker() };

languages.register({ id: LANGUAGE, extensions: [".st", ".iecst"], aliases: ["Structured Text", "ST"] });
languages.setMonarchTokensProvider(LANGUAGE, tokenizer);
languages.setLanguageConfiguration(LANGUAGE, configuration);

// In a browser Monaco gives the definition this second key, which is that of the implementations, and names it in its menu.
editor.addKeybindingRule({
  keybinding: KeyMod.CtrlCmd | KeyCode.F12,
  command: "-editor.action.revealDefinition",
});

const THEME = "scanbench";

function paint(): void {
  const styles = getComputedStyle(document.documentElement);
  const token = (name: string) => sixDigits(styles.getPropertyValue(`--${name}`).trim());
  const rule = (name: string, colour: string) => ({ token: name, foreground: token(colour).slice(1) });
  const { theme } = usePrefs.getState();
  editor.defineTheme(THEME, {
    base: theme === "light" ? "vs" : theme === "contrast" ? "hc-black" : "vs-dark",
    inherit: true,
    rules: [
      rule("", "code-text"),
      rule("keyword", "code-keyword"),
      rule("type", "code-type"),
      rule("number", "code-literal"),
      rule("string", "code-literal"),
      rule("string.escape", "code-literal"),
      rule("variable.predefined", "code-literal"),
      // By what a name means (`semanticTokens.ts`).
      ...["variable", "parameter", "property"].map((kind) => rule(kind, "code-text")),
      ...["variable.readonly", "parameter.readonly", "property.readonly", "enumMember"].map((kind) =>
        rule(kind, "code-literal"),
      ),
      ...["class", "function", "method"].map((kind) => rule(kind, "code-type")),
      rule("comment", "code-comment"),
      rule("annotation", "code-comment"),
      rule("delimiter", "code-text"),
      rule("identifier", "code-text"),
    ],
    colors: {
      "editor.background": token("bg-panel"),
      "editor.foreground": token("code-text"),
      "editorLineNumber.foreground": token("code-line-number"),
      "editorLineNumber.activeForeground": token("code-text"),
      "editorIndentGuide.background1": token("code-guide"),
      "editor.lineHighlightBackground": token("bg-raised"),
      "editor.lineHighlightBorder": "#00000000",
      "editor.selectionBackground": token("accent-soft"),
      "editor.inactiveSelectionBackground": token("bg-pressed"),
      ...brackets(token("code-text")),
      "editorCursor.foreground": token("accent"),
      "editorWidget.background": token("bg-float"),
      "editorWidget.border": token("line-seam"),
      "editorHoverWidget.background": token("bg-float"),
      "editorHoverWidget.border": token("line-seam"),
      "editorSuggestWidget.background": token("bg-float"),
      "editorSuggestWidget.border": token("line-seam"),
      "editorSuggestWidget.foreground": token("text"),
      "editorSuggestWidget.highlightForeground": token("accent"),
      "editorSuggestWidget.focusHighlightForeground": token("accent"),
      "editorSuggestWidget.selectedBackground": token("accent-soft"),
      "editorSuggestWidget.selectedForeground": token("text"),
      "editorCodeLens.foreground": token("code-comment"),
      "editorLink.activeForeground": token("accent"),
      "editorInlayHint.foreground": token("code-comment"),
      "editorInlayHint.background": "#00000000",
      "editorError.foreground": token("severity-error"),
      "editorWarning.foreground": token("severity-warning"),
      "editorInfo.foreground": token("severity-info"),
      "editorGutter.background": token("bg-panel"),
      "editorOverviewRuler.border": "#00000000",
      "scrollbar.shadow": "#00000000",
      focusBorder: token("focus"),
      ...differences(token),
      ...floats(token),
    },
  });
  editor.setTheme(THEME);
}

// The build shortens #ffffff to #fff, which Monaco does not accept.
function sixDigits(colour: string): string {
  return colour.length === 4 ? colour.replace(/[^#]/g, "$&$&") : colour;
}

/** Two texts side by side: so weak that a comment can still be read on it. */
function differences(token: (name: string) => string): Record<string, string> {
  return {
    "diffEditor.insertedLineBackground": `${token("error-handled")}14`,
    "diffEditor.insertedTextBackground": `${token("error-handled")}1a`,
    "diffEditor.removedLineBackground": `${token("state-differs")}14`,
    "diffEditor.removedTextBackground": `${token("state-differs")}1a`,
  };
}

/** The editor's own lists, fields and peeks, in the colours of the page. */
function floats(token: (name: string) => string): Record<string, string> {
  return {
    "badge.background": token("bg-control"),
    "badge.foreground": token("text-muted"),
    "input.background": token("bg-inset"),
    "input.foreground": token("text"),
    "input.border": token("line-control"),
    "list.activeSelectionBackground": token("accent-soft"),
    "list.activeSelectionForeground": token("text"),
    "list.focusBackground": token("accent-soft"),
    "list.highlightForeground": token("accent"),
    "list.hoverBackground": token("bg-hover"),
    "list.inactiveSelectionBackground": token("bg-pressed"),
    "menu.background": token("bg-float"),
    "menu.border": token("line-seam"),
    "menu.foreground": token("text"),
    "menu.selectionBackground": token("accent-soft"),
    "menu.selectionForeground": token("text"),
    "peekView.border": token("accent"),
    "peekViewEditor.background": token("bg-inset"),
    "peekViewEditor.matchHighlightBackground": token("accent-soft"),
    "peekViewEditorGutter.background": token("bg-inset"),
    "peekViewResult.background": token("bg-panel"),
    "peekViewResult.fileForeground": token("text"),
    "peekViewResult.lineForeground": token("text-muted"),
    "peekViewResult.matchHighlightBackground": token("accent-soft"),
    "peekViewResult.selectionBackground": token("bg-pressed"),
    "peekViewResult.selectionForeground": token("text"),
    "peekViewTitle.background": token("bg-raised"),
    "peekViewTitleDescription.foreground": token("text-muted"),
    "peekViewTitleLabel.foreground": token("text"),
    "quickInput.background": token("bg-float"),
    "quickInput.foreground": token("text"),
    "quickInputList.focusBackground": token("accent-soft"),
    "quickInputList.focusForeground": token("text"),
  };
}

// Colours by nesting depth would be more prominent than the syntax and the states.
function brackets(colour: string): Record<string, string> {
  return Object.fromEntries([1, 2, 3, 4, 5, 6].map((depth) => [`editorBracketHighlight.foreground${depth}`, colour]));
}

paint();
usePrefs.subscribe(paint);

/** What Monaco itself cancels, as a question about a text that is closed meanwhile, it rejects; nobody waits for an answer any more. */
addEventListener("unhandledrejection", (event) => {
  if (event.reason instanceof Error && event.reason.name === "Canceled") event.preventDefault();
});

/** Popups of all editors live in one element of the page, so that panels do not cut them off. */
const popups = document.createElement("div");
popups.className = "monaco-editor editor-popups";
document.body.append(popups);

export const options: editor.IStandaloneEditorConstructionOptions = {
  language: LANGUAGE,
  theme: THEME,
  // A theme of the standalone editor cannot say this.
  "semanticHighlighting.enabled": true,
  automaticLayout: true,
  fixedOverflowWidgets: true,
  overflowWidgetsDomNode: popups,
  wordBasedSuggestions: "off",
  quickSuggestions: { other: true, comments: false, strings: false },
  acceptSuggestionOnCommitCharacter: false,
  // The editor inserts only what is typed: it completes and closes nothing unless somebody asks for it. `indent.ts` indents.
  suggest: { selectionMode: "never" },
  autoClosingBrackets: "never",
  autoClosingQuotes: "never",
  autoClosingComments: "never",
  autoIndent: "none",
  minimap: { enabled: false },
  stickyScroll: { enabled: true, maxLineCount: 3 },
  fontSize: 12.5,
  lineHeight: 20,
  fontLigatures: false,
  lineNumbersMinChars: 4,
  glyphMargin: true,
  folding: true,
  scrollBeyondLastLine: false,
  smoothScrolling: false,
  renderLineHighlight: "line",
  renderWhitespace: "none",
  // The default dims it too much for the number to be readable.
  renderFinalNewline: "on",
  occurrencesHighlight: "singleFile",
  overviewRulerBorder: false,
  padding: { top: 4, bottom: 4 },
  tabSize: 4,
  insertSpaces: true,
  unicodeHighlight: { ambiguousCharacters: false },
  scrollbar: { verticalScrollbarSize: 12, horizontalScrollbarSize: 10 },
};

export function monospaceFont(): string {
  return getComputedStyle(document.documentElement).getPropertyValue("--font-mono").trim();
}

export type { IPosition, IRange, ISelection } from "monaco-editor/editor";
export { editor, KeyCode, KeyMod, languages, MarkerSeverity, Uri } from "monaco-editor/editor";

/** For who hears the page. The options of a comparison that say so do not reach its editors. */
export function nameSides(view: editor.IStandaloneDiffEditor): void {
  view.getOriginalEditor().updateOptions({ ariaLabel: t("diff.left") });
  view.getModifiedEditor().updateOptions({ ariaLabel: t("diff.right") });
}

/** Ends a comparison of two texts. Its editors made all hovers depend on them; one that is made after it frees them again. */
export function endComparison(view: editor.IStandaloneDiffEditor): void {
  view.dispose();
  editor.create(document.createElement("div"), { model: null }).dispose();
}
