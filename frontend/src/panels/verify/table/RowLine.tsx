import { memo } from "react";
import type { Format } from "../../../logic/format/formats";
import { grouped } from "../../../logic/format/numbers";
import { differsIn, isEdited, resultOf } from "../../../logic/verify/verify";
import type { Track, Unit } from "../../../logic/verify/verifyColumns";
import { NOTHING, shownValue } from "../../../logic/verify/verifyValues";
import { selectRow } from "../../../store/verify/verifyRows";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { VerificationInfo, VerifyRow } from "../../../wire/types";
import { placeOf } from "./cells";
import type { Editing } from "./editing";

interface Props {
  /** Null: it is still being fetched. */
  row: VerifyRow | null;
  index: number;
  line: number;
  top: number;
  drawn: readonly Track[];
  tracks: readonly Track[];
  memory: VerificationInfo["memory"];
  source: VerificationInfo["source"];
  formats: Readonly<Record<string, Format>>;
  selected: boolean;
  /** The selected column. */
  track: string | null;
  editing: Editing | null;
  onEdit: Editing["begin"];
}

/** One row: one run through the range, one scan, or one statement. */
export const RowLine = memo(
  function RowLine({ row, index, line, top, drawn, tracks, selected, track: at, onEdit, ...how }: Props) {
    const bad = row !== null && row.differences.length > 0;
    return (
      <div
        className={`gr${selected ? " on" : ""}${bad ? " dr" : ""}`}
        id={`vf-${index}`}
        role="row"
        aria-rowindex={line + 3}
        aria-selected={selected}
        data-scan={row?.scan}
        data-call={row?.call}
        data-differs={bad || undefined}
        style={{ transform: `translateY(${top}px)` }}
      >
        {drawn.map((track) => {
          const content = row && cellOf(row, track, how);
          return (
            <span
              key={track.key}
              id={`vf-${index}-${track.key}`}
              role="gridcell"
              aria-colindex={tracks.indexOf(track) + 1}
              aria-readonly={track.kind === "input" ? undefined : true}
              className={`vfcell ${content?.look ?? ""}${track.sticky ? " vfstick" : ""}${at === track.key ? " at" : ""}`}
              style={placeOf(track, tracks)}
              title={content?.title}
              data-cell={track.key}
              onClick={() => selectRow(index, track.key)}
              onDoubleClick={() => row && onEdit(row, track)}
            >
              {how.editing?.at?.track === track.key ? <EditCell editing={how.editing} track={track} /> : content?.shown}
            </span>
          );
        })}
      </div>
    );
  },
  (before, now) =>
    (Object.keys(now) as (keyof Props)[]).every((key) => key === "onEdit" || Object.is(before[key], now[key])),
);

interface Cell {
  look: string;
  shown: React.ReactNode;
  title?: string | undefined;
}

type How = Pick<Props, "memory" | "source" | "formats" | "editing">;

function cellOf(row: VerifyRow, track: Track, how: How): Cell {
  switch (track.kind) {
    case "mark":
      // The note may be far to the right: the place of a difference already says that this row has no result.
      if (!row.compared && row.differences.length === 0)
        return {
          look: "gut faint",
          shown: <Icon name="minus" small />,
          title: row.note || t("verify.notcompared"),
        };
      if (row.differences.length === 0 && row.consequences.length > 0)
        return {
          look: "gut faint",
          shown: <Icon name="step-in" small />,
          title: `${t(row.kind === "step" ? "verify.consequence" : "verify.told")}: ${row.consequences[0]?.message}`,
        };
      return {
        look: "gut",
        shown: row.differences.length > 0 && <Icon name="differs" className="diffc" />,
        title: row.differences[0]?.message,
      };
    case "scan":
      return { look: "num", shown: grouped(row.scan) };
    case "call":
      return { look: "num faint", shown: row.call > 0 ? row.call : "" };
    case "instance":
      return { look: "mono", shown: row.instance, title: row.instance };
    case "place":
      return {
        look: "mono muted",
        shown: row.place
          ? `${row.place.line}: ${row.place.text}`
          : row.next && t("verify.before", { line: row.next.line }),
        title: row.place ? `${row.place.file}:${row.place.line}, ${row.place.instance}` : undefined,
      };
    case "control":
    case "monitor":
      return outputCell(row, track.unit as Unit, track.kind, how);
    case "input":
      return inputCell(row, track.unit as Unit, how);
    case "from":
      return row.kind === "none"
        ? { look: "faint", shown: "" }
        : how.memory === "set" && isEdited(row)
          ? { look: "accent", shown: t("verify.set") }
          : { look: "muted", shown: t("verify.recorded") };
    case "disturbance": {
      const text = row.disturbances.join(", ");
      return {
        look: "",
        title: text || undefined,
        shown: text && (
          <span className="st halted">
            <Icon name="generated" small />
            <span className="cut">{text}</span>
          </span>
        ),
      };
    }
    case "note":
      return {
        look: "faint",
        shown: row.note || (row.compared ? (row.kind === "none" ? t("verify.notrun") : "") : t("verify.notcompared")),
        title: row.note || undefined,
      };
  }
}

