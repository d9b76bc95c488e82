import { memo } from "react";
import { isFinding } from "../../../logic/errors/catalogue";
import { codeText } from "../../../logic/errors/codeText";
import { type ErrorRow, isCell, isPresent, type MatrixRow, type Slot } from "../../../logic/errors/sweep";
import { t } from "../../../text";
import { Icon, type IconName } from "../../../ui/Icon";
import { VERDICT_ICONS } from "../../../ui/statuses";
import type { CellRef, SweepCell } from "../../../wire/types";

export const cellId = (sweep: number, row: number, column: number) => `sweep-${sweep}-${row}-${column}`;

interface Props {
  sweep: number;
  row: MatrixRow;
  index: number;
  top: number;
  states: readonly string[];
  /** The index of its selected cell; null when none is selected. */
  column: number | null;
  onSelect: (cell: CellRef) => void;
}

/** A group's name, or an error with its cells. It is drawn again only when it changed, because progress comes often. */
export const Row = memo(function Row({ sweep, row, index, top, states, column, onSelect }: Props) {
  if (row.kind === "group") {
    return (
      <div className="gr sg" role="row" aria-rowindex={index + 2} style={{ transform: `translateY(${top}px)` }}>
        <span role="rowheader" className="swname" aria-colspan={states.length + 2}>
          <b>{row.name}</b>
        </span>
      </div>
    );
  }
  const { error, slots, line } = row;
  const select = () => onSelect({ error: error.id, state: states[column ?? 0] ?? "" });
  return (
    <div
      className="gr"
      role="row"
      aria-rowindex={index + 2}
      data-error={error.id}
      style={{ transform: `translateY(${top}px)` }}
    >
      <span role="rowheader" className="swname cut" title={error.name} onClick={select}>
        {error.name}
      </span>
      <span role="gridcell" className="swcode mono muted" onClick={select}>
        {codeText(error.code)}
      </span>
      {line ? (
        <Cell
          id={cellId(sweep, index, column ?? 0)}
          look={lookOfLine(row)}
          selected={column !== null}
          span={states.length}
          onSelect={select}
        />
      ) : (
        slots.map((slot, at) => (
          <Cell
            key={states[at]}
            id={cellId(sweep, index, at)}
            look={lookOf(slot)}
            selected={column === at}
            onSelect={() => onSelect({ error: error.id, state: states[at] ?? "" })}
          />
        ))
      )}
    </div>
  );
}, sameRow);

function sameRow(before: Props, after: Props): boolean {
  if (
    before.column !== after.column ||
    before.index !== after.index ||
    before.top !== after.top ||
    before.states.length !== after.states.length
  )
    return false;
  const [one, other] = [before.row, after.row];
  if (one.kind === "group" || other.kind === "group")
    return one.kind === "group" && other.kind === "group" && one.name === other.name;
  // The names are updated when the catalogue arrives.
  if (one.error.name !== other.error.name) return false;
  return one.slots.length === other.slots.length && one.slots.every((slot, at) => slot === other.slots[at]);
}

interface Look {
  icon: IconName;
  /** Class: the verdict, or what the cell shows instead. */
  tone: string;
  word: string;
  title?: string;
}

interface CellProps {
  id: string;
  look: Look;
  selected: boolean;
  span?: number;
  onSelect: () => void;
}

function Cell({ id, look, selected, span, onSelect }: CellProps) {
  return (
    <span
      id={id}
      role="gridcell"
      className={`sc ${look.tone}${selected ? " selc" : ""}`}
      style={span ? { gridColumn: "3 / -1" } : undefined}
      aria-colspan={span}
      aria-selected={selected}
      title={look.title}
      onClick={onSelect}
    >
      <Icon name={look.icon} small />
      <span className="cut">{look.word}</span>
    </span>
  );
}

function lookOf(slot: Slot): Look {
  if (slot === "running") return { icon: "record", tone: "run", word: t("sweep.running") };
  if (!isCell(slot))
    return {
      icon: slot === "waiting" ? "wait" : "never",
      tone: "dim",
      word: slot === "waiting" ? "" : t("sweep.missing"),
      title: t(`sweep.${slot}`),
    };
  const { verdict, note } = slot;
  if (verdict === null && slot.unmet > 0)
    return { icon: "error", tone: "unmet", word: t("required.not_tried"), title: note };
  if (verdict === null) return { icon: "never", tone: "dim", word: notRaised(note), title: note };
  if (slot.unmet > 0) {
    const unmet = t("sweep.unmet", { count: slot.unmet });
    return { icon: "error", tone: "unmet", word: unmet, title: `${wordOf(slot)}: ${unmet}` };
  }
  if (isFinding(verdict) && slot.accepted)
    return { icon: "check", tone: "acc", word: t(`verdict.${verdict}`), title: t("sweep.acceptedby", slot.accepted) };
  return { icon: VERDICT_ICONS[verdict], tone: verdict, word: wordOf(slot), ...(note ? { title: note } : {}) };
}

function wordOf({ verdict, first_effect: effect }: SweepCell): string {
  if (verdict === null) return "";
  const word = t(`verdict.${verdict}`);
  return effect === null ? word : `${word} · ${effect === 1 ? t("sweep.scan") : t("sweep.scans", { count: effect })}`;
}

/** Why an error could not be raised, in the server's words, where there is room. */
function notRaised(note: string, words = ""): string {
  return isPresent(note) ? t("sweep.present") : words || t("sweep.none");
}

function stoppedIn(states: number): string {
  return states === 2 ? t("sweep.line.stopped.both") : t("sweep.line.stopped", { count: states });
}

function lookOfLine({ line, slots }: ErrorRow): Look {
  if (line?.what === "stopped")
    return {
      icon: "stopped",
      tone: "stopped",
      word: stoppedIn(slots.length),
    };
  if (line?.what === "note" && line.unmet)
    return { icon: "error", tone: "unmet", word: t("sweep.line.not_tried", { note: line.note }), title: line.note };
  if (line?.what === "note")
    return { icon: "never", tone: "dim", word: notRaised(line.note, line.note), title: line.note };
  return line?.what === "waiting"
    ? { icon: "wait", tone: "dim", word: t("sweep.waiting") }
    : { icon: "never", tone: "dim", word: t("sweep.missing") };
}
