import { useEffect } from "react";
import { refreshSweeps, useSweeps } from "../../../store/errors/sweeps";
import { useBench } from "../../../store/plc/bench";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { Comparison } from "./Comparison";
import "./sweep.css";
import { SweepList } from "./SweepList";
import { SweepView } from "./SweepView";

/** The page of the error sweeps: their list, one of them, or two side by side. */
export function SweepPage() {
  const project = useBench((bench) => bench.project?.id ?? null);
  // biome-ignore lint/correctness/useExhaustiveDependencies: runs again for a different project, which has its own sweeps
  useEffect(() => void refreshSweeps(), [project]);
  const { shown, sweep, comparison, list, trouble } = useSweeps();
  const waiting = shown.view === "list" ? list === null : shown.view === "sweep" ? sweep === null : comparison === null;
  return (
    <div className="pane flexcol" data-pane="sweep">
      {trouble && (
        <p className="trouble st fatal" role="alert">
          <Icon name="error" small />
          <span>{trouble}</span>
        </p>
      )}
      {project === null ? (
        <p className="lonely faint">{t("sweep.noproject")}</p>
      ) : waiting ? (
        trouble === null && <p className="lonely faint">{t("sweep.loading")}</p>
      ) : shown.view === "sweep" && sweep ? (
        <SweepView key={sweep.id} sweep={sweep} />
      ) : shown.view === "compare" && comparison ? (
        <Comparison comparison={comparison} />
      ) : (
        <SweepList list={list ?? []} />
      )}
    </div>
  );
}