function outputCell(row: VerifyRow, unit: Unit, kind: "control" | "monitor", { memory, source, formats }: How): Cell {
  const output = row.outputs[unit.column.name];
  const edge = kind === "control" ? " vfpair" : "";
  if (!output) return { look: `num faint${edge}`, shown: "" };
  // a log does not have all outputs, and a row that was taken over from it has no A'
  const compared = source !== "trace" || (output.control !== null && output.monitor !== null);
  const differs = compared && differsIn(row, unit, memory);
  const hex = kind === "control" ? output.control : resultOf(output, memory);
  const missing = hex === null && compared ? t("verify.notwritten") : undefined;
  return {
    look: `num${edge} ${differs ? `dcell ${kind === "control" ? "a" : "m"}` : kind === "monitor" ? "same" : ""}`,
    title: differs ? differenceOf(row, unit.column.name) : missing,
    shown: (
      <>
        {differs && kind === "control" && <Icon name="differs" />}
        <Value unit={unit} hex={hex} formats={formats} />
      </>
    ),
  };
}

const differenceOf = (row: VerifyRow, name: string) =>
  row.differences.find((difference) => difference.name === name)?.message;

function inputCell(row: VerifyRow, unit: Unit, { memory, formats }: How): Cell {
  const { name } = unit.column;
  const input = row.inputs[name];
  if (!input) return { look: "num faint", shown: "" };
  const edited = memory === "set" && input.set !== null;
  const differs = !edited && differsIn(row, unit, memory);
  const expected = input.expected === null ? "" : shownValue(unit.column, input.expected, formats[name]).text;
  return {
    look: `num vfin${edited ? " vfset" : ""}${differs ? " dcell a" : ""}`,
    title: edited
      ? t("verify.set.was", { value: shownValue(unit.column, input.recorded, formats[name]).text })
      : differs
        ? (differenceOf(row, name) ?? t("verify.expected", { value: expected }))
        : undefined,
    shown: (
      <>
        {differs && <Icon name="differs" />}
        <Value unit={unit} hex={edited ? input.set : input.recorded} formats={formats} />
      </>
    ),
  };
}

function Value({ unit, hex, formats }: { unit: Unit; hex: string | null; formats: How["formats"] }) {
  const { text, lamp } = shownValue(unit.column, hex, formats[unit.column.name]);
  if (lamp === null) return <span className={`cut${text === NOTHING ? " faint" : ""}`}>{text}</span>;
  return (
    <span className="lampv">
      <span className={`lamp${lamp ? " on" : ""}`} />
      <span className="bw">{text}</span>
    </span>
  );
}

function EditCell({ editing, track }: { editing: Editing; track: Track }) {
  return (
    <>
      <input
        className="vfedit"
        // biome-ignore lint/a11y/noAutofocus: somebody has just asked to type here
        autoFocus
        aria-label={t("verify.set.of", { name: track.unit?.column.name ?? "" })}
        aria-invalid={editing.refused !== null}
        value={editing.draft}
        spellCheck={false}
        autoComplete="off"
        onFocus={(event) => editing.fresh && event.target.select()}
        onChange={(event) => editing.type(event.target.value)}
        onKeyDown={(event) => {
          if (event.key === "Enter") editing.enter();
          else if (event.key === "Escape") editing.leave();
          else return;
          event.preventDefault();
          event.stopPropagation();
        }}
      />
      {editing.refused && (
        <span className="vfrefused bad" role="alert">
          <Icon name="error" small />
          {editing.refused}
        </span>
      )}
    </>
  );
}
