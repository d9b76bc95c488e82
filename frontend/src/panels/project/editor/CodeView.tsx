import { useEffect, useRef, useState } from "react";
import { createPortal } from "react-dom";
import { pouAt } from "../../../logic/plc/sourceLines";
import { editBreakpoint, useDebug } from "../../../store/debug/debug";
import { useNavigation } from "../../../store/page/navigate";
import { usePrefs } from "../../../store/page/prefs";
import { build, save, useDocuments } from "../../../store/project/documents";
import { shownText } from "../../../store/project/shownProgram";
import { t } from "../../../text";
import { useMenu } from "../../../ui/Menu";
import { BreakpointForm } from "./BreakpointForm";
import "./checks";
import "./completion";
import { markCoverage } from "./coverage";
import "./debug.css";
import { addCallsAction } from "./callsAction";
import { addCrossAction } from "./crossAction";
import { addDebugActions } from "./debugActions";
import { addDisturbAction } from "./disturbAction";
import { offerEditorCommands } from "./editorCommands";
import { markElement } from "./elementMark";
import "./fixes";
import { type Gutter, showBreakpoints } from "./gutter";
import { lineMenu } from "./gutterMenu";
import { markHalt } from "./halt";
import "./hints";
import "./hover";
import { indentTyped } from "./indent";
import { showInlineValues } from "./inlineValues";
import "./layout";
import { showLenses } from "./lenses";
import { modelOf, pastModel } from "./models";
import { editor, KeyCode, KeyMod, monospaceFont, options } from "./monaco";
import "./navigation";
import { formatTyped } from "./onType";
import { showOthers } from "./others";
import { markReaction } from "./reaction";
import "./rename";
import "./semanticTokens";
import "./signatures";
import { addTabActions } from "./tab";
import { markTrap } from "./trap";
import { addVerifyAction } from "./verifyAction";
import { addWatchAction, dragToWatch } from "./watchAction";
import { addWriterAction } from "./writerAction";
import { openZone, type Zone } from "./zone";

/** The view state of a text before it was replaced by the text of the past. */
const left = new Map<string, editor.ICodeEditorViewState | null>();

/** The text of one file in Monaco; `past` is the text as it ran, which is read-only. */
export default function CodeView({ path, past }: { path: string; past: string | null }) {
  const host = useRef<HTMLDivElement>(null);
  const view = useRef<editor.IStandaloneCodeEditor | null>(null);
  const { open, menu } = useMenu(t("debug.menu"));

  useEffect(() => {
    const document = useDocuments.getState().open[path];
    if (!host.current || (past === null && !document)) return;
    const ran = past === null ? null : pastModel(path, past);
    const code = editor.create(host.current, {
      ...options,
      codeLens: usePrefs.getState().lenses,
      fontFamily: monospaceFont(),
      model: ran ?? modelOf(path, document?.text ?? ""),
      readOnly: ran !== null,
      readOnlyMessage: { value: t("past.text.readonly") },
      ariaLabel: t("editor.of", { path }),
    });
    view.current = code;
    if (ran === null && left.has(path)) code.restoreViewState(left.get(path) ?? null);
    if (ran === null) left.delete(path);
    // Who comes from the drawing, or moves in it, sees the line of its element.
    const unmarkElement = markElement(code, path);
    addActions(code, path);
    addTabActions(code);
    addWatchAction(code, path);
    addWriterAction(code, path);
    addCrossAction(code, path);
    addCallsAction(code, path);
    const noCommands = offerEditorCommands(code, path);
    const noDrag = dragToWatch(code, host.current, path);
    let gutter: Gutter | null = null;
    const openMenu = (line: number, at: { x: number; y: number }) => {
      if (!gutter) return;
      open(lineMenu({ path, line, built: gutter.built(line), here: gutter.at(line) }), at);
    };
    const breakpoints = showBreakpoints(code, path, openMenu);
    gutter = breakpoints;
    addVerifyAction(code, path);
    addDebugActions(code, path, () => breakpoints, openMenu);
    addDisturbAction(code, path, () => breakpoints);
    const caret = () => {
      const position = code.getPosition();
      // Replacing the text in a hidden tab moves its caret, too.
      // An edit of the drawing moves it, too, whose cursor is where it says.
      const { active, cursor } = useDocuments.getState();
      if (position && (code.hasTextFocus() || (active === path && !cursor?.element)))
        useDocuments.setState({ cursor: { line: position.lineNumber, column: position.column }, active: path });
    };
    code.onDidChangeCursorPosition(caret);
    code.onDidFocusEditorText(caret);
    caret();
    const unmark = markTrap(code, path);
    const unmarkReaction = markReaction(code, path);
    const unmarkHalt = markHalt(code, path);
    const unmarkCoverage = markCoverage(code, path);
    const hideValues = showInlineValues(code, path);
    const noLenses = showLenses(code);
    const hideOthers = ran === null ? showOthers(code, path) : null;
    const noIndent = ran === null ? indentTyped(code) : null;
    const noLayout = ran === null ? formatTyped(code, path) : null;
    const stop = useNavigation.subscribe(({ place }) => go(code, path, place));
    go(code, path, useNavigation.getState().place);
    return () => {
      stop();
      unmarkElement();
      unmark();
      unmarkReaction();
      unmarkHalt();
      unmarkCoverage();
      hideValues();
      noLenses();
      hideOthers?.();
      noIndent?.();
      noLayout?.();
      noDrag();
      noCommands();
      breakpoints.dispose();
      if (ran === null) left.set(path, code.saveViewState());
      code.dispose();
      ran?.dispose();
      view.current = null;
    };
  }, [path, past, open]);

  return (
    <>
      <div ref={host} className="codehost" />
      <Editing path={path} view={view} />
      {menu}
    </>
  );
}

/** The form of a breakpoint, below its line, while a breakpoint of this file is edited. */
function Editing({ path, view }: { path: string; view: { current: editor.IStandaloneCodeEditor | null } }) {
  const editing = useDebug((debug) => (debug.editing?.file === path ? debug.editing : null));
  const [zone, setZone] = useState<Zone | null>(null);
  useEffect(() => {
    if (!editing || !view.current) return;
    const opened = openZone(view.current, editing.line);
    setZone(opened);
    return () => {
      opened.dispose();
      setZone(null);
    };
  }, [editing, view]);
  if (!editing || !zone) return null;
  const { pous, text } = shownText(path);
  const pou = pouAt(pous, path, editing.line, text);
  const close = () => {
    editBreakpoint(null);
    view.current?.focus();
  };
  return createPortal(<BreakpointForm editing={editing} pou={pou?.name} onClose={close} />, zone.element);
}

let handledTurn = 0;

function go(
  code: editor.IStandaloneCodeEditor,
  path: string,
  place: ReturnType<typeof useNavigation.getState>["place"],
): void {
  if (!place || place.path !== path || place.turn === handledTurn) return;
  handledTurn = place.turn;
  const position = { lineNumber: place.line, column: place.column };
  code.setPosition(position);
  code.revealPositionInCenterIfOutsideViewport(position);
  code.focus();
}

function addActions(code: editor.IStandaloneCodeEditor, path: string): void {
  code.addAction({
    id: "scanbench.save",
    label: t("save"),
    keybindings: [KeyMod.CtrlCmd | KeyCode.KeyS],
    run: () => void save(path),
  });
  code.addAction({
    id: "scanbench.build",
    label: t("build"),
    keybindings: [KeyMod.CtrlCmd | KeyMod.Shift | KeyCode.KeyB],
    run: () => void build(),
  });
}
