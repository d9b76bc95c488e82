import { type DragEvent, useEffect, useMemo, useRef } from "react";
import { useShallow } from "zustand/react/shallow";
import { pathsIn } from "../../logic/format/paths";
import { layoutOf } from "../../logic/trace/plots";
import { useBench } from "../../store/plc/bench";
import { addAllToTrace, putAwayTrouble, refreshTraces, shownOf, useTraces } from "../../store/trace/traces";
import { t } from "../../text";
import { Icon } from "../../ui/Icon";
import { CursorTable } from "./CursorTable";
import { EmptyTrace } from "./EmptyTrace";
import { Graph } from "./Graph";
import { Retrospectives } from "./Retrospectives";
import { Settings } from "./Settings";
import { Toolbar } from "./Toolbar";
import "./trace.css";
import { useSamples } from "./useSamples";

/** Signals over scans. They are recorded in the PLC's process, whether anybody looks or not, and everybody sees the same. */
export function TracePanel() {
  const instance = useBench((bench) => bench.instance?.id ?? null);
  const { source, traces, records, moved, compared } = useTraces(
    useShallow(({ source, traces, records, moved, compared }) => ({ source, traces, records, moved, compared })),
  );
  const shown = useMemo(() => shownOf({ source, traces, records }), [source, traces, records]);
  const layout = useMemo(() => layoutOf(shown?.signals ?? [], moved), [shown?.signals, moved]);
  const graph = useRef<HTMLDivElement>(null);
  // biome-ignore lint/correctness/useExhaustiveDependencies: a different PLC has different traces
  useEffect(() => void refreshTraces(), [instance]);
  const { samples, whole } = useSamples(shown);

  function onDrop(event: DragEvent): void {
    const paths = pathsIn(event.dataTransfer.getData("text/plain"));
    if (paths.length === 0) return;
    event.preventDefault();
    void addAllToTrace(paths);
  }

  return (
    <div
      className="pane flexcol trace"
      data-pane="trace"
      data-live
      onDragOver={(event) => event.dataTransfer.types.includes("text/plain") && event.preventDefault()}
      onDrop={onDrop}
    >
      <Toolbar shown={shown} graph={graph} />
      <Retrospectives />
      <Trouble />
      {shown ? (
        <div className="trbody">
          <Graph ref={graph} shown={shown} samples={samples} whole={whole} layout={layout} compared={compared} />
          <div className="trside">
            <CursorTable shown={shown} samples={samples} />
            {shown.trace && <Settings trace={shown.trace} key={shown.trace.id} />}
          </div>
        </div>
      ) : (
        <EmptyTrace />
      )}
    </div>
  );
}

function Trouble() {
  const trouble = useTraces((traces) => traces.trouble);
  if (!trouble) return null;
  return (
    <p className="trouble st fatal" role="alert">
      <Icon name="error" small />
      <span>
        {trouble.message}{" "}
        {trouble.near.map((path) => (
          <button key={path} type="button" className="link mono" onClick={() => void addAllToTrace([path])}>
            {path}
          </button>
        ))}
      </span>
      <span className="grow" />
      <button type="button" className="ib sm" aria-label={t("close")} title={t("close")} onClick={putAwayTrouble}>
        <Icon name="x" />
      </button>
    </p>
  );
}
