import {
  type ClipboardEvent,
  type KeyboardEvent,
  type MouseEvent,
  useCallback,
  useEffect,
  useId,
  useLayoutEffect,
  useMemo,
  useRef,
  useState,
} from "react";
import { baseName } from "../../../../logic/format/paths";
import { type Around, instancesIn, namesIn } from "../../../../logic/graphic/edit";
import { PIN } from "../../../../logic/graphic/keys";
import { elementIn, holds, inText } from "../../../../logic/graphic/places";
import { actionOf, type DrawnPart, Sheet, stopsOf } from "../../../../logic/graphic/sheet";
import { type Twice, writtenTwice } from "../../../../logic/graphic/writers";
import { ownerOf, pouAt } from "../../../../logic/plc/sourceLines";
import { useDebug } from "../../../../store/debug/debug";
import { boxesNow, loadBoxes } from "../../../../store/graphic/boxes";
import { showAs, useViewOf } from "../../../../store/graphic/views";
import { saveFile } from "../../../../store/page/download";
import { openFile, useNavigation } from "../../../../store/page/navigate";
import { useDocuments } from "../../../../store/project/documents";
import { shownText, useShownProgram } from "../../../../store/project/shownProgram";
import { useVerifyRows } from "../../../../store/verify/verifyRows";
import { t } from "../../../../text";
import type { Pou, Problem } from "../../../../wire/types";
import "./graphic.css";
import { useHaltedLine } from "../halt";
import { type Cursor, elementBeside, moved, sameElement } from "./cursor";
import { ElementField } from "./ElementField";
import { Foot } from "./Foot";
import { cursorAt, emptyAfter, isInSight, pinAt, placeInText, rangeInText } from "./find";
import { isUnbuilt } from "./followFlow";
import { marksOf, togglePart } from "./marks";
import { notesOf } from "./Notes";
import { type Operand, operandAt, pressOperand } from "./operand";
import { PartRow } from "./PartRow";
import { layOnPaper, PAPER, usePrinted } from "./printed";
import { Rename } from "./Rename";
import { rowKey } from "./reopened";
import { sheetOf } from "./sheets";
import { svgFile } from "./svgFile";
import { useCaret } from "./useCaret";
import { useChosen } from "./useChosen";
import { useDrag } from "./useDrag";
import { useDrawingMenu } from "./useDrawingMenu";
import { keyOf, useEditing } from "./useEditing";
import { keepHeadings, placeOf, roomIn, useRows } from "./useRows";
import { wrongIn } from "./wrong";

const NONE: readonly Twice[] = [];
const NO_PROBLEMS: readonly Problem[] = [];

interface Props {
  path: string;
  text: string;
  /** The text of the past cannot be changed. */
  readOnly: boolean;
}

