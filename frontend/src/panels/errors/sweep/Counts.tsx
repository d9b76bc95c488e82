import { countCells, type MatrixView, UNGRADED, VERDICTS } from "../../../logic/errors/sweep";
import { t } from "../../../text";
import { Icon, type IconName } from "../../../ui/Icon";
import { Switch } from "../../../ui/Switch";
import { VERDICT_ICONS } from "../../../ui/statuses";
import type { Sweep } from "../../../wire/types";

interface Props {
  sweep: Sweep;
  view: MatrixView;
  onView: (view: MatrixView) => void;
}

/** The number of cells of each kind. A click shows only the rows with such a cell; a second click shows all rows again. */
export function Counts({ sweep, view, onView }: Props) {
  const counts = countCells(sweep);
  const left = sweep.status === "running" ? "waiting" : "missing";
  const filter = (verdict: MatrixView["verdict"], icon: IconName, tone: string, word: string, count: number) => (
    <button
      key={word}
      type="button"
      className={`btn quiet sm fl${view.verdict === verdict ? " on" : ""}`}
      aria-pressed={view.verdict === verdict}
      title={t("sweep.filter.hint")}
      disabled={count === 0 && view.verdict !== verdict}
      onClick={() => onView({ ...view, verdict: view.verdict === verdict ? null : verdict })}
    >
      <span className={`st ${tone}`}>
        <Icon name={icon} small />
        {word}
      </span>
      <b>{count}</b>
    </button>
  );
  return (
    <div className="sub tall swcounts" role="toolbar" aria-label={t("sweep.counts")}>
      {[...VERDICTS, ...UNGRADED]
        .filter((verdict) => counts.verdicts[verdict] > 0 || view.verdict === verdict)
        .map((verdict) =>
          filter(verdict, VERDICT_ICONS[verdict], verdict, t(`sweep.count.${verdict}`), counts.verdicts[verdict]),
        )}
      {(counts.unmet > 0 || view.verdict === "unmet") &&
        filter("unmet", "error", "unmet", t("sweep.count.unmet"), counts.unmet)}
      {counts.accepted > 0 && filter("accepted", "check", "never", t("sweep.accepted"), counts.accepted)}
      {counts.none > 0 && filter("none", "never", "never", t("sweep.none"), counts.none)}
      {counts.left > 0 && (
        <span className="fl still">
          <span className="st never">
            <Icon name={left === "waiting" ? "wait" : "never"} small />
            {t(`sweep.${left}`)}
          </span>
          <b>{counts.left}</b>
        </span>
      )}
      <span className="grow" />
      <Switch on={view.findings} onToggle={() => onView({ ...view, findings: !view.findings })}>
        {t("sweep.findings")}
      </Switch>
    </div>
  );
}
