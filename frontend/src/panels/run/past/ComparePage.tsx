import { useEffect } from "react";
import { grouped } from "../../../logic/format/numbers";
import { compareWith, shareOf, verdictOf } from "../../../logic/past/past";
import {
  chooseOther,
  compareWithOther,
  forgetComparison,
  showComparison,
  shownComparison,
  useComparisons,
} from "../../../store/past/comparisons";
import { refreshApp, useBench } from "../../../store/plc/bench";
import { t } from "../../../text";
import { Icon, type IconName } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import { StateWord } from "../../../ui/StateWord";
import type { Comparison } from "../../../wire/types";
import { Divergence } from "./Divergence";
import "./past.css";

const LOOK: Record<ReturnType<typeof verdictOf>, { icon: IconName; tone: string }> = {
  underway: { icon: "wait", tone: "stopped" },
  failed: { icon: "error", tone: "fatal" },
  same: { icon: "equal", tone: "running" },
  partly: { icon: "equal", tone: "stopped" },
  nothing: { icon: "differs", tone: "stopped" },
  apart: { icon: "differs", tone: "fatal" },
};

/** Two runs side by side: the scan in which they diverge, why, and which variables differ there. */
export function ComparePage() {
  const instance = useBench((bench) => bench.instance);
  const comparisons = useComparisons();
  // Others may have made branches or replays meanwhile.
  useEffect(() => void refreshApp().catch(() => undefined), []);
  const shown = shownComparison(comparisons);
  return (
    <div className="pane flexcol" data-pane="compare">
      <Choose />
      {comparisons.trouble && (
        <p className="trouble st fatal" role="alert">
          <Icon name="error" small />
          <span>{comparisons.trouble}</span>
        </p>
      )}
      {comparisons.list.length > 1 && <Known list={comparisons.list} shown={shown?.id ?? null} />}
      {shown && instance ? (
        <Shown key={shown.id} comparison={shown} />
      ) : (
        <p className="lonely faint">{t(instance ? "compare.none" : "sweep.noplc")}</p>
      )}
    </div>
  );
}

/** Chooses the run to compare with; its branches come first. */
function Choose() {
  const instance = useBench((bench) => bench.instance);
  const all = useBench((bench) => bench.app?.instances);
  const { other } = useComparisons();
  if (!instance) return null;
  const offered = compareWith(instance, all ?? []);
  const others = (all ?? []).length > 1;
  const chosen = offered.find(({ id }) => id === other) ?? offered[0];
  return (
    <div className="sub cmpbar" role="toolbar" aria-label={t("compare.tab")}>
      {chosen ? (
        <>
          <label className="row">
            <span className="muted nowrap">{t("compare.other", instance)}</span>
            <select className="inp sm" value={chosen.id} onChange={(event) => chooseOther(Number(event.target.value))}>
              {offered.map(({ id, name, project }) => (
                <option key={id} value={id}>
                  {project.id === instance.project.id ? name : `${project.name} / ${name}`}
                </option>
              ))}
            </select>
          </label>
          <button type="button" className="btn primary sm" onClick={() => void compareWithOther(chosen.id)}>
            {t("compare.do")}
          </button>
          <span className="hint cut">{t("compare.about")}</span>
        </>
      ) : (
        <span className="hint">{t(others ? "compare.noothermodel" : "compare.nootherhere", instance.project)}</span>
      )}
    </div>
  );
}

function useRunName(id: number): string {
  return useBench((bench) => bench.app?.instances.find((known) => known.id === id)?.name) ?? t("compare.gone", { id });
}

function Known({ list, shown }: { list: readonly Comparison[]; shown: number | null }) {
  return (
    <div className="sub cmpknown" role="toolbar" aria-label={t("compare.known")}>
      {list.map((comparison) => (
        <KnownOne key={comparison.id} comparison={comparison} on={comparison.id === shown} />
      ))}
    </div>
  );
}

function KnownOne({ comparison, on }: { comparison: Comparison; on: boolean }) {
  const name = useRunName(comparison.b);
  const verdict = verdictOf(comparison);
  return (
    <button
      type="button"
      className={`btn quiet sm${on ? " is-on" : ""}`}
      aria-pressed={on}
      onClick={() => showComparison(comparison.id)}
    >
      <StateWord {...LOOK[verdict]} word={name} title={word(comparison)} />
    </button>
  );
}

function word(comparison: Comparison): string {
  const verdict = verdictOf(comparison);
  if (verdict === "failed") return t("compare.failed");
  if (verdict === "same") return t("compare.same");
  if (verdict === "partly") return t("compare.partly");
  if (verdict === "nothing") return t("compare.nothing");
  if (verdict === "apart") return t("compare.apart", { scan: grouped(comparison.result?.scan ?? 0) });
  return t("compare.progress", { done: grouped(comparison.done), of: grouped(comparison.of) });
}

function Shown({ comparison }: { comparison: Comparison }) {
  const { a, b, by, id, result, message } = comparison;
  const names = { A: useRunName(a), B: useRunName(b) };
  const verdict = verdictOf(comparison);
  const underway = verdict === "underway";
  return (
    <section className="cmpview" aria-label={t("compare.with", { name: names.B })}>
      <div className="cmphead">
        <StateWord {...LOOK[verdict]} word={word(comparison)} />
        <span className="cut">
          <b>A</b> {names.A} <span className="faint">·</span> <b>B</b> {names.B}
        </span>
        <span className="faint cut">{t("compare.by", { by })}</span>
        <span className="grow" />
        {underway ? (
          <button type="button" className="btn sm" onClick={() => void forgetComparison(id)}>
            {t("compare.cancel")}
          </button>
        ) : (
          <IconButton icon="trash" small label={t("compare.forget")} onClick={() => void forgetComparison(id)} />
        )}
      </div>
      {underway && <Progress of={comparison} label={word(comparison)} />}
      {message && (
        <p className="trouble st fatal" role="alert">
          <Icon name="error" small />
          <span>{message}</span>
        </p>
      )}
      {result && <Divergence result={result} b={b} names={names} />}
    </section>
  );
}

function Progress({ of, label }: { of: Comparison; label: string }) {
  return (
    <span
      className="progress"
      role="progressbar"
      aria-label={t("compare.tab")}
      aria-valuemin={0}
      aria-valuemax={of.of}
      aria-valuenow={of.done}
      aria-valuetext={label}
    >
      <i style={{ width: `${shareOf(of) * 100}%` }} />
    </span>
  );
}
