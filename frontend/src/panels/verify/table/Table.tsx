import { defaultRangeExtractor, type Range } from "@tanstack/react-virtual";
import {
  type CSSProperties,
  type KeyboardEvent,
  useCallback,
  useEffect,
  useLayoutEffect,
  useMemo,
  useRef,
  useState,
} from "react";
import { grouped } from "../../../logic/format/numbers";
import { firstDifferingUnit, isGoing, ranIn } from "../../../logic/verify/verify";
import {
  arranged,
  heldAcross,
  type Track,
  tracksInSight,
  tracksOf,
  unitsOf,
  wholeWidth,
} from "../../../logic/verify/verifyColumns";
import { useWidths } from "../../../store/page/columns";
import type { ShownVerification } from "../../../store/verify/verify";
import { useArrangement } from "../../../store/verify/verifyColumns";
import {
  editBegun,
  indexAt,
  lineCount,
  lineOfRow,
  seeLines,
  selectRow,
  soughtFound,
  useVerifyRows,
} from "../../../store/verify/verifyRows";
import { t } from "../../../text";
import { useMenu } from "../../../ui/Menu";
import { useColumns } from "../../../ui/useColumns";
import { belowRow, ROW, useGrid, useReveal } from "../../../ui/useGrid";
import { useKeptScroll } from "../../../ui/useKeptScroll";
import { columnMenu } from "./columnMenu";
import { useEditing } from "./editing";
import { Heads } from "./Heads";
import { RowLine } from "./RowLine";

/** The heads take two lines. */
const HEAD = 46;

