import { type FormEvent, type KeyboardEvent, useEffect, useRef, useState } from "react";
import type { Wanted } from "../../../logic/debug/breakpoints";
import { type Editing, reasonOf, removeBreakpoints, setBreakpoint } from "../../../store/debug/debug";
import { loadInstances, useSeenAs } from "../../../store/debug/seenAs";
import { useTasks } from "../../../store/plc/tasks";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { Segments } from "../../../ui/Segments";

interface Props {
  editing: Editing;
  /** The POU whose instances can be chosen; undefined outside a POU. */
  pou: string | undefined;
  onClose: () => void;
}

const DOES = ["halt", "log", "assign"] as const;

/** The form below the line of a breakpoint: when it halts, and what it does. A refused condition stays, with the reason. */
export function BreakpointForm({ editing, pou, onClose }: Props) {
  const [wanted, setWanted] = useState(editing.wanted);
  const [does, setDoes] = useState(editing.does);
  const [id, setId] = useState(editing.id);
  const [refused, setRefused] = useState<string | null>(null);
  const form = useRef<HTMLFormElement>(null);
  useEffect(() => form.current?.querySelector<HTMLElement>("[data-first]")?.focus(), []);
  const change = (part: Partial<Wanted>) => {
    setRefused(null);
    setWanted({ ...wanted, ...part });
  };

  async function submit(event: FormEvent): Promise<void> {
    event.preventDefault();
    const asked = { ...wanted, ...(does === "log" ? {} : { log: "" }), ...(does === "assign" ? {} : { assign: "" }) };
    if ((does === "log" && !asked.log.trim()) || (does === "assign" && !asked.assign.trim())) {
      setRefused(t(`debug.form.${does}.missing`));
      return;
    }
    try {
      const answer = await setBreakpoint(asked, id);
      if (answer.trouble === null) onClose();
      else {
        setId(answer.id);
        setRefused(answer.trouble);
      }
    } catch (error) {
      setRefused(reasonOf(error));
    }
  }

  function onKeyDown(event: KeyboardEvent): void {
    event.stopPropagation();
    if (event.key === "Escape") onClose();
  }

  const line = editing.wanted.kind === "line" ? editing.line : null;
  return (
    <form
      ref={form}
      className="bpform"
      aria-label={line === null ? t("debug.form.other") : t("debug.form", { line })}
      onSubmit={(event) => void submit(event)}
      onKeyDown={onKeyDown}
    >
      <div className="row wrap">
        <Segments
          label={t("debug.form.does")}
          look=""
          value={does}
          options={DOES.map((each) => ({ value: each, word: t(`debug.form.${each}`) }))}
          onChoose={setDoes}
        />
        {does !== "halt" && (
          <Entry
            label={t(`debug.form.${does}.label`)}
            hint={t(`debug.form.${does}.hint`)}
            value={wanted[does]}
            onChange={(text) => change({ [does]: text })}
            first
            wide
          />
        )}
        <Entry
          label={t("debug.form.condition")}
          hint={t("debug.form.condition.hint")}
          value={wanted.condition}
          onChange={(condition) => change({ condition })}
          first={does === "halt"}
          wide
        />
        <Entry
          label={t("debug.form.hits")}
          hint={t("debug.form.hits.hint")}
          value={wanted.hits}
          onChange={(hits) => change({ hits })}
        />
        {pou !== undefined && (
          <Instances pou={pou} value={wanted.instance} onChange={(instance) => change({ instance })} />
        )}
        <Tasks value={wanted.task} onChange={(task) => change({ task })} />
      </div>
      <div className="row">
        <label className="row">
          <input
            type="checkbox"
            className="box"
            checked={wanted.enabled}
            onChange={(event) => change({ enabled: event.target.checked })}
          />
          {t("debug.form.enabled")}
        </label>
        {refused && (
          <span className="hint bad" role="alert">
            <Icon name="error" small />
            {refused}
          </span>
        )}
        <span className="grow" />
        {id !== null && (
          <button
            type="button"
            className="btn quiet sm"
            onClick={() => {
              void removeBreakpoints([id]);
              onClose();
            }}
          >
            {t("debug.bp.remove")}
          </button>
        )}
        <button type="button" className="btn quiet sm" onClick={onClose}>
          {t("cancel")}
        </button>
        <button type="submit" className="btn primary sm">
          {t(id === null ? "debug.form.set" : "debug.form.change")}
        </button>
      </div>
    </form>
  );
}

interface EntryProps {
  label: string;
  hint: string;
  value: string;
  onChange: (text: string) => void;
  first?: boolean;
  wide?: boolean;
}

function Entry({ label, hint, value, onChange, first = false, wide = false }: EntryProps) {
  return (
    <label className={`field${wide ? " wide" : ""}`}>
      <span>{label}</span>
      <input
        className="inp sm mono"
        value={value}
        placeholder={hint}
        title={hint}
        spellCheck={false}
        autoComplete="off"
        data-first={first || undefined}
        onChange={(event) => onChange(event.target.value)}
      />
    </label>
  );
}

interface ChoiceProps {
  value: string;
  onChange: (text: string) => void;
}

function Instances({ pou, value, onChange }: ChoiceProps & { pou: string }) {
  const instances = useSeenAs((seen) => seen.instances.get(pou.toUpperCase()));
  useEffect(() => void loadInstances(pou), [pou]);
  const all = new Set([...(instances ?? []), ...(value ? [value] : [])]);
  if (all.size < 2 && value === "") return null;
  return (
    <Choice
      label={t("debug.form.instance")}
      any={t("debug.form.any")}
      all={[...all]}
      value={value}
      onChange={onChange}
    />
  );
}

function Tasks({ value, onChange }: ChoiceProps) {
  const tasks = useTasks();
  const all = new Set([...tasks, ...(value ? [value] : [])]);
  if (all.size < 2 && value === "") return null;
  return (
    <Choice label={t("debug.form.task")} any={t("debug.form.any")} all={[...all]} value={value} onChange={onChange} />
  );
}

function Choice({ label, any, all, value, onChange }: ChoiceProps & { label: string; any: string; all: string[] }) {
  return (
    <label className="field">
      <span>{label}</span>
      <select className="inp sm" value={value} onChange={(event) => onChange(event.target.value)}>
        <option value="">{any}</option>
        {all.map((each) => (
          <option key={each}>{each}</option>
        ))}
      </select>
    </label>
  );
}
