import { type KeyboardEvent, useEffect, useId, useState } from "react";
import { bytes, grouped } from "../../logic/format/numbers";
import { COMPARES, scansBefore, spanText, WHENS } from "../../logic/trace/plots";
import { change } from "../../store/trace/traces";
import { t } from "../../text";
import type { TraceInfo, TraceTrigger, TraceWhen } from "../../wire/types";

/** The trigger of the trace, its sample rate and its length: each entry takes effect at once. */
export function Settings({ trace }: { trace: TraceInfo }) {
  const { definition } = trace;
  const { trigger } = definition;
  const id = useId();
  // A condition can be chosen before there is a variable for it: it is stored here until then.
  const [when, setWhen] = useState<TraceWhen>(trigger?.when ?? "rises");
  const [value, setValue] = useState(trigger?.value ?? "");
  useEffect(() => {
    if (trigger) {
      setWhen(trigger.when);
      setValue(trigger.value);
    }
  }, [trigger]);

  function changeTrigger(part: Partial<TraceTrigger>): void {
    const text = part.text ?? trigger?.text ?? "";
    if (text.trim() === "") {
      if (trigger) void change({ trigger: null, repeat: false });
      return;
    }
    const next = { text, when, value, before: trigger?.before ?? 50, ...part };
    if (COMPARES.has(next.when) && next.value.trim() === "") return; // the value is entered next
    void change({ trigger: next });
  }

  const number = signalIsNumber(trace, trigger?.text ?? "");
  return (
    <div className="trset">
      <h2>{t("trace.trigger")}</h2>
      <div className="frow wide">
        <label htmlFor={`${id}-when`}>{t("trace.when")}</label>
        <Entry
          id={`${id}-when`}
          value={trigger?.text ?? ""}
          placeholder={t("trace.when.none")}
          list={`${id}-signals`}
          mono
          onCommit={(text) => changeTrigger({ text })}
        />
        <select
          className="inp sm"
          aria-label={t("trace.when.how")}
          value={when}
          onChange={(event) => {
            const chosen = event.target.value as TraceWhen;
            setWhen(chosen);
            changeTrigger({ when: chosen });
          }}
        >
          {WHENS.map((one) => (
            <option key={one} value={one}>
              {t(`trace.when.${one}`)}
            </option>
          ))}
        </select>
        <datalist id={`${id}-signals`}>
          {definition.signals.map((signal) => (
            <option key={signal} value={signal} />
          ))}
        </datalist>
      </div>
      {(COMPARES.has(when) || number || value !== "") && when !== "holds" && (
        <div className="frow">
          <label htmlFor={`${id}-value`}>{t("trace.value")}</label>
          <Entry
            id={`${id}-value`}
            value={value}
            mono
            onCommit={(text) => {
              setValue(text);
              changeTrigger({ value: text });
            }}
          />
          <span className="hint">{COMPARES.has(when) ? "" : t("trace.value.hint")}</span>
        </div>
      )}
      <div className="frow">
        <label htmlFor={`${id}-before`}>{t("trace.before")}</label>
        <Entry
          id={`${id}-before`}
          value={String(trigger?.before ?? 50)}
          unit="%"
          mono
          disabled={!trigger}
          onCommit={(text) => {
            const before = wholeNumber(text, 0, 100);
            if (before !== null) changeTrigger({ before });
          }}
        />
        <span className="hint">
          {trigger && t("trace.before.of", { before: grouped(scansBefore(trace)), scans: grouped(definition.scans) })}
        </span>
      </div>
      <label className="row tight trrepeat">
        <input
          type="checkbox"
          className="box"
          checked={definition.repeat}
          disabled={!trigger}
          onChange={(event) => void change({ repeat: event.target.checked })}
        />
        {t("trace.repeat")}
      </label>
      <h2>{t("trace.sampling")}</h2>
      <div className="frow">
        <label htmlFor={`${id}-every`}>{t("trace.every")}</label>
        <Entry
          id={`${id}-every`}
          value={String(definition.every)}
          unit={t("trace.scans")}
          mono
          onCommit={(text) => {
            const every = wholeNumber(text, 1, 1_000_000);
            if (every !== null) void change({ every });
          }}
        />
        <span className="hint">{t("trace.nonelost")}</span>
      </div>
      <div className="frow">
        <label htmlFor={`${id}-scans`}>{t("trace.buffer")}</label>
        <Entry
          id={`${id}-scans`}
          value={grouped(definition.scans)}
          unit={t("trace.scans")}
          mono
          onCommit={(text) => {
            const scans = wholeNumber(text, 2, 10_000_000);
            if (scans !== null) void change({ scans });
          }}
        />
        <span className="hint">
          {bytes(trace.bytes)}
          {trace.interval_ns > 0 && `, ${spanText(definition.scans * trace.interval_ns)}`}
        </span>
      </div>
    </div>
  );
}

function signalIsNumber({ signals }: TraceInfo, text: string): boolean {
  const signal = signals.find((known) => known.text === text);
  return signal !== undefined && signal.kind !== "bool";
}

function wholeNumber(text: string, least: number, most: number): number | null {
  const digits = text.replace(/[\s\u2009,_]/g, "");
  if (!/^\d+$/.test(digits)) return null;
  return Math.max(least, Math.min(most, Number(digits)));
}

interface EntryProps {
  id: string;
  value: string;
  unit?: string;
  placeholder?: string;
  list?: string;
  mono?: boolean;
  disabled?: boolean;
  onCommit: (text: string) => void;
}

/** A field whose entry takes effect on Enter, or when the field is left; Escape discards it. */
function Entry({ id, value, unit, placeholder, list, mono, disabled, onCommit }: EntryProps) {
  const [typed, setTyped] = useState<string | null>(null);
  function commit(): void {
    if (typed === null) return;
    setTyped(null);
    if (typed.trim() !== value.trim()) onCommit(typed.trim());
  }
  function onKeyDown(event: KeyboardEvent): void {
    if (event.key === "Enter") commit();
    else if (event.key === "Escape" && typed !== null) {
      setTyped(null);
      event.stopPropagation();
    }
  }
  return (
    <span className="inp sm">
      <input
        id={id}
        className={mono ? "mono" : ""}
        value={typed ?? value}
        placeholder={placeholder}
        list={list}
        disabled={disabled}
        spellCheck={false}
        autoComplete="off"
        onChange={(event) => setTyped(event.target.value)}
        onKeyDown={onKeyDown}
        onBlur={commit}
      />
      {unit && <span className="faint">{unit}</span>}
    </span>
  );
}
