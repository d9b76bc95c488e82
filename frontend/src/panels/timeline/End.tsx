import { type FormEvent, useState } from "react";
import { grouped } from "../../logic/numbers";
import { showState } from "../../logic/plcstate";
import { t } from "../../logic/text";
import { readScan } from "../../logic/timeline";
import { useForbidden, useOnline, usePlc } from "../../store/plc";
import { runAction } from "../../store/run";
import { travel } from "../../store/timeline";
import { StateWord } from "../../ui/StateWord";
import type { RunOnAxis } from "./useRun";

/** At the right: whether this is now, where a run is on its way to, and the scan to go to by its number. */
export function End({ run }: { run: RunOnAxis | null }) {
  const online = useOnline();
  const state = usePlc((plc) => plc.state);
  const locked = useForbidden("travel");
  const shown = showState(state, online);
  const target = state?.state === "running" ? state.target : "";
  return (
    <div className="tl-end">
      {target ? (
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
          <span className="hint cut">{run?.past ? t("timeline.return") : t("timeline.hint")}</span>
        </span>
      )}
      {run && <GoTo run={run} locked={locked} />}
    </div>
  );
}

function GoTo({ run, locked }: { run: RunOnAxis; locked: string | null }) {
  const [text, setText] = useState("");
  const [bad, setBad] = useState(false);
  const { from, to } = run.whole;
  const why = bad ? t("timeline.goto.bad", { first: grouped(from), live: grouped(to) }) : null;

  function onSubmit(event: FormEvent): void {
    event.preventDefault();
    const scan = readScan(text);
    const fine = scan !== null && scan >= from && scan <= to;
    setBad(!fine);
    if (!fine) return;
    setText("");
    void travel(scan);
  }

  return (
    <form onSubmit={onSubmit} className="row tight">
      <input
        className={`inp sm grow mono${why ? " bad" : ""}`}
        aria-label={t("timeline.goto")}
        aria-invalid={why !== null}
        title={locked ?? why ?? t("timeline.goto")}
        placeholder={t("timeline.goto")}
        inputMode="numeric"
        value={text}
        disabled={locked !== null}
        onChange={(event) => {
          setText(event.target.value);
          setBad(false);
        }}
      />
      <span className="sr" role="alert">
        {why}
      </span>
    </form>
  );
}
