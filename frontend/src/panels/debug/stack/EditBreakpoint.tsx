import { useState } from "react";
import { placeOf, type Wanted } from "../../../logic/debug/breakpoints";
import { allErrors } from "../../../logic/errors/catalogue";
import { reasonOf, removeBreakpoints, setBreakpoint, wantedOf } from "../../../store/debug/debug";
import { useBench } from "../../../store/plc/bench";
import { t } from "../../../text";
import { Field } from "../../../ui/Field";
import { FormDialog } from "../../../ui/FormDialog";
import type { BreakpointInfo } from "../../../wire/types";

interface Props {
  /** An existing breakpoint has an id. */
  known: Wanted | BreakpointInfo;
  onClose: () => void;
}

const ACCESS = ["change", "write", "read", "access"] as const;

/** The form of a breakpoint that belongs to no line: what it watches, and when it halts. */
export function EditBreakpoint({ known, onClose }: Props) {
  const id = "id" in known ? known.id : null;
  const [wanted, setWanted] = useState<Wanted>("id" in known ? wantedOf(known) : known);
  const [scan, setScan] = useState(known.scan > 0 ? String(known.scan) : "");
  const change = (part: Partial<Wanted>) => setWanted({ ...wanted, ...part });

  async function submit(): Promise<void> {
    const missing = missingIn(wanted, scan);
    if (missing) throw new Error(missing);
    const answer = await setBreakpoint({ ...wanted, scan: wanted.kind === "scan" ? Number(scan) : 0 }, id).catch(
      (error: unknown) => Promise.reject(new Error(reasonOf(error))),
    );
    if (answer.trouble === null) return;
    // A new one that can never halt is removed again: only this dialog shows it, so nobody could correct it later.
    if (id === null && answer.id !== null) await removeBreakpoints([answer.id]);
    throw new Error(answer.trouble);
  }

  return (
    <FormDialog
      title={id === null ? t(`debug.new.${newName(wanted.kind)}`) : placeOf(known)}
      about={t("debug.edit.about")}
      submit={t(id === null ? "debug.form.set" : "debug.form.change")}
      onSubmit={submit}
      onClose={onClose}
    >
      {wanted.kind === "data" && <Data wanted={wanted} onChange={change} />}
      {wanted.kind === "error" && <RaisedError wanted={wanted} onChange={change} />}
      {wanted.kind === "scan" && (
        <Field label={t("debug.edit.scan")} value={scan} onChange={setScan} mono placeholder="4711" />
      )}
      <Field
        label={t("debug.form.condition")}
        value={wanted.condition}
        onChange={(condition) => change({ condition })}
        mono
        placeholder="Main.count > 3"
      />
      <Field
        label={t("debug.form.hits")}
        value={wanted.hits}
        onChange={(hits) => change({ hits })}
        mono
        placeholder={t("debug.form.hits.hint")}
      />
    </FormDialog>
  );
}

const newName = (kind: Wanted["kind"]) => (kind === "line" ? "data" : kind);

function missingIn(wanted: Wanted, scan: string): string | null {
  if (wanted.kind === "data" && !wanted.path.trim()) return t("debug.edit.nopath");
  if (wanted.kind === "scan" && !/^[1-9]\d*$/.test(scan.trim())) return t("debug.edit.noscan");
  return null;
}

interface PartProps {
  wanted: Wanted;
  onChange: (part: Partial<Wanted>) => void;
}

function Data({ wanted, onChange }: PartProps) {
  return (
    <>
      <Field
        label={t("debug.edit.path")}
        value={wanted.path}
        onChange={(path) => onChange({ path })}
        mono
        placeholder="Main.belt[3].speed"
      />
      <label className="field">
        <span>{t("debug.edit.access")}</span>
        <select
          className="inp"
          value={wanted.access}
          onChange={(event) => onChange({ access: event.target.value as Wanted["access"] })}
        >
          {ACCESS.map((access) => (
            <option key={access} value={access}>
              {t(`debug.access.${access}`)}
            </option>
          ))}
        </select>
      </label>
    </>
  );
}

function RaisedError({ wanted, onChange }: PartProps) {
  const model = useBench((bench) => bench.model);
  return (
    <label className="field">
      <span>{t("debug.edit.error")}</span>
      <select className="inp" value={wanted.error} onChange={(event) => onChange({ error: event.target.value })}>
        <option value="">{t("debug.bp.anyerror")}</option>
        {allErrors(model?.catalogue ?? []).map(({ id, name }) => (
          <option key={id} value={id}>
            {name}
          </option>
        ))}
      </select>
    </label>
  );
}
