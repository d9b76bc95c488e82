/** Monaco, set up once: worker, language, and themes in the colours of the design's tokens. */
import "monaco-editor/features/register.all";
import { editor, languages } from "monaco-editor/editor";
import EditorWorker from "monaco-editor/editor/editor.worker?worker";
import { usePrefs } from "../../../store/page/prefs";
import { configuration, LANGUAGE, tokenizer } from "./st";

self.MonacoEnvironment = { getWorker: () => new EditorWorker() };

languages.register({ id: LANGUAGE, extensions: [".st", ".iecst"], aliases: ["Structured Text", "ST"] });
languages.setMonarchTokensProvider(LANGUAGE, tokenizer);
languages.setLanguageConfiguration(LANGUAGE, configuration);

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
      "editorError.foreground": token("severity-error"),
      "editorWarning.foreground": token("severity-warning"),
      "editorInfo.foreground": token("severity-info"),
      "editorGutter.background": token("bg-panel"),
      "editorOverviewRuler.border": "#00000000",
      "scrollbar.shadow": "#00000000",
      focusBorder: token("focus"),
    },
  });
  editor.setTheme(THEME);
}

// The build shortens #ffffff to #fff, which Monaco does not accept.
function sixDigits(colour: string): string {
  return colour.length === 4 ? colour.replace(/[^#]/g, "$&$&") : colour;
}

// Colours by nesting depth would be more prominent than the syntax and the states.
function brackets(colour: string): Record<string, string> {
  return Object.fromEntries([1, 2, 3, 4, 5, 6].map((depth) => [`editorBracketHighlight.foreground${depth}`, colour]));
}

paint();
usePrefs.subscribe(paint);

/** Popups of all editors live in one element of the page, so that panels do not cut them off. */
const popups = document.createElement("div");
popups.className = "monaco-editor editor-popups";
document.body.append(popups);

export const options: editor.IStandaloneEditorConstructionOptions = {
  language: LANGUAGE,
  theme: THEME,
  automaticLayout: true,
  fixedOverflowWidgets: true,
  overflowWidgetsDomNode: popups,
  wordBasedSuggestions: "off",
  quickSuggestions: { other: true, comments: false, strings: false },
  acceptSuggestionOnCommitCharacter: false,
  // The editor inserts only what is typed: it completes, closes and indents nothing unless somebody asks for it (`tab.ts`).
  suggest: { selectionMode: "never" },
  autoClosingBrackets: "never",
  autoClosingQuotes: "never",
  autoClosingComments: "never",
  autoIndent: "none",
  minimap: { enabled: false },
  stickyScroll: { enabled: false },
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

export type { IPosition, IRange } from "monaco-editor/editor";
export { Emitter, editor, KeyCode, KeyMod, languages, MarkerSeverity, Uri } from "monaco-editor/editor";
