import type { FormEvent } from "react";
import { useShallow } from "zustand/react/shallow";
import { useForbidden } from "../../../store/plc/plc";
import { disturb, mendDisturbance, useDisturb, useTroubles } from "../../../store/verify/disturb";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { KindChoice } from "./KindChoice";
import { WhatFields } from "./WhatFields";
import { WhenFields } from "./WhenFields";

/** The form for a new disturbance: what, when, and the problems of the entries. Entries stay until they are changed. */
export function DisturbForm() {
  const { form, tried } = useDisturb(useShallow((state) => ({ form: state.form, tried: state.tried })));
  const busy = useDisturb((state) => state.busy);
  const forbidden = useForbidden("errors");
  const troubles = useTroubles();
  const [first] = Object.values(troubles);

  function submit(event: FormEvent): void {
    event.preventDefault();
    if (forbidden === null) void disturb();
  }

  return (
    <form className="disturbform" aria-label={t("disturb.form")} onSubmit={submit}>
      <div className="fields">
        <KindChoice kind={form.kind} />
        <WhatFields form={form} troubles={tried ? troubles : {}} />
        <WhenFields form={form} troubles={tried ? troubles : {}} />
      </div>
      {tried && first && (
        <p className="hint bad" role="alert">
          <Icon name="error" small />
          {t(first)}
        </p>
      )}
      <Outcome />
      <div className="acts">
        <button
          type="submit"
          className="btn primary sm"
          disabled={forbidden !== null || busy}
          title={forbidden ?? undefined}
        >
          <Icon name="disturbance" small />
          {t("disturb.do")}
        </button>
      </div>
    </form>
  );
}

/** The result of the last request. */
function Outcome() {
  const outcome = useDisturb((state) => state.outcome);
  if (outcome && !outcome.ok) {
    return (
      <p className="trouble st fatal" role="alert">
        <Icon name="error" small />
        <span>
          {outcome.message}
          {outcome.near.map((name) => (
            <button key={name} type="button" className="link" onClick={() => mendDisturbance(name)}>
              {t("import.trace.take", { path: name })}
            </button>
          ))}
        </span>
      </p>
    );
  }
  return (
    <p className="told muted" role="status">
      {outcome?.message}
    </p>
  );
}
