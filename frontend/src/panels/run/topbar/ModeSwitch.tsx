import type { KeyboardEvent } from "react";
import { chooseMode } from "../../../store/debug/run";
import { useForbidden, usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import type { Mode } from "../../../wire/types";

const MODES: readonly Mode[] = ["PROGRAM", "MONITOR", "RUN"];

/** PROGRAM, MONITOR, RUN: what is chosen. What the PLC really does stands beside it. */
export function ModeSwitch() {
  const mode = usePlc((plc) => plc.state?.mode ?? null);
  const forbidden = useForbidden("mode");

  function onKeyDown(event: KeyboardEvent<HTMLDivElement>): void {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    const radios = [...event.currentTarget.querySelectorAll<HTMLElement>("[role=radio]")];
    const now = radios.indexOf(document.activeElement as HTMLElement);
    radios[(now + step + radios.length) % radios.length]?.focus();
  }

  return (
    <div
      className={`seg caps${forbidden === null ? "" : " lock"}`}
      role="radiogroup"
      aria-label={t("mode.label")}
      onKeyDown={onKeyDown}
    >
      {MODES.map((name) => (
        <button
          key={name}
          type="button"
          role="radio"
          className={name === mode ? "on" : ""}
          aria-checked={name === mode}
          tabIndex={name === (mode ?? "PROGRAM") ? 0 : -1}
          title={forbidden ?? t(`mode.${name}.about`)}
          disabled={forbidden !== null}
          onClick={() => void chooseMode(name)}
        >
          {name}
        </button>
      ))}
    </div>
  );
}
