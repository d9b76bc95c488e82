import { type ReactNode, useEffect, useState } from "react";
import { tickedToRaise, toRaise } from "../../../logic/errors/fitted";
import { grouped } from "../../../logic/format/numbers";
import { useCatalogue } from "../../../store/errors/catalogue";
import { useKnownHardware } from "../../../store/errors/hardware";
import { useSimulator } from "../../../store/errors/simulator";
import { beginSweep, closeQuestion, useSweeps } from "../../../store/errors/sweeps";
import { useBench } from "../../../store/plc/bench";
import { usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Field } from "../../../ui/Field";
import { FormDialog } from "../../../ui/FormDialog";
import { Icon } from "../../../ui/Icon";
import { KeepHere } from "./KeepHere";

type Which = "all" | "nonfatal" | "ticked";

const WINDOW = 200;
const WINDOW_MOST = 100_000;

/** Asks which errors are raised, from which states, and for how long the program is watched after each. */
export function RunAll() {
  const { errors } = useCatalogue();
  const instance = useBench((bench) => bench.instance);
  const ticked = useSimulator((simulator) => simulator.checked);
  const scan = usePlc((plc) => plc.state?.past?.live_scan ?? plc.state?.scan ?? 0);
  const present = usePlc((plc) => [...plc.errors.values()].filter(({ status }) => status === "generated").length);
  const fitted = useKnownHardware();
  const states = useSweeps((sweeps) => sweeps.states);
  const [which, setWhich] = useState<Which>(ticked.size > 1 ? "ticked" : "all");
  const [from, setFrom] = useState<"now" | "states">(states.length > 0 ? "states" : "now");
  const [left, setLeft] = useState<ReadonlySet<number>>(new Set());
  const [window, setWindow] = useState(String(WINDOW));
  // The states of the project may arrive after the dialog has opened.
  useEffect(() => setFrom(states.length > 0 ? "states" : "now"), [states.length]);

  const nonfatal = errors.filter(({ severity }) => severity === "nonfatal");
  const chosen = {
    all: toRaise(errors, fitted),
    nonfatal: toRaise(nonfatal, fitted),
    ticked: tickedToRaise(ticked, errors, fitted),
  };
  const { keys, absent } = chosen[which];
  const count = keys.length;
  const begins = from === "now" ? [] : states.filter(({ id }) => !left.has(id));
  const points = from === "now" ? 1 : begins.length;
  const scans = /^\d+$/.test(window.trim()) ? Number(window) : 0;
  const badWindow = scans < 1 || scans > WINDOW_MOST ? t("sweep.run.window.bad", { most: grouped(WINDOW_MOST) }) : null;
  const why = count === 0 ? t("sweep.run.noerrors") : points === 0 ? t("sweep.run.nostates") : null;

  async function begin(): Promise<void> {
    await beginSweep({
      // Whole kinds also have a row for each choice of details that the program tells apart.
      errors: which === "all" ? null : which === "nonfatal" ? nonfatal.map(({ id }) => id) : keys,
      states: begins.map(({ id }) => id),
      window: scans,
    });
  }

  const toggle = (id: number) => {
    const next = new Set(left);
    if (!next.delete(id)) next.add(id);
    setLeft(next);
  };

  return (
    <FormDialog
      title={t("sweep.run.title")}
      about={t("sweep.run.about")}
      width={560}
      submit={t("sweep.run.do", { count: grouped(count * points) })}
      disabled={why !== null || badWindow !== null}
      onSubmit={begin}
      onClose={closeQuestion}
      aside={({ refused }) => <Outlook refused={refused} why={why} count={count} points={points} absent={absent} />}
    >
      <fieldset className="choices">
        <legend>{t("sweep.run.errors")}</legend>
        {(["all", "nonfatal", "ticked"] as const).map((value) => (
          <Radio
            key={value}
            name="errors"
            on={which === value}
            disabled={value === "ticked" && ticked.size === 0}
            onChoose={() => setWhich(value)}
          >
            {t(`sweep.run.${value}`)} <span className="faint">{chosen[value].keys.length}</span>
          </Radio>
        ))}
      </fieldset>
      <fieldset className="choices">
        <legend>{t("sweep.run.states")}</legend>
        <Radio name="from" on={from === "now"} onChoose={() => setFrom("now")}>
          {t("sweep.run.now", { name: instance?.name ?? "" })}{" "}
          <span className="faint">{t("sweep.run.scan", { scan: grouped(scan) })}</span>
        </Radio>
        {from === "now" && present > 0 && <p className="hint">{t("sweep.run.present", { count: present })}</p>}
        <Radio name="from" on={from === "states"} disabled={states.length === 0} onChoose={() => setFrom("states")}>
          {t("sweep.run.kept")} <span className="faint">{states.length === 0 ? t("sweep.run.kept.none") : ""}</span>
        </Radio>
        {states.length > 0 && (
          <ul className="picks">
            {states.map((state) => (
              <li key={state.id}>
                <label htmlFor={`state-${state.id}`}>
                  <input
                    id={`state-${state.id}`}
                    type="checkbox"
                    className="box"
                    aria-label={state.name}
                    checked={!left.has(state.id)}
                    disabled={from === "now"}
                    onChange={() => toggle(state.id)}
                  />
                  <span className="cut">{state.name}</span>
                  <span className="faint cut">
                    {t("sweep.run.kept.of", {
                      instance: state.instance,
                      scan: grouped(state.scan),
                      version: state.program_version,
                    })}
                  </span>
                </label>
              </li>
            ))}
          </ul>
        )}
        <KeepHere taken={states.map(({ name }) => name)} />
      </fieldset>
      <Field label={t("sweep.run.window")} value={window} onChange={setWindow} refused={badWindow} mono />
    </FormDialog>
  );
}

interface OutlookProps {
  refused: string | null;
  why: string | null;
  count: number;
  points: number;
  /** So many are left out, as their hardware is not fitted. */
  absent: number;
}

/** How many runs it will take, or why the sweep cannot begin. */
function Outlook({ refused, why, count, points, absent }: OutlookProps) {
  if (refused)
    return (
      <span className="hint bad grow" role="alert">
        <Icon name="error" small />
        {refused}
      </span>
    );
  return (
    <span className="hint grow" role="status">
      {why ?? t("sweep.run.outlook", { errors: count, count: points })}
      {absent > 0 && ` ${t("sweep.run.absent", { count: absent })}`}
    </span>
  );
}

interface RadioProps {
  name: string;
  on: boolean;
  disabled?: boolean;
  onChoose: () => void;
  children: ReactNode;
}

function Radio({ name, on, disabled = false, onChoose, children }: RadioProps) {
  return (
    <label className={`radiorow${disabled ? " off" : ""}`}>
      <input type="radio" className="radio" name={name} checked={on} disabled={disabled} onChange={onChoose} />
      <span>{children}</span>
    </label>
  );
}
