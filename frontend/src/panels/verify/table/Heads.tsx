import { type DragEvent, useState } from "react";
import type { Track, Unit } from "../../../logic/verify/verifyColumns";
import { dropColumn } from "../../../store/verify/verifyColumns";
import { t } from "../../../text";
import type { Columns } from "../../../ui/useColumns";
import type { VerificationInfo } from "../../../wire/types";
import { placeOf } from "./cells";

interface Props {
  range: string;
  memory: VerificationInfo["memory"];
  units: readonly Unit[];
  tracks: readonly Track[];
  drawn: readonly Track[];
  grip: Columns["grip"];
  onMenu: (unit: Unit, at: { x: number; y: number }) => void;
}

/** Two lines: the names of variables, which can be dragged to a different place; below them the heading of each column. */
export function Heads({ range, memory, units, tracks, drawn, grip, onMenu }: Props) {
  const [over, setOver] = useState<string | null>(null);
  const named = drawn.filter(({ kind }) => kind === "control" || kind === "input");
  const firstInput = tracks.find(({ kind, sticky }) => kind === "input" && !sticky);

  function drop(event: DragEvent, unit: Unit): void {
    const key = event.dataTransfer.getData("application/x-scanbench-column");
    setOver(null);
    if (!key) return;
    event.preventDefault();
    dropColumn(range, units, key, unit.key);
  }

  const head = (track: Track, unit: Unit) => (
    <span
      key={track.key}
      role="columnheader"
      aria-colindex={tracks.indexOf(track) + 1}
      aria-colspan={track.kind === "control" ? 2 : undefined}
      className={`num vfname${track.kind === "control" ? " vfpair" : ""}${over === unit.key ? " vfover" : ""}${track.sticky ? " vfstick" : ""}`}
      aria-label={unit.column.name}
      style={placeOf(track, tracks, track.kind === "control" ? 2 : 1)}
      title={`${unit.column.name} : ${unit.column.type}`}
      draggable
      onDragStart={(event) => {
        event.dataTransfer.setData("application/x-scanbench-column", unit.key);
        event.dataTransfer.effectAllowed = "move";
      }}
      onDragOver={(event) => {
        if (!event.dataTransfer.types.includes("application/x-scanbench-column")) return;
        event.preventDefault();
        setOver(unit.key);
      }}
      onDragLeave={() => setOver(null)}
      onDrop={(event) => drop(event, unit)}
      onContextMenu={(event) => {
        event.preventDefault();
        onMenu(unit, { x: event.clientX, y: event.clientY });
      }}
      onDoubleClick={(event) => onMenu(unit, { x: event.clientX, y: event.clientY })}
    >
      <span className="mono cut">{unit.column.name}</span>
      {track.kind === "input" && grip(track.key, unit.column.name)}
    </span>
  );

  return (
    <div className="vfheads" role="rowgroup">
      <div className="gr h vg" role="row" aria-rowindex={1}>
        {drawn.some(({ key }) => key === firstInput?.key) && firstInput && (
          <span className="vfinputs" role="columnheader" style={placeOf(firstInput, tracks, inputsIn(tracks))}>
            {t("verify.inputs")}
          </span>
        )}
        {drawn
          .filter(({ sticky, unit }) => sticky && !unit)
          .map((track) => (
            <span key={track.key} role="presentation" className="vfstick" style={placeOf(track, tracks)} />
          ))}
        {named.filter(({ kind }) => kind === "control").map((track) => track.unit && head(track, track.unit))}
      </div>
      <div className="gr h" role="row" aria-rowindex={2}>
        {drawn.map((track) =>
          track.kind === "input" && track.unit ? (
            head(track, track.unit)
          ) : (
            <span
              key={track.key}
              role="columnheader"
              aria-colindex={tracks.indexOf(track) + 1}
              aria-label={labelOf(track) ?? (wordOf(track) || undefined)}
              className={`${CELLS[track.kind]}${track.sticky ? " vfstick" : ""}`}
              style={placeOf(track, tracks)}
              title={titleOf(track, memory)}
            >
              {track.kind === "mark" ? <span className="sr">{t("verify.differs")}</span> : wordOf(track)}
              {track.kind !== "mark" && grip(track.key, labelOf(track) ?? wordOf(track))}
            </span>
          ),
        )}
      </div>
    </div>
  );
}

const inputsIn = (tracks: readonly Track[]) => tracks.filter(({ kind, sticky }) => kind === "input" && !sticky).length;

const CELLS: Record<Track["kind"], string> = {
  mark: "gut",
  scan: "num",
  call: "num",
  instance: "",
  place: "",
  control: "num vfpair",
  monitor: "num",
  input: "num",
  from: "",
  disturbance: "",
  note: "",
};

function wordOf({ kind }: Track): string {
  if (kind === "control") return "A";
  if (kind === "monitor") return "A′";
  return kind === "mark" || kind === "input" ? "" : t(`verify.head.${kind}`);
}

function labelOf({ kind, unit }: Track): string | undefined {
  return unit ? `${unit.column.name} ${kind === "control" ? "A" : "A′"}` : undefined;
}

function titleOf({ kind }: Track, memory: VerificationInfo["memory"]): string | undefined {
  if (kind === "control") return t("verify.head.control.about");
  return kind === "monitor" ? t(`verify.head.monitor.${memory}`) : undefined;
}
