import { useState } from "react";
import { grouped } from "../../../logic/format/numbers";
import { type RerunForm, readRerun } from "../../../logic/past/rerun";
import { copyName } from "../../../logic/plc/instances";
import { useCatalogue } from "../../../store/errors/catalogue";
import { beginRerun, closeRerun, type RerunWish, useReruns } from "../../../store/past/reruns";
import { useBench } from "../../../store/plc/bench";
import { useTimeline } from "../../../store/plc/timeline";
import { t } from "../../../text";
import { Field } from "../../../ui/Field";
import { FormDialog } from "../../../ui/FormDialog";

/** Asks what to change in the replay: the error, its scan, or whether it is raised at all. */
export function RerunDialog() {
  const wish = useReruns((reruns) => reruns.wish);
  return wish && <Ask key={`${wish.scan} ${wish.error} ${wish.by} ${wish.how}`} wish={wish} />;
}

function Ask({ wish }: { wish: RerunWish }) {
  const { errors, byId } = useCatalogue();
  const first = useTimeline((timeline) => timeline.info?.first_scan ?? 0);
  const [form, setForm] = useState<RerunForm>(() => formOf(wish));
  const change = (part: Partial<RerunForm>) => setForm({ ...form, ...part });
  const others = errors.filter(({ id }) => id !== wish.error);

  async function submit(): Promise<void> {
    const read = readRerun(form, wish, first);
    if ("trouble" in read) throw new Error(t(read.trouble, { first: grouped(first) }));
    await beginRerun(read.wanted);
  }

  return (
    <FormDialog
      title={t("rerun.title", { error: byId.get(wish.error)?.name ?? wish.error, scan: grouped(wish.scan) })}
      about={t("rerun.about")}
      width={520}
      submit={t("rerun.do")}
      onSubmit={submit}
      onClose={closeRerun}
    >
      <label className="field">
        <span>{t("rerun.how")}</span>
        <select
          className="inp"
          value={form.how}
          onChange={(event) => change({ how: event.target.value as RerunForm["how"] })}
        >
          <option value="same">{t("rerun.how.same")}</option>
          <option value="instead">{t("rerun.how.instead")}</option>
          <option value="out">{t("rerun.how.out")}</option>
        </select>
      </label>
      {form.how === "instead" && (
        <label className="field">
          <span>{t("rerun.error")}</span>
          <select className="inp" value={form.instead} onChange={(event) => change({ instead: event.target.value })}>
            {form.instead === "" && <option value="">–</option>}
            {others.map(({ id, name, code }) => (
              <option key={id} value={id}>
                {code ? `${name} (${code})` : name}
              </option>
            ))}
          </select>
        </label>
      )}
      {form.how !== "out" && <When form={form} scan={wish.scan} onChange={change} />}
      <Field
        label={t("rerun.scansAfter")}
        value={form.scansAfter}
        onChange={(scansAfter) => change({ scansAfter })}
        mono
      />
      <Field label={t("rerun.name")} value={form.name} onChange={(name) => change({ name })} />
    </FormDialog>
  );
}

interface WhenProps {
  form: RerunForm;
  scan: number;
  onChange: (part: Partial<RerunForm>) => void;
}

function When({ form, scan, onChange }: WhenProps) {
  const by = Number(form.by);
  const target = form.way === "same" ? scan : scan + (form.way === "earlier" ? -by : by);
  return (
    <div className="row whenrow">
      <label className="field">
        <span>{t("rerun.when")}</span>
        <select
          className="inp"
          value={form.way}
          onChange={(event) => onChange({ way: event.target.value as RerunForm["way"] })}
        >
          <option value="same">{t("rerun.when.same")}</option>
          <option value="earlier">{t("rerun.earlier")}</option>
          <option value="later">{t("rerun.later")}</option>
        </select>
      </label>
      {form.way !== "same" && (
        <>
          <Field label={t("rerun.by")} value={form.by} onChange={(text) => onChange({ by: text })} mono />
          {Number.isInteger(target) && <span className="hint">{t("rerun.where", { scan: grouped(target) })}</span>}
        </>
      )}
    </div>
  );
}

function formOf(wish: RerunWish): RerunForm {
  const { app, instance } = useBench.getState();
  const taken = (app?.instances ?? []).map(({ name }) => name);
  return {
    name: copyName(instance?.name ?? "", taken),
    how: wish.how,
    instead: "",
    way: wish.by === 0 ? "same" : wish.by < 0 ? "earlier" : "later",
    by: String(Math.abs(wish.by) || 1),
    scansAfter: "0",
  };
}
