/** The carets and selections of others in a file, and one's own for them. */
import { useDocuments } from "../../../store/project/documents";
import { sharedText } from "../../../store/project/drafts";
import { othersOf, tellHere, usePeople } from "../../../store/project/people";
import type { Person } from "../../../wire/types";
import { editor, type IPosition, type ISelection } from "./monaco";
import "./others.css";

const { EXACT } = editor.ContentWidgetPositionPreference;

interface Flag extends editor.IContentWidget {
  at: IPosition;
  element: HTMLElement;
  quiet?: ReturnType<typeof setTimeout>;
}

/** For so long, in ms, the name of somebody who moved is shown. */
const SHOWN = 1000;

/** Returns a function that ends it. */
export function showOthers(code: editor.IStandaloneCodeEditor, path: string): () => void {
  const marks = code.createDecorationsCollection();
  const flags = new Map<number, Flag>();
  let revealed = "";

  /** The mouse is at the caret of somebody: their name is shown for as long. */
  const hover = ({ target }: editor.IEditorMouseEvent) => {
    const { position } = target;
    for (const { at, element } of flags.values())
      element.classList.toggle("hovered", position !== null && isNear(position, at));
  };

  const show = () => {
    const here = othersOf(usePeople.getState()).filter(({ file }) => file === path);
    const drawn = here.flatMap((person) => selectionOf(code, path, person) ?? []);
    marks.set(drawn.flatMap(decorations));
    for (const [id, flag] of flags) {
      if (drawn.some(({ person }) => person.id === id)) continue;
      code.removeContentWidget(flag);
      flags.delete(id);
    }
    for (const { person, head } of drawn) fly(code, flags, person, head);
    follow();
  };

  /** Scrolls to where somebody is whom one follows, whenever they move. */
  const follow = () => {
    const { people, following } = usePeople.getState();
    const person = people.find(({ id }) => id === following);
    if (!person || person.file !== path || person.line === null) return;
    const now = `${person.id} ${person.line}`;
    if (now !== revealed) code.revealLineInCenterIfOutsideViewport(person.line);
    revealed = now;
  };

  const tell = () => {
    const selection = code.getSelection();
    if (useDocuments.getState().active === path && selection) tellHere(placeOf(code, path, selection));
  };

  show();
  tell();
  const moved = code.onDidChangeCursorSelection(tell);
  const typed = code.onDidChangeModelContent(show);
  const pointed = code.onMouseMove(hover);
  const stops = [
    usePeople.subscribe(show),
    useDocuments.subscribe((now, before) => now.active !== before.active && tell()),
  ];
  return () => {
    moved.dispose();
    typed.dispose();
    pointed.dispose();
    for (const stop of stops) stop();
    for (const flag of flags.values()) code.removeContentWidget(flag);
    marks.clear();
  };
}

function placeOf(code: editor.IStandaloneCodeEditor, file: string, selection: ISelection) {
  const { selectionStartLineNumber, selectionStartColumn, positionLineNumber: line, positionColumn } = selection;
  const shared = sharedText(file);
  const model = code.getModel();
  if (!shared || !model) return { file, line, anchor: null, head: null };
  const mark = (lineNumber: number, column: number) => shared.mark(model.getOffsetAt({ lineNumber, column }));
  return { file, line, anchor: mark(selectionStartLineNumber, selectionStartColumn), head: mark(line, positionColumn) };
}

interface Drawn {
  person: Person;
  start: IPosition;
  end: IPosition;
  head: IPosition;
}

/** Null where it is in text that has not come yet. */
function selectionOf(code: editor.IStandaloneCodeEditor, path: string, person: Person): Drawn | null {
  const shared = sharedText(path);
  const model = code.getModel();
  if (!shared || !model || !person.anchor || !person.head) return null;
  const [anchor, head] = [shared.offsetOf(person.anchor), shared.offsetOf(person.head)];
  if (anchor === null || head === null) return null;
  const at = (offset: number) => model.getPositionAt(offset);
  return { person, start: at(Math.min(anchor, head)), end: at(Math.max(anchor, head)), head: at(head) };
}

function decorations({ person, start, end, head }: Drawn): editor.IModelDeltaDecoration[] {
  const colour = `person${person.colour}`;
  const range = (from: IPosition, to: IPosition) => ({
    startLineNumber: from.lineNumber,
    startColumn: from.column,
    endLineNumber: to.lineNumber,
    endColumn: to.column,
  });
  const caret = {
    range: range(head, head),
    options: { className: `othercaret ${colour}`, hoverMessage: { value: person.name } },
  };
  return [{ range: range(start, end), options: { className: `otherselection ${colour}` } }, caret];
}

/** Beside a caret, or at it. */
const isNear = (one: IPosition, other: IPosition) =>
  one.lineNumber === other.lineNumber && Math.abs(one.column - other.column) <= 1;

/** The name, in the line above the caret: beside what is typed there, not over it. */
function fly(code: editor.IStandaloneCodeEditor, flags: Map<number, Flag>, person: Person, at: IPosition): void {
  const { id, name, colour } = person;
  const known = flags.get(id);
  if (known) {
    if (known.at.lineNumber !== at.lineNumber || known.at.column !== at.column) unfurl(known);
    known.at = at;
    code.layoutContentWidget(known);
    return;
  }
  const element = document.createElement("div");
  element.className = `othername person${colour}`;
  element.textContent = name;
  const flag: Flag = {
    at,
    element,
    getId: () => `scanbench.other.${id}`,
    getDomNode: () => element,
    getPosition: () => ({ position: freeAt(code, flag.at), preference: [EXACT] }),
  };
  flags.set(id, flag);
  unfurl(flag);
  code.addContentWidget(flag);
}

/** Where the name covers no text: in the line above the caret, after its text; in the first line, after that of the caret. */
function freeAt(code: editor.IStandaloneCodeEditor, { lineNumber, column }: IPosition): IPosition {
  const line = Math.max(1, lineNumber - 1);
  const end = code.getModel()?.getLineMaxColumn(line) ?? 1;
  return { lineNumber: line, column: Math.max(end, lineNumber > 1 ? column : 1) };
}

/** The name is shown for a moment. */
function unfurl(flag: Flag): void {
  clearTimeout(flag.quiet);
  flag.element.classList.add("moved");
  flag.quiet = setTimeout(() => flag.element.classList.remove("moved"), SHOWN);
}
