import { useVirtualizer } from "@tanstack/react-virtual";
import { type KeyboardEvent, type MouseEvent, useEffect, useId, useMemo, useRef, useState } from "react";
import { baseName } from "../../../../logic/format/paths";
import { type Drawn, layOut } from "../../../../logic/graphic/ladderLayout";
import { elementIn, holds, inText } from "../../../../logic/graphic/places";
import { actionOf, type DrawnPart, heightOf, Sheet, spotsOf, stepIn } from "../../../../logic/graphic/sheet";
import { type Twice, writtenTwice } from "../../../../logic/graphic/writers";
import { pouAt } from "../../../../logic/plc/sourceLines";
import { useDebug } from "../../../../store/debug/debug";
import { seenAsNow } from "../../../../store/debug/seenAs";
import { showAs, useViewOf } from "../../../../store/graphic/views";
import { saveFile } from "../../../../store/page/download";
import { openFile, useNavigation } from "../../../../store/page/navigate";
import { useMembers } from "../../../../store/plc/members";
import { useDocuments } from "../../../../store/project/documents";
import { shownText } from "../../../../store/project/shownProgram";
import { t } from "../../../../text";
import { Icon } from "../../../../ui/Icon";
import "./graphic.css";
import { useHaltedLine } from "../halt";
import { elementBeside, moved, sameElement } from "./cursor";
import { FlowNote } from "./FlowNote";
import { marksOf, togglePart } from "./marks";
import { NameField } from "./NameField";
import { PartRow } from "./PartRow";
import { svgFile } from "./svgFile";
import { type Cursor, useEditing } from "./useEditing";

/** Marks, number and margins left and right of a drawing. */
const BESIDE = 22 + 34 + 20 + 18;

const NONE: readonly Twice[] = [];

interface Props {
  path: string;
  text: string;
  /** The text of the past cannot be changed. */
  readOnly: boolean;
}

