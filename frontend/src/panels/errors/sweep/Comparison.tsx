import { useMemo, useState } from "react";
import { CHANGES, sortedChanges, stateWord } from "../../../logic/errors/sweep";
import { dayTime } from "../../../logic/format/numbers";
import { useCatalogueOf } from "../../../store/errors/catalogue";
import { showSweep, showSweeps } from "../../../store/errors/sweeps";
import { useWidths } from "../../../store/page/columns";
import { t } from "../../../text";
import { Icon, type IconName } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import { StateWord } from "../../../ui/StateWord";
import { Switch } from "../../../ui/Switch";
import { VERDICT_ICONS } from "../../../ui/statuses";
import { useColumns } from "../../../ui/useColumns";
import type { SweepChange, SweepComparison, SweepSummary, Verdict } from "../../../wire/types";

const LOOK: Record<SweepChange["change"], { icon: IconName; tone: string }> = {
  worse: { icon: "chev-d", tone: "fatal" },
  fewer: { icon: "minus", tone: "warning" },
  better: { icon: "chev-u", tone: "running" },
  slower: { icon: "clock", tone: "warning" },
  faster: { icon: "clock", tone: "running" },
  new: { icon: "plus", tone: "info" },
  gone: { icon: "minus", tone: "never" },
  same: { icon: "equal", tone: "never" },
};

/** Two sweeps: the old and the new result of each cell, and whether it became better. */
export function Comparison({ comparison }: { comparison: SweepComparison }) {
  const { before, after, changes } = comparison;
  const [only, setOnly] = useState(true);
  const { byId } = useCatalogueOf(after.model);
  const { style, head } = useColumns(useWidths("sweepchanges"));
  const rows = useMemo(() => sortedChanges(changes, only), [changes, only]);
  return (
    <>
      <div className="swtop">
        <IconButton icon="list" label={t("sweep.all")} small onClick={showSweeps} />
        <Side word={t("sweep.compare.before")} sweep={before} />
        <Icon name="moved" className="faint" />
        <Side word={t("sweep.compare.after")} sweep={after} />
      </div>
      <div className="sub tall swcounts">
        {CHANGES.map((change) => {
          const count = changes.filter((known) => known.change === change).length;
          return (
            count > 0 && (
              <span key={change} className="fl still">
                <StateWord {...LOOK[change]} word={t(`sweep.change.${change}`)} />
                <b>{count}</b>
              </span>
            )
          );
        })}
        <span className="grow" />
        <Switch on={only} onToggle={() => setOnly(!only)}>
          {t("sweep.compare.only")}
        </Switch>
      </div>
      {rows.length === 0 ? (
        <p className="lonely faint">{t("sweep.compare.same")}</p>
      ) : (
        <div
          className="grid scroll swcmp"
          role="table"
          aria-label={t("sweep.compare.table")}
          style={style}
          // biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard
          tabIndex={0}
        >
          <div className="gr h" role="row">
            {(["error", "state", "before", "after"] as const).map((column) =>
              head(column, t(`sweep.compare.${column}`)),
            )}
            <span role="columnheader">{t("sweep.compare.change")}</span>
          </div>
          {rows.map((row) => (
            <Line key={`${row.error} ${row.state}`} row={row} name={byId.get(row.error)?.name ?? row.name} />
          ))}
        </div>
      )}
    </>
  );
}

function Side({ word, sweep }: { word: string; sweep: SweepSummary }) {
  const { id, at, by, instance, model, program_version: version } = sweep;
  return (
    <span className="cut">
      <span className="faint">{word}</span>{" "}
      <button type="button" className="link" onClick={() => showSweep(id)}>
        {dayTime(at)}
      </button>{" "}
      <span className="faint">{t("sweep.compare.of", { version, instance, model, by })}</span>
    </span>
  );
}

function Line({ row, name }: { row: SweepChange; name: string }) {
  return (
    <div className="gr" role="row" data-error={row.error}>
      <span role="cell" className="cut" title={row.error}>
        {name}
      </span>
      <span role="cell" className="cut muted">
        {stateWord(row.state)}
      </span>
      <span role="cell">
        <Outcome verdict={row.before} scans={row.scans_before} missing={row.change === "new"} />
      </span>
      <span role="cell">
        <Outcome verdict={row.after} scans={row.scans_after} missing={row.change === "gone"} />
      </span>
      <span role="cell">
        <StateWord {...LOOK[row.change]} word={t(`sweep.change.${row.change}`)} title={why(row)} />
      </span>
    </div>
  );
}

function why({ unmet = [], lost = [] }: SweepChange): string | undefined {
  const said = [
    unmet.length > 0 && t("sweep.unmet.now", { required: unmet.join(", ") }),
    lost.length > 0 && t("sweep.lost", { paths: lost.join(", ") }),
  ];
  return said.filter(Boolean).join("\n") || undefined;
}

function Outcome({ verdict, scans, missing }: { verdict: Verdict | null; scans: number | null; missing: boolean }) {
  if (missing) return <span className="faint">–</span>;
  if (verdict === null) return <span className="faint">{t("sweep.none")}</span>;
  const after = scans === null ? "" : ` · ${scans === 1 ? t("sweep.scan") : t("sweep.scans", { count: scans })}`;
  return <StateWord tone={verdict} icon={VERDICT_ICONS[verdict]} word={`${t(`verdict.${verdict}`)}${after}`} />;
}
