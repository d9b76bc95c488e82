import type { FormEvent } from "react";
import { MODES } from "../../../logic/verify/whatif";
import { cancelWhatIf, changeWhatIf, tryWhatIf, useWhatIf } from "../../../store/verify/whatif";
import { t } from "../../../text";
import { Field } from "../../../ui/Field";
import { Icon } from "../../../ui/Icon";
import { Segments } from "../../../ui/Segments";

type Name = "scan" | "window" | "values" | "vary" | "tried" | "candidates" | "condition" | "watch";

/** From which scan, which values, and what should be. */
export function WhatIfForm() {
  const { form, busy } = useWhatIf();

  function submit(event: FormEvent): void {
    event.preventDefault();
    void tryWhatIf();
  }

  const field = (name: Name, wide = false, hint = "") => (
    <Field
      label={t(`whatif.${name}`)}
      look={wide ? "sm wide" : "sm"}
      mono
      placeholder={hint}
      value={form[name]}
      onChange={(value) => changeWhatIf({ [name]: value })}
    />
  );

  return (
    <form className="whatifform" aria-label={t("whatif.form")} onSubmit={submit}>
      <Segments
        label={t("whatif.mode")}
        value={form.mode}
        options={MODES.map((value) => ({ value, word: t(`whatif.mode.${value}`) }))}
        onChoose={(mode) => changeWhatIf({ mode })}
      />
      {field("scan")}
      {field("window")}
      {form.mode === "vary" && field("vary", true)}
      {form.mode === "vary" && field("tried", true, t("whatif.tried.hint"))}
      {form.mode === "search" && field("candidates", true, t("whatif.candidates.hint"))}
      {field("values", true, t("whatif.values.hint"))}
      {field("condition", true, t("whatif.condition.hint"))}
      {field("watch", true)}
      <label className="row tight" title={t("whatif.hold.about")}>
        <input type="checkbox" checked={form.hold} onChange={({ target }) => changeWhatIf({ hold: target.checked })} />
        {t("whatif.hold")}
      </label>
      {busy ? (
        <button type="button" className="btn sm" onClick={cancelWhatIf}>
          <Icon name="x" small />
          {t("whatif.cancel")}
        </button>
      ) : (
        <button type="submit" className="btn primary sm">
          <Icon name="play" small />
          {t("whatif.do")}
        </button>
      )}
    </form>
  );
}