/** The ladders, function block diagrams and charts of a file, drawn: a second view of its text. */
export default function GraphicView({ path, text, readOnly }: Props) {
  const sheet = useRef<HTMLDivElement>(null);
  const parts = useRef(sheetOf(path));
  /** Known when it is in the page: what is drawn before would be drawn twice. */
  const [width, setWidth] = useState<number | null>(null);
  const [wanted, setCursor] = useState<Cursor>({ rung: 0, place: [0] });
  const [renaming, setRenaming] = useState<Operand | null>(null);
  const id = useId();
  const view = useViewOf(path, text);
  useDocuments(({ pous }) => pous);
  // What was built is known then.
  useShownProgram();
  const problems = useDocuments((documents) => (readOnly ? NO_PROBLEMS : documents.problems));
  const breakpoints = useDebug((debug) => debug.breakpoints);
  const halt = useHaltedLine(path);
  const verified = useVerifyRows(({ selected, byIndex }) =>
    selected === null ? null : (byIndex.get(selected) ?? null),
  );
  const { room, headRoom } = roomIn(width ?? 0);
  const measured = width !== null;
  const drawn = useMemo(() => (measured ? parts.current.of(text, room) : []), [text, room, measured]);
  // Its rung may have been taken back, or deleted by somebody else.
  const cursor = useMemo(
    () => (drawn.length > 0 && wanted.rung >= drawn.length ? { rung: drawn.length - 1, place: [] } : wanted),
    [wanted, drawn.length],
  );
  const pous = shownText(path).pous;

  const twice = useMemo(
    () =>
      writtenTwice(drawn.map((each) => ({ drawn: each, pou: pouAt(pous, path, each.found.line, text)?.name ?? "" }))),
    [drawn, pous, path, text],
  );

  useLayoutEffect(() => {
    if (!sheet.current) return;
    setWidth(sheet.current.clientWidth || 640);
    const observer = new ResizeObserver(([entry]) => entry && setWidth(Math.floor(entry.contentRect.width)));
    observer.observe(sheet.current);
    return () => observer.disconnect();
  }, []);

  const around = (): Around => {
    const boxes = boxesNow(path);
    const written = instancesIn(text, boxes);
    const others = boxes.filter(({ name }) => written.every((each) => each.name.toUpperCase() !== name.toUpperCase()));
    return { boxes: [...written, ...others], names: namesIn(text) };
  };
  const network = drawn.find(({ kind }) => kind === "network");
  // biome-ignore lint/correctness/useExhaustiveDependencies: once, when there is a network
  useEffect(() => {
    if (network) void loadBoxes(path, inText(network, network.found.body.at));
  }, [path, network === undefined]);
  const editing = useEditing({ path, drawn, readOnly, go, around });
  const { begin } = editing;
  const choosing = useChosen({ path, drawn, readOnly, go, begin, around });
  const { chosen } = choosing;
  const drag = useDrag({ path, drawn, readOnly, chosen, go, begin, around });
  const { named } = editing;
  const { virtual, preview, rowAt } = useRows({ drawn, named: named?.lost ? null : named, width: width ?? 0, sheet });

  const target = useNavigation((navigation) => navigation.place);
  const turn = useRef(target?.turn);
  useEffect(() => {
    if (!target || target.path !== path || target.turn === turn.current) return;
    turn.current = target.turn;
    // The rungs of an action come after their chart, which holds their lines, too.
    const at = drawn.findLastIndex((part) => holds(part, target.line));
    const opened = pous.some((pou) => pou.file === path && pou.line === target.line);
    const part = drawn[at];
    if (part) go({ rung: at, place: elementIn(part, { line: target.line, column: target.column ?? 1 }) ?? [0] });
    // A variable's declaration is in the text only; who opens a POU looks at its rungs.
    else if (view === "graphic" && !opened) showAs(path, "both");
  });

  function go(to: Cursor): void {
    setCursor(to);
    // To scroll makes the browser lay the page out: an edit of what is in sight needs none of that.
    if (!isInSight(virtual, to.rung)) virtual.scrollToIndex(to.rung);
  }

  // Keys of the whole page, like F9, mean the element at the cursor.
  function look(): void {
    if (!sheet.current?.contains(document.activeElement)) return;
    const [begin, element] = rangeInText(drawn[cursor.rung], cursor);
    useDocuments.setState({ cursor: { ...begin, element }, active: path });
  }
  // biome-ignore lint/correctness/useExhaustiveDependencies: an edit moves the element in the text
  useEffect(look, [cursor, drawn]);

  // A chart is higher than the window, and a rung may be wider: its element is scrolled to, not only its part.
  const cursorKey = `${id}${cursor.rung}-${cursor.place.join(".")}`;
  useEffect(() => {
    document.getElementById(cursorKey)?.scrollIntoView({ block: "nearest", inline: "nearest" });
  }, [cursorKey]);

  useCaret({ path, drawn, cursor, beside: view === "both", sheet }, (to) => {
    choosing.clear();
    go(to);
  });

  function toText(): void {
    showAs(path, "both");
    const { line, column } = placeInText(drawn[cursor.rung], cursor);
    openFile(path, line, column);
  }

  /** The headline of a part on paper, which has no page around it. */
  const headlineIn =
    (all: readonly DrawnPart[]) =>
    ({ found, kind }: DrawnPart) => {
      const { label, title } = found.head;
      const pou = pouAt(pous, path, found.line, text)?.name ?? "";
      const of = kind === "chart" ? "" : `${pou} ${all.findIndex((each) => each.found === found) + 1}`;
      return [of, label && `${label}:`, kind === "chart" ? pou : title].filter(Boolean).join("  ");
    };

  usePrinted(() => {
    const all = new Sheet().of(text, PAPER);
    // A file whose tab is not shown is not what is printed.
    return sheet.current?.offsetParent ? layOnPaper(baseName(path), all, headlineIn(all)) : null;
  });

  function toFile(): void {
    const written = svgFile(drawn, headlineIn(drawn));
    saveFile(new Blob([written], { type: "image/svg+xml" }), `${baseName(path).replace(/\.\w+$/, "")}.svg`);
  }

  const take = (what: "copy" | "cut", at: Cursor) => (chosen ? choosing[what]() : editing[what](at));
  const idOf = ({ rung, place }: Cursor) => `${id}${rung}-${place.join(".")}`;
  const context = useDrawingMenu(
    { path, drawn, readOnly, sheet, idOf },
    {
      ...{ choosing, editing, press, take },
      go: (to) => {
        choosing.clear();
        setCursor(to);
      },
    },
  );

  function onKeyDown(event: KeyboardEvent): void {
    if (!event.metaKey && doesKey(event)) event.preventDefault();
  }

  function doesKey(event: KeyboardEvent): boolean {
    if (context.byKey(event, cursor) || choosing.byKey(event, cursor)) return true;
    const to = moved(event, cursor, drawn);
    if (!to) return press(keyOf(event), cursor);
    choosing.clear();
    go(to);
    return true;
  }

  /** Does what a key does, whoever pressed it. False where it does nothing. */
  function press(key: string, at: Cursor): boolean {
    const part = drawn[at.rung];
    if (key === "Ctrl+F2") setRenaming(readOnly ? null : operandAt(part, at.place));
    else return pressOperand(key, path, part, at.place) || choosing.press(key) || editing.press(key, at);
    return true;
  }

  /** What is copied in a field is its text, and no business of the drawing. */
  function onClipboard(event: ClipboardEvent, what: "copy" | "cut"): void {
    if (event.target instanceof HTMLInputElement) return;
    const text = take(what, cursor);
    if (text === null) return;
    event.clipboardData.setData("text/plain", text);
    event.preventDefault();
  }

  function onPaste(event: ClipboardEvent): void {
    if (event.target instanceof HTMLInputElement) return;
    event.preventDefault();
    editing.put(cursor, event.clipboardData.getData("text/plain"));
  }

  function onDoubleClick(event: MouseEvent): void {
    const { target: on } = event;
    if (!(on instanceof Element) || !on.closest(".netbody")) return;
    const pin = cursorPart && pinAt(cursorPart, event);
    if (pin && editing.press(`${PIN}${pin.pin}`, { rung: cursor.rung, place: pin.place })) return;
    if (!on.closest("[data-element]") || !editing.press("F2", cursor)) toText();
  }

  /** Whether what was typed into the field was taken; `onwards` opens the next one. */
  function takeName(typed: string, onwards: boolean): boolean {
    const at = named?.rung ?? 0;
    const made = editing.take(typed);
    if (!made) return false;
    // The field that opens next takes the focus; a blur of this one would close it.
    if (made.naming) return true;
    const found = drawn[at]?.found;
    const next = onwards && found ? emptyAfter(found, made.text, made.place) : null;
    if (next && editing.press(next.key, { rung: at, place: next.place }, made.text)) return true;
    if (onwards && preview) go({ rung: at, place: elementBeside({ elements: stopsOf(preview) }, made.place) });
    sheet.current?.focus();
    return true;
  }

  const takeNow = useRef(takeName);
  takeNow.current = takeName;

  function onClick(event: MouseEvent): void {
    const { target: on } = event;
    if (!(on instanceof Element)) return;
    const rung = on.closest<HTMLElement>("[data-index]");
    if (!rung) return;
    const index = Number(rung.dataset.index);
    const clicked = drawn[index];
    if (clicked && on.closest(".g")) {
      togglePart(path, clicked, placeInText(clicked, { rung: index, place: [0] }));
      return;
    }
    const to = cursorAt(drawn, event);
    if (!to) return;
    if (event.shiftKey) choosing.extend(chosen?.anchor ?? cursor, to);
    else if (event.ctrlKey || event.metaKey) choosing.toggle(cursor, to);
    else {
      choosing.clear();
      setCursor(to);
    }
  }

  function leave(): void {
    editing.leave();
    sheet.current?.focus();
  }

  const cursorPart = drawn[cursor.rung];
  /** The POU whose variables a part has. */
  function pouOf(part: DrawnPart): Pou | undefined {
    const found = pouAt(pous, path, (actionOf(drawn, part)?.chart ?? part).found.line, text);
    return found && ownerOf(pous, found);
  }
  const cursorPou = cursorPart && pouOf(cursorPart);
  function tool(key: string): void {
    if (!named) sheet.current?.focus();
    if (!choosing.press(key)) editing.press(key, cursor);
  }

  const toolNow = useRef(tool);
  toolNow.current = tool;
  const onTool = useCallback((key: string) => toolNow.current(key), []);

  function renamed(): void {
    setRenaming(null);
    sheet.current?.focus();
  }

  const kind = cursorPart?.kind ?? "rung";
  const wrongHere = cursorPart ? wrongIn(cursorPart, path, problems) : [];
  const wrongAtCursor = wrongHere.find(({ place }) => place === cursor.place.join(".")) ?? null;
  const active = stopsOf(rowAt(cursor.rung)?.part).find((each) => sameElement(each.place, cursor.place));
  return (
    <div className="graphicview">
      <div
        ref={sheet}
        className="sheet"
        role="listbox"
        tabIndex={0}
        aria-multiselectable
        aria-label={t("graphic.of", { path })}
        aria-activedescendant={active ? `${id}${cursor.rung}-${active.place.join(".")}` : undefined}
        onKeyDown={onKeyDown}
        onCopy={(event) => onClipboard(event, "copy")}
        onCut={(event) => onClipboard(event, "cut")}
        onPaste={onPaste}
        onFocus={look}
        onClick={onClick}
        onContextMenu={context.onContextMenu}
        onPointerDown={drag.onPointerDown}
        onPointerMove={drag.onPointerMove}
        onPointerUp={drag.onPointerUp}
        onPointerLeave={drag.onPointerLeave}
        onDoubleClick={onDoubleClick}
        onScroll={(event) => keepHeadings(event.currentTarget)}
        data-pane="ladder"
      >
        <div style={{ height: virtual.getTotalSize(), position: "relative" }}>
          {virtual.getVirtualItems().map((item) => {
            const rung = drawn[item.index];
            const row = rowAt(item.index);
            if (!rung || !row) return null;
            const { part, head, scale } = row;
            const open = named?.rung === item.index ? named : null;
            const action = actionOf(drawn, rung);
            const pou = pouOf(rung);
            return (
              <div
                key={rowKey(item.index, named)}
                data-index={item.index}
                className="netplace"
                style={placeOf(row, item.start, item.size, open !== null)}
              >
                <PartRow
                  path={path}
                  part={part}
                  number={item.index + 1}
                  head={head}
                  room={headRoom}
                  scale={scale}
                  action={action?.name ?? null}
                  pou={pou}
                  id={`${id}${item.index}`}
                  cursor={cursor.rung === item.index ? cursor.place : null}
                  field={
                    open ? (
                      <ElementField
                        path={path}
                        written={rung}
                        part={part}
                        scale={scale}
                        named={open}
                        around={around}
                        onTake={(typed, onwards) => takeNow.current(typed, onwards)}
                        onLeave={leave}
                      />
                    ) : null
                  }
                  twice={twice[item.index] ?? NONE}
                  verified={verified}
                  unbuilt={pou !== undefined && isUnbuilt(rung, path)}
                  wrong={wrongIn(rung, path, problems)}
                  chosen={chosen?.parts.includes(item.index) ? chosen.places : null}
                  drop={drag.dropIn(item.index)}
                  target={drag.targetIn(item.index)}
                  marks={marksOf(rung, path, breakpoints, halt)}
                />
              </div>
            );
          })}
        </div>
      </div>
      {context.menu}
      {renaming && <Rename path={path} operand={renaming} onClose={renamed} />}
      <Foot
        path={path}
        kind={kind}
        readOnly={readOnly}
        part={cursorPart}
        place={cursor.place}
        pou={cursorPou}
        refused={editing.refused}
        wrong={wrongAtCursor}
        notes={cursorPart ? notesOf(cursorPart, wrongHere, twice[cursor.rung] ?? NONE) : []}
        onPress={onTool}
        onFile={toFile}
      />
    </div>
  );
}
