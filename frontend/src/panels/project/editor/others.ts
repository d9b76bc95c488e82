/** The carets and selections of others in a file, and one's own for them. */
import { useDocuments } from "../../../store/project/documents";
import { sharedText } from "../../../store/project/drafts";
import { othersOf, tellHere, usePeople } from "../../../store/project/people";
import type { Person } from "../../../wire/types";
import { editor, type IPosition, type ISelection } from "./monaco";
import "./others.css";

const { ABOVE, BELOW } = editor.ContentWidgetPositionPreference;

interface Flag extends editor.IContentWidget {
  at: IPosition;
  element: HTMLElement;
  quiet?: ReturnType<typeof setTimeout>;
}

/** The flag of somebody who has not moved for so long, in ms, covers less of the text. */
const QUIET = 3000;

/** Returns a function that ends it. */
export function showOthers(code: editor.IStandaloneCodeEditor, path: string): () => void {
  const marks = code.createDecorationsCollection();
  const flags = new Map<number, Flag>();
  let revealed = "";

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
  const stops = [
    usePeople.subscribe(show),
    useDocuments.subscribe((now, before) => now.active !== before.active && tell()),
  ];
  return () => {
    moved.dispose();
    typed.dispose();
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

/** The name at the caret. */
function fly(code: editor.IStandaloneCodeEditor, flags: Map<number, Flag>, person: Person, at: IPosition): void {
  const { id, name, colour } = person;
  const known = flags.get(id);
  if (known) {
    if (known.at.lineNumber !== at.lineNumber || known.at.column !== at.column) unfurl(known, person);
    known.at = at;
    code.layoutContentWidget(known);
    return;
  }
  const element = document.createElement("div");
  element.className = `othername person${colour}`;
  element.title = name;
  const flag: Flag = {
    at,
    element,
    getId: () => `scanbench.other.${id}`,
    getDomNode: () => element,
    getPosition: () => ({ position: flag.at, preference: [ABOVE, BELOW] }),
  };
  flags.set(id, flag);
  unfurl(flag, person);
  code.addContentWidget(flag);
}

/** The whole name for a while, then the initials. */
function unfurl(flag: Flag, { name, initials }: Person): void {
  clearTimeout(flag.quiet);
  flag.element.textContent = name;
  flag.quiet = setTimeout(() => {
    flag.element.textContent = initials;
  }, QUIET);
}
