import { allErrors, inNames } from "../../logic/catalogue";
import { t } from "../../logic/text";
import { useForbidden, usePlc } from "../../store/plc";
import { generate, recover, targets, useSimulator } from "../../store/simulator";
import { Icon } from "../../ui/Icon";
import type { ModelInfo } from "../../wire/types";

/** Generate what is ticked (or selected), recover it, or clear everything that is generated. */
export function Actions({ model }: { model: ModelInfo }) {
  const state = useSimulator();
  const errors = usePlc((plc) => plc.errors);
  const forbidden = useForbidden("errors");
  const locked = forbidden !== null;
  const why = forbidden ?? undefined;
  const chosen = targets(state);
  const raised = chosen.filter((id) => errors.get(id)?.status === "generated").length;
  const any = [...errors.values()].some((row) => row.status === "generated");
  const { outcome } = state;
  const message = inNames(allErrors(model.catalogue), outcome?.message ?? "");
  return (
    <>
      {outcome && !outcome.ok && (
        <p className="trouble st fatal" role="alert">
          <Icon name="error" small />
          <span>{message || t("notsent.about")}</span>
        </p>
      )}
      <p className="outcome muted" role="status">
        {outcome?.ok ? message : ""}
      </p>
      <div className="acts">
        <button
          type="button"
          className="btn primary sm"
          disabled={locked || chosen.length === 0}
          title={why}
          onClick={() => void generate(model)}
        >
          <Icon name="generated" small />
          {chosen.length > 1 ? t("errors.generate.many", { count: chosen.length }) : t("errors.generate")}
        </button>
        <button
          type="button"
          className="btn sm"
          disabled={locked || raised === 0}
          title={why}
          onClick={() => void recover(false)}
        >
          {raised > 1 ? t("errors.recover.many", { count: raised }) : t("errors.recover")}
        </button>
        <span className="grow" />
        <button
          type="button"
          className="btn quiet sm"
          disabled={locked || !any}
          title={why}
          onClick={() => void recover(true)}
        >
          {t("errors.clearall")}
        </button>
      </div>
    </>
  );
}
