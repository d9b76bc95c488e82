import { useVirtualizer } from "@tanstack/react-virtual";
import { type KeyboardEvent, type MouseEvent, useEffect, useId, useMemo, useRef, useState } from "react";
import { next, type Way } from "../../../../logic/graphic/near";
import { type DrawnRung, heightOf, Rungs } from "../../../../logic/graphic/rungs";
import { pouAt } from "../../../../logic/plc/sourceLines";
import { toggleBreakpoint, useDebug } from "../../../../store/debug/debug";
import { openFile, useNavigation } from "../../../../store/page/navigate";
import { useDocuments } from "../../../../store/project/documents";
import { showAs, useViewOf } from "../../../../store/project/graphicViews";
import { shownText } from "../../../../store/project/shownProgram";
import { t } from "../../../../text";
import { Icon } from "../../../../ui/Icon";
import "./graphic.css";
import { RungRow } from "./RungRow";

const GUTTER = 22 + 34 + 14 + 18;
const WAYS: Record<string, Way> = { ArrowLeft: "left", ArrowRight: "right", ArrowUp: "up", ArrowDown: "down" };

interface Cursor {
  rung: number;
  element: number;
}

/** The ladder diagrams of a file, drawn: a second view of its text. */
export default function GraphicView({ path, text }: { path: string; text: string }) {
  const sheet = useRef<HTMLDivElement>(null);
  const rungs = useRef(new Rungs());
  const [width, setWidth] = useState(640);
  const [cursor, setCursor] = useState<Cursor | null>(null);
  const id = useId();
  const view = useViewOf(path, text);
  useDocuments(({ pous }) => pous);
  const breakpoints = useDebug((debug) => debug.breakpoints);
  const drawn = useMemo(() => rungs.current.of(text, Math.max(320, width - GUTTER)), [text, width]);
  const pous = shownText(path).pous;

  useEffect(() => {
    if (!sheet.current) return;
    const observer = new ResizeObserver(([entry]) => entry && setWidth(Math.floor(entry.contentRect.width)));
    observer.observe(sheet.current);
    return () => observer.disconnect();
  }, []);

  const virtual = useVirtualizer({
    count: drawn.length,
    getScrollElement: () => sheet.current,
    estimateSize: (index) => (drawn[index] ? heightOf(drawn[index]) : 0),
    overscan: 4,
  });
  // biome-ignore lint/correctness/useExhaustiveDependencies: the heights follow from what is drawn
  useEffect(() => virtual.measure(), [drawn]);

  const place = useNavigation((navigation) => navigation.place);
  const turn = useRef(place?.turn);
  useEffect(() => {
    if (!place || place.path !== path || place.turn === turn.current) return;
    turn.current = place.turn;
    const at = drawn.findIndex(
      ({ found }) => linesOf(found.text) + found.line > place.line && found.line <= place.line,
    );
    // A place outside of the rungs, a declaration perhaps, is in the text only.
    if (at < 0) showAs(path, "both");
    else if (view !== "text") go({ rung: at, element: 0 });
  });

  function go(to: Cursor): void {
    setCursor(to);
    virtual.scrollToIndex(to.rung);
  }

  function toText({ rung, element }: Cursor): void {
    const found = drawn[rung]?.found;
    if (!found) return;
    showAs(path, "both");
    const { line, column } = placeOf(drawn[rung], element);
    openFile(path, line, column);
  }

  function onKeyDown(event: KeyboardEvent): void {
    if (event.altKey || event.metaKey) return;
    const now = cursor ?? { rung: 0, element: 0 };
    const handled = move(event, now, drawn, go) || act(event.key, now);
    if (handled) event.preventDefault();
  }

  function act(key: string, now: Cursor): boolean {
    if (key === "Enter" || key === "F2") toText(now);
    else if (key === "F9") void toggleBreakpoint(path, placeOf(drawn[now.rung], now.element).line);
    else return false;
    return true;
  }

  function onClick(event: MouseEvent): void {
    const hit = (event.target as Element).closest<SVGElement>("[data-element]");
    const rung = (event.target as Element).closest<HTMLElement>("[data-index]");
    if (!rung) return;
    const groups = hit ? [...rung.querySelectorAll("[data-element]")] : [];
    setCursor({ rung: Number(rung.dataset.index), element: hit ? groups.indexOf(hit) : 0 });
  }

  const active = cursor && drawn[cursor.rung]?.drawing?.elements[cursor.element];
  return (
    <div className="graphicview">
      {/* biome-ignore lint/a11y/useKeyWithClickEvents: the keys are those of the whole list */}
      <div
        ref={sheet}
        className="sheet"
        role="listbox"
        tabIndex={0}
        aria-label={t("graphic.of", { path })}
        aria-activedescendant={active ? `${id}${cursor.rung}-${active.place.join(".")}` : undefined}
        onKeyDown={onKeyDown}
        onClick={onClick}
        onDoubleClick={() => cursor && toText(cursor)}
      >
        <div style={{ height: virtual.getTotalSize(), position: "relative" }}>
          {virtual.getVirtualItems().map((item) => {
            const rung = drawn[item.index];
            if (!rung) return null;
            const { line, text: own } = rung.found;
            return (
              <div
                key={item.key}
                data-index={item.index}
                className="netplace"
                style={{ transform: `translateY(${item.start}px)`, height: item.size }}
              >
                <RungRow
                  rung={rung}
                  number={item.index + 1}
                  pou={pouAt(pous, path, line, text)?.name}
                  id={`${id}${item.index}`}
                  selected={cursor?.rung === item.index ? cursor.element : null}
                  breakpoints={breakpoints.some(
                    (each) => each.file === path && each.line >= line && each.line < line + linesOf(own),
                  )}
                />
              </div>
            );
          })}
        </div>
      </div>
      <p className="netnote faint" title={t("graphic.fromvalues.hint")}>
        <Icon name="info" small />
        {t("graphic.fromvalues")}
      </p>
    </div>
  );
}

const linesOf = (text: string) => text.split("\n").length;

/** Where an element begins in the file. */
function placeOf(rung: DrawnRung | undefined, element: number): { line: number; column: number } {
  if (!rung) return { line: 1, column: 1 };
  const at = rung.drawing?.elements[element]?.element.span.at ?? 0;
  const before = rung.found.text.slice(0, at).split("\n");
  const column = (before.at(-1)?.length ?? 0) + 1 + (before.length === 1 ? rung.found.indent.length : 0);
  return { line: rung.found.line + before.length - 1, column };
}

/** Moves the cursor; whether the key is one that does. */
function move(event: KeyboardEvent, now: Cursor, drawn: readonly DrawnRung[], go: (to: Cursor) => void): boolean {
  const count = drawn[now.rung]?.drawing?.elements.length ?? 0;
  const step = { ArrowUp: -1, ArrowDown: 1 }[event.key];
  const other = step === undefined ? now.rung : Math.max(0, Math.min(drawn.length - 1, now.rung + step));
  if (event.ctrlKey) {
    if (step === undefined) return false;
    go({ rung: other, element: 0 });
    return true;
  }
  if (event.key === "Home" || event.key === "End") {
    go({ rung: now.rung, element: event.key === "Home" ? 0 : Math.max(0, count - 1) });
    return true;
  }
  const way = WAYS[event.key];
  if (way === undefined) return false;
  const drawing = drawn[now.rung]?.drawing;
  const found = drawing ? next(drawing, now.element, way) : null;
  if (found !== null) go({ rung: now.rung, element: found });
  else if (other !== now.rung) go({ rung: other, element: 0 });
  else go(now);
  return true;
}
