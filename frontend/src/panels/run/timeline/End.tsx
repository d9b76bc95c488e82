import { type FormEvent, useEffect, useState } from "react";
import { grouped } from "../../../logic/format/numbers";
import { showState } from "../../../logic/plc/plcstate";
import { readScan, readTime } from "../../../logic/plc/timeline";
import { runAction } from "../../../store/debug/run";
import { useForbidden, useOnline, usePlc } from "../../../store/plc/plc";
import { travel } from "../../../store/plc/timeline";
import { t } from "../../../text";
import { StateWord } from "../../../ui/StateWord";
import { type RunOnAxis, scanOfTime } from "./useRun";

/** The right end: whether the page is live, the target of a run, and a field for a scan to go to. */
export function End({ run }: { run: RunOnAxis | null }) {
  const online = useOnline();
  const state = usePlc((plc) => plc.state);
  const locked = useForbidden("travel");
  const shown = showState(state, online);
  const target = state?.state === "running" ? state.target : "";
  const [bad, setBad] = useState<string | null>(null);
  const [text, setText] = useState("");
  const scan = state?.past ? state.scan : null;
  // A wrong scan and the message about it disappear when a different scan is shown.
  // biome-ignore lint/correctness/useExhaustiveDependencies: runs when a different scan is shown
  useEffect(() => {
    if (bad !== null) setText("");
    setBad(null);
  }, [scan]);
  return (
    <div className="tl-end">
      {bad ? (
        <span className="hint bad cut" role="alert" title={bad}>
          {bad}
        </span>
      ) : target ? (
        <span className="row tight">
          <StateWord tone="running" icon="running" word={target} title={target} />
          <span className="grow" />
          <button
            type="button"
            className="btn sm"
            title={t("run.stop.hint", { target })}
            onClick={() => void runAction("pause")}
          >
            {t("run.stop")}
          </button>
        </span>
      ) : (
        <span className="row tight apart">
          <StateWord
            tone={shown.tone}
            icon={shown.icon}
            word={run?.past || !online ? shown.word : t("timeline.live")}
          />
          {run && (
            <span className="hint cut" title={run.past ? t("timeline.return") : undefined}>
              {run.past ? "Shift+Esc" : t("timeline.hint")}
            </span>
          )}
        </span>
      )}
      {run && <GoTo run={run} locked={locked} text={text} onText={setText} bad={bad} onBad={setBad} />}
    </div>
  );
}

interface GoToProps {
  run: RunOnAxis;
  locked: string | null;
  text: string;
  onText: (text: string) => void;
  bad: string | null;
  onBad: (why: string | null) => void;
}

function GoTo({ run, locked, text, onText, bad, onBad }: GoToProps) {
  const interval = usePlc((plc) => plc.state?.interval_ns ?? 0);
  const { from, to } = run.whole;

  function onSubmit(event: FormEvent): void {
    event.preventDefault();
    const time = readTime(text);
    const scan = time === null ? readScan(text) : scanOfTime(time, interval);
    const fine = scan !== null && scan >= from && scan <= to;
    onBad(fine ? null : t("timeline.goto.bad", { first: grouped(from), live: grouped(to) }));
    if (!fine) return;
    onText("");
    void travel(scan);
  }

  return (
    <form onSubmit={onSubmit} className="row tight">
      <input
        className={`inp sm grow mono${bad ? " bad" : ""}`}
        aria-label={t("timeline.goto")}
        aria-invalid={bad !== null}
        title={locked ?? bad ?? t("timeline.goto.about")}
        placeholder={t("timeline.goto")}
        value={text}
        disabled={locked !== null}
        onChange={(event) => {
          onText(event.target.value);
          onBad(null);
        }}
      />
    </form>
  );
}