/** The ladders, function block diagrams and charts of a file, drawn: a second view of its text. */
export default function GraphicView({ path, text, readOnly }: Props) {
  const sheet = useRef<HTMLDivElement>(null);
  const parts = useRef(new Sheet());
  const [width, setWidth] = useState(640);
  const [cursor, setCursor] = useState<Cursor>({ rung: 0, place: [0] });
  const id = useId();
  const view = useViewOf(path, text);
  useDocuments(({ pous }) => pous);
  const breakpoints = useDebug((debug) => debug.breakpoints);
  const halt = useHaltedLine(path);
  const room = Math.max(320, width - BESIDE);
  const drawn = useMemo(() => parts.current.of(text, room), [text, room]);
  const pous = shownText(path).pous;

  const twice = useMemo(
    () =>
      writtenTwice(drawn.map((each) => ({ drawn: each, pou: pouAt(pous, path, each.found.line, text)?.name ?? "" }))),
    [drawn, pous, path, text],
  );

  useEffect(() => {
    if (!sheet.current) return;
    const observer = new ResizeObserver(([entry]) => entry && setWidth(Math.floor(entry.contentRect.width)));
    observer.observe(sheet.current);
    return () => observer.disconnect();
  }, []);

  const editing = useEditing(path, drawn, readOnly, go);
  const { naming } = editing;
  const named = useMemo(() => naming && layOut(naming.path, room), [naming, room]);
  const heightAt = (index: number) => {
    const rung = drawn[index];
    if (!rung) return 0;
    return heightOf(naming?.rung === index ? { ...rung, drawing: named } : rung);
  };
  const virtual = useVirtualizer({
    count: drawn.length,
    getScrollElement: () => sheet.current,
    estimateSize: heightAt,
    overscan: 4,
  });
  // biome-ignore lint/correctness/useExhaustiveDependencies: the heights follow from what is drawn
  useEffect(() => virtual.measure(), [drawn, named]);

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
    virtual.scrollToIndex(to.rung);
  }

  // Keys of the whole page, like F9, mean the element at the cursor.
  function look(): void {
    if (!sheet.current?.contains(document.activeElement)) return;
    useDocuments.setState({ cursor: { ...placeInText(drawn[cursor.rung], cursor), element: true }, active: path });
  }
  // biome-ignore lint/correctness/useExhaustiveDependencies: an edit moves the element in the text
  useEffect(look, [cursor, drawn]);

  // A chart is higher than the window, and a rung may be wider: its element is scrolled to, not only its part.
  useEffect(() => {
    const key = `${id}${cursor.rung}-${cursor.place.join(".")}`;
    document.getElementById(key)?.scrollIntoView({ block: "nearest", inline: "nearest" });
  }, [cursor, id]);

  function toText(): void {
    showAs(path, "both");
    const { line, column } = placeInText(drawn[cursor.rung], cursor);
    openFile(path, line, column);
  }

  function toFile(): void {
    const written = svgFile(drawn, ({ found, kind }) => {
      const { label, title } = found.head;
      const pou = pouAt(pous, path, found.line, text)?.name ?? "";
      const of = kind === "chart" ? "" : `${pou} ${drawn.findIndex((each) => each.found === found) + 1}`;
      return [of, label && `${label}:`, kind === "chart" ? pou : title].filter(Boolean).join("  ");
    });
    saveFile(new Blob([written], { type: "image/svg+xml" }), `${baseName(path).replace(/\.\w+$/, "")}.svg`);
  }

  function onKeyDown(event: KeyboardEvent): void {
    if (event.altKey || event.metaKey) return;
    const to = moved(event, cursor, drawn);
    if (to) go(to);
    else if (!editing.onKey(event, cursor)) return;
    event.preventDefault();
  }

  function onClick({ target: on }: MouseEvent): void {
    if (!(on instanceof Element)) return;
    const rung = on.closest<HTMLElement>("[data-index]");
    if (!rung) return;
    const hit = on.closest<SVGElement>("[data-element]")?.dataset.element;
    const index = Number(rung.dataset.index);
    const clicked = drawn[index];
    if (clicked && on.closest(".g")) {
      togglePart(path, clicked, placeInText(clicked, { rung: index, place: [0] }));
      return;
    }
    const goal = on.closest<SVGElement>("[data-goal]")?.dataset.goal;
    const step = goal === undefined ? undefined : stepIn(clicked, goal);
    setCursor({ rung: index, place: step ?? (hit === undefined ? [] : hit.split(".").map(Number)) });
  }

  function field(drawing: { elements: readonly Drawn[] }, pou: string | undefined) {
    const element = drawing.elements.find((each) => naming && sameElement(each.place, naming.place));
    if (!naming || !element) return null;
    const { of } = useMembers.getState();
    const own = pou === undefined ? undefined : of.get(seenAsNow(pou) ?? "");
    const names = [...(own ?? []), ...(of.get("") ?? [])].filter(({ type }) => type === "BOOL").map(({ name }) => name);
    const leave = () => {
      editing.leave();
      sheet.current?.focus();
    };
    return (
      <NameField
        key={naming.place.join(".")}
        drawn={element}
        names={[...new Set(names)]}
        onLeave={leave}
        onTake={(made, onwards) => {
          editing.take(made);
          go({ rung: naming.rung, place: onwards ? elementBeside(drawing, naming.place) : naming.place });
          sheet.current?.focus();
        }}
      />
    );
  }

  const cursorPart = drawn[cursor.rung];
  const cursorPou =
    cursorPart && pouAt(pous, path, (actionOf(drawn, cursorPart)?.chart ?? cursorPart).found.line, text);
  const editable = drawn[cursor.rung]?.kind === "rung";
  const active = spotsOf(drawn[cursor.rung]).find((each) => sameElement(each.place, cursor.place));
  return (
    <div className="graphicview">
      <div
        ref={sheet}
        className="sheet"
        role="listbox"
        tabIndex={0}
        aria-label={t("graphic.of", { path })}
        aria-activedescendant={active ? `${id}${cursor.rung}-${active.place.join(".")}` : undefined}
        onKeyDown={onKeyDown}
        onFocus={look}
        onClick={onClick}
        onDoubleClick={({ target: on }) => on instanceof Element && on.closest(".netbody") && toText()}
        data-pane="ladder"
      >
        <div style={{ height: virtual.getTotalSize(), position: "relative" }}>
          {virtual.getVirtualItems().map((item) => {
            const rung = drawn[item.index];
            if (!rung) return null;
            const action = actionOf(drawn, rung);
            // An action has the variables of its chart.
            const pou = pouAt(pous, path, (action?.chart ?? rung).found.line, text);
            return (
              <div
                key={item.key}
                data-index={item.index}
                className="netplace"
                style={{ transform: `translateY(${item.start}px)`, height: item.size }}
              >
                <PartRow
                  path={path}
                  part={rung}
                  number={item.index + 1}
                  action={action?.name ?? null}
                  pou={pou}
                  id={`${id}${item.index}`}
                  cursor={cursor.rung === item.index ? cursor.place : null}
                  naming={
                    naming?.rung === item.index && named ? { drawing: named, field: field(named, pou?.name) } : null
                  }
                  twice={twice[item.index] ?? NONE}
                  marks={marksOf(rung, path, breakpoints, halt)}
                />
              </div>
            );
          })}
        </div>
      </div>
      <div className="netnote faint">
        <FlowNote path={path} part={drawn[cursor.rung]} place={cursor.place} pou={cursorPou} />
        <span className="cut grow" role="status">
          {editing.refused || t(readOnly ? "graphic.readonly" : editable ? "graphic.keys" : "graphic.keys.look")}
        </span>
        <button type="button" className="btn quiet sm" title={t("graphic.svg.hint")} onClick={toFile}>
          <Icon name="export" small />
          {t("graphic.svg")}
        </button>
      </div>
    </div>
  );
}

/** Where the element at the cursor begins in the file. */
function placeInText(part: DrawnPart | undefined, { place }: Cursor): { line: number; column: number } {
  if (!part) return { line: 1, column: 1 };
  return inText(part, spotsOf(part).find((each) => sameElement(each.place, place))?.element.span.at ?? 0);
}