/** A beside A', scan by scan. The grid has the focus; the selected cell is its active descendant. */
export function Table({ shown }: { shown: ShownVerification }) {
  const { info } = shown;
  const grid = useRef<HTMLDivElement>(null);
  useKeptScroll(grid);
  const rows = useVerifyRows();
  const arrangement = useArrangement(info.title);
  const units = useMemo(() => unitsOf(rows.columns), [rows.columns]);
  const steps = useMemo(() => [...rows.byIndex.values()].some(({ kind }) => kind === "step"), [rows.byIndex]);
  const scanLength = useMemo(
    () => grouped([...rows.byIndex.values()].reduce((last, { scan }) => Math.max(last, scan), 0)).length,
    [rows.byIndex],
  );
  const kept = useWidths("verification");
  const { grip } = useColumns(kept);
  const tracks = useMemo(
    () =>
      tracksOf(
        arranged(units, arrangement),
        arrangement.pinned,
        { instances: info.instances.length > 1, steps, scanLength },
        kept.widths,
      ),
    [units, arrangement, info.instances.length, steps, scanLength, kept.widths],
  );
  const { open, menu } = useMenu(t("verify.column"));
  const across = useAcross(grid);
  useHeldAcross(grid, tracks, across.onScroll);
  const drawn = useMemo(() => tracksInSight(tracks, across.left, across.width), [tracks, across]);
  const count = lineCount(rows);
  const follow = useFollowing(grid, isGoing(info) && info.source === "live" && info.pace === "free", rows.selected);
  const lines = useGrid({
    count,
    scroll: grid,
    head: HEAD,
    overscan: 10,
    keyOf: (line) => indexAt(rows, line),
    rangeOf: (range) => defaultRangeExtractor(follow.isOn() ? endOf(range) : range),
  });
  const { from, to } = lines;
  const atEnd = to >= count;
  useEffect(() => seeLines(from, Math.max(to, from + 40), atEnd), [from, to, atEnd]);
  useHeldPlace(grid, rows.first, rows.onlyDiffering || follow.isOn());
  // biome-ignore lint/correctness/useExhaustiveDependencies: runs when rows are added
  useLayoutEffect(() => {
    if (follow.isOn() && grid.current) grid.current.scrollTop = grid.current.scrollHeight;
  }, [rows.count, count, rows.selected]);
  const at = rows.selected === null ? -1 : lineOfRow(rows, rows.selected);
  useReveal(at, rows.selected, lines.reveal);
  const editing = useEditing(shown, grid);
  // biome-ignore lint/correctness/useExhaustiveDependencies: a jump selects the differing cell, once
  useEffect(() => {
    const row = rows.sought === null ? undefined : rows.byIndex.get(rows.sought);
    if (!row) return;
    soughtFound();
    const unit = firstDifferingUnit(row, units, info.memory);
    const track = tracks.find((each) => each.unit === unit);
    if (!unit || !track) return;
    selectRow(row.index, track.key);
    reveal(grid.current, tracks, track);
  }, [rows.sought, rows.byIndex, tracks]);
  // biome-ignore lint/correctness/useExhaustiveDependencies: runs once for each request
  useEffect(() => {
    const track = tracks.find(({ key }) => key === rows.wanted?.track);
    const row = rows.wanted && rows.byIndex.get(rows.wanted.index);
    if (!track || !row) return;
    editBegun();
    reveal(grid.current, tracks, track);
    editing.begin(row, track);
  }, [rows.wanted, tracks]);

  function goTo(line: number, track = rows.track): void {
    const target = lines.clamped(line);
    if (count === 0) return;
    selectRow(indexAt(rows, target), track);
    lines.reveal(target);
  }

  function goAcross(by: number): void {
    const cells = tracks.slice(1);
    const now = cells.findIndex(({ key }) => key === rows.track);
    const next = cells[Math.max(0, Math.min(cells.length - 1, now + by))];
    if (!next) return;
    selectRow(rows.selected ?? indexAt(rows, from), next.key);
    reveal(grid.current, tracks, next);
  }

  function onKeyDown(event: KeyboardEvent<HTMLDivElement>): void {
    if ((event.target as HTMLElement).matches("input, button")) return;
    const down = ["Home", "End"].includes(event.key) ? undefined : lines.stepOf(event.key, at);
    const track = tracks.find(({ key }) => key === rows.track) ?? null;
    const row = rows.selected === null ? undefined : rows.byIndex.get(rows.selected);
    if (event.altKey && track?.unit && (event.key === "ArrowLeft" || event.key === "ArrowRight"))
      columnMenu(info.title, units, track.unit)[event.key === "ArrowLeft" ? 0 : 1]?.onSelect();
    else if (down !== undefined) goTo(at < 0 ? from : down);
    else if (event.key === "ArrowLeft") goAcross(-1);
    else if (event.key === "ArrowRight") goAcross(1);
    else if (event.key === "Home") event.ctrlKey ? goTo(0) : goAcross(-tracks.length);
    else if (event.key === "End") event.ctrlKey ? goTo(count - 1) : goAcross(tracks.length);
    else if ((event.key === "Enter" || event.key === "F2") && row && track) editing.begin(row, track);
    else if (event.key === "ContextMenu" && track) openMenu(track, event.currentTarget);
    else return;
    event.preventDefault();
  }

  function openMenu(track: Track, element: Element): void {
    if (track.unit) open(columnMenu(info.title, units, track.unit), belowRow(element, ".vfcell.at", 0));
  }

  // Keys go to the row while no cell is selected, or the selected cell is not visible.
  const active = drawn.some(({ key }) => key === rows.track)
    ? `vf-${rows.selected}-${rows.track}`
    : `vf-${rows.selected}`;
  const width = wholeWidth(tracks);
  const style = { "--cols": tracks.map((each) => `${each.width}px`).join(" "), "--whole": `${width}px` };
  return (
    <div
      ref={grid}
      className="grid scroll both ver"
      role="grid"
      aria-label={t("verify.table")}
      aria-rowcount={count + 2}
      aria-colcount={tracks.length}
      aria-activedescendant={at >= from && at < to && at >= 0 ? active : undefined}
      style={style as CSSProperties}
      tabIndex={0}
      onKeyDown={onKeyDown}
      onScroll={across.onScroll}
    >
      <Heads
        range={info.title}
        memory={info.memory}
        units={units}
        tracks={tracks}
        drawn={drawn}
        grip={grip}
        onMenu={(unit, at) => open(columnMenu(info.title, units, unit), at)}
      />
      <div {...lines.body}>
        {lines.items.map((item) => {
          const { index: line, key } = item;
          const index = indexAt(rows, line);
          return (
            <RowLine
              key={key}
              row={rows.byIndex.get(index) ?? null}
              index={index}
              line={line}
              top={lines.topOf(item)}
              drawn={drawn}
              tracks={tracks}
              memory={info.memory}
              source={info.source}
              formats={arrangement.formats}
              selected={index === rows.selected}
              track={index === rows.selected ? rows.track : null}
              editing={editing.at?.index === index ? editing : null}
              onEdit={editing.begin}
            />
          );
        })}
      </div>
      {count === 0 && <NoRows shown={shown} only={rows.onlyDiffering} />}
      {menu}
    </div>
  );
}

