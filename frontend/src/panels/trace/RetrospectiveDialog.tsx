import { useState } from "react";
import { grouped, interval } from "../../logic/format/numbers";
import { spanText } from "../../logic/trace/plots";
import { usePlc } from "../../store/plc/plc";
import { liveScan, useTimeline } from "../../store/plc/timeline";
import { recordEarlier, shownOf, useTraces } from "../../store/trace/traces";
import { t } from "../../text";
import { Field } from "../../ui/Field";
import { FormDialog } from "../../ui/FormDialog";

/** The retrospective trace: the last scans of any variables, computed from the journal. */
export function RetrospectiveDialog({ onClose }: { onClose: () => void }) {
  const shown = shownOf(useTraces());
  const kept = useTimeline((run) => run.info?.first_scan ?? 0);
  const period = usePlc((plc) => plc.state?.interval_ns ?? 0);
  const [signals, setSignals] = useState(shown?.signals.map(({ text }) => text).join("\n") ?? "");
  const [scans, setScans] = useState("1000");
  const [every, setEvery] = useState("1");
  const there = liveScan() - kept;
  const count = Number(scans.replace(/\D/g, ""));

  async function submit(): Promise<void> {
    const wanted = signals
      .split("\n")
      .map((line) => line.trim())
      .filter(Boolean);
    if (wanted.length === 0) throw new Error(t("trace.retrospective.nosignals"));
    if (!(count > 0)) throw new Error(t("trace.retrospective.noscans"));
    await recordEarlier(wanted, Math.min(count, there), Math.max(1, Number(every) || 1));
  }

  return (
    <FormDialog
      title={t("trace.retrospective.title")}
      about={t("trace.retrospective.about")}
      submit={t("trace.retrospective.record")}
      onSubmit={submit}
      onClose={onClose}
    >
      {({ refused }) => (
        <>
          <label className="field">
            <span>{t("trace.retrospective.signals")}</span>
            <textarea
              className="inp mono trsignals"
              rows={6}
              value={signals}
              spellCheck={false}
              onChange={(event) => setSignals(event.target.value)}
            />
          </label>
          <Field
            label={t("trace.retrospective.scans", { there: grouped(there) })}
            value={scans}
            onChange={setScans}
            mono
          />
          <Field label={t("trace.retrospective.every")} value={every} onChange={setEvery} mono refused={refused} />
          <p className="hint">
            {t("trace.retrospective.span", {
              span: spanText(Math.min(count, there) * period),
              interval: interval(period),
            })}
          </p>
        </>
      )}
    </FormDialog>
  );
}