function NoRows({ shown: { info }, only }: { shown: ShownVerification; only: boolean }) {
  const text =
    info.state === "failed"
      ? info.message
      : only && info.rows > 0
        ? ranIn(info) > 0
          ? t(info.coverage?.ungiven.length ? "verify.nodifference.ungiven" : "verify.nodifference", {
              count: ranIn(info),
            })
          : t(info.compared > 0 ? "verify.hint.idle" : "verify.hint.none")
        : t(isGoing(info) ? "verify.norows.yet" : "verify.norows");
  return (
    <p className="lonely faint vfnone" role="status">
      {text}
    </p>
  );
}

/** The horizontal scroll position, and the width of the visible part. */
function useAcross(grid: { current: HTMLDivElement | null }) {
  const [sight, setSight] = useState({ left: 0, width: 1600 });
  const note = useCallback(() => {
    const element = grid.current;
    if (!element) return;
    // In steps, so that most scrolling draws no new columns.
    const left = Math.floor(element.scrollLeft / 120) * 120;
    const width = element.clientWidth;
    setSight((before) => (before.left === left && before.width === width ? before : { left, width }));
  }, [grid]);
  useEffect(() => {
    const element = grid.current;
    if (!element) return;
    const sized = new ResizeObserver(note);
    sized.observe(element);
    return () => sized.disconnect();
  }, [grid, note]);
  return useMemo(() => ({ ...sight, onScroll: note }), [sight, note]);
}

/** A variable that is used for the first time gets a column among the others: the visible part stays in place. */
function useHeldAcross(grid: { current: HTMLDivElement | null }, tracks: readonly Track[], note: () => void): void {
  const before = useRef(tracks);
  useLayoutEffect(() => {
    const old = before.current;
    before.current = tracks;
    const element = grid.current;
    if (!element || old.length === tracks.length) return;
    const left = heldAcross(old, tracks, element.scrollLeft);
    if (left === element.scrollLeft) return;
    element.scrollLeft = left;
    note();
  }, [tracks, grid, note]);
}

/** Old rows are dropped at the beginning: the visible part stays in place. */
function useHeldPlace(grid: { current: HTMLDivElement | null }, first: number, moves: boolean): void {
  const before = useRef(first);
  useLayoutEffect(() => {
    const gone = first - before.current;
    before.current = first;
    if (gone > 0 && !moves && grid.current) grid.current.scrollTop -= gone * ROW;
  }, [first, moves, grid]);
}

/** Extra lines after the visible ones are drawn at once, before the browser reports that it scrolled there. */
const endOf = (range: Range): Range => ({
  ...range,
  startIndex: Math.max(0, range.count - 1 - (range.endIndex - range.startIndex)),
  endIndex: range.count - 1,
});

/** At the end of a free-running verification new rows become visible by themselves, until somebody selects a row. */
function useFollowing(
  grid: { current: HTMLDivElement | null },
  live: boolean,
  selected: number | null,
): { isOn: () => boolean } {
  const follows = useRef(live);
  const isOn = () => live && follows.current && selected === null;
  const on = useRef(isOn);
  on.current = isOn;
  useEffect(() => {
    const element = grid.current;
    if (!element) return;
    let height = element.clientHeight;
    // After the panel is shown again or resized, the view is still at the end.
    const sized = new ResizeObserver(() => {
      height = element.clientHeight;
      if (on.current()) element.scrollTop = element.scrollHeight;
    });
    sized.observe(element);
    const note = () => {
      if (element.clientHeight > 0 && element.clientHeight === height)
        follows.current = element.scrollTop + element.clientHeight >= element.scrollHeight - ROW;
    };
    const stop = (event: WheelEvent) => {
      if (event.deltaY < 0) follows.current = false;
    };
    element.addEventListener("scroll", note, { passive: true });
    element.addEventListener("wheel", stop, { passive: true });
    return () => {
      sized.disconnect();
      element.removeEventListener("scroll", note);
      element.removeEventListener("wheel", stop);
    };
  }, [grid]);
  return { isOn };
}

function reveal(grid: HTMLElement | null, tracks: readonly Track[], track: Track): void {
  if (!grid || track.sticky) return;
  const covered = tracks.filter(({ sticky }) => sticky).reduce((sum, { width }) => sum + width, 0);
  if (track.left < grid.scrollLeft + covered) grid.scrollLeft = track.left - covered;
  else if (track.left + track.width > grid.scrollLeft + grid.clientWidth)
    grid.scrollLeft = track.left + track.width - grid.clientWidth;
}
