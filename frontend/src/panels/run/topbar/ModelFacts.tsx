import { useEffect, useState } from "react";
import { messageOf } from "../../../logic/format/messageOf";
import { percent } from "../../../logic/format/numbers";
import { useWidths } from "../../../store/page/columns";
import { modelDetails } from "../../../store/plc/models";
import { t } from "../../../text";
import { useColumns } from "../../../ui/useColumns";
import type { Area, ModelInfo, ModelSummary } from "../../../wire/types";

/** The description of a model: a sentence, how many of its facts were checked against manuals, and its memory with the access rights. */
export function ModelFacts({ model }: { model: ModelSummary | undefined }) {
  const name = model?.name;
  const [info, setInfo] = useState<ModelInfo | null>(null);
  const [trouble, setTrouble] = useState("");
  useEffect(() => {
    if (name === undefined) return;
    let here = true;
    modelDetails(name)
      .then((found) => here && setInfo(found))
      .catch((error: unknown) => here && setTrouble(messageOf(error)));
    return () => {
      here = false;
    };
  }, [name]);
  if (!model) return null;
  const { error_count: count, fact_count: facts, verified_facts: verified } = model;
  const errors =
    count === 0
      ? t("model.errors.none")
      : t("model.errors", { count, share: percent(Math.round((100 * verified) / Math.max(1, facts))) });
  return (
    <div className="modelfacts">
      <p className="hint">
        {[model.description, errors].filter(Boolean).join(" · ")} {trouble}
      </p>
      {info?.name === model.name && info.areas.length > 0 && (
        <>
          <Areas info={info} />
          <p className="hint">{t("model.access.legend")}</p>
        </>
      )}
    </div>
  );
}

function Areas({ info }: { info: ModelInfo }) {
  const { style, grip, head } = useColumns(useWidths("areas"));
  return (
    <div
      className="grid scroll areas"
      role="table"
      aria-label={t("model.areas", { model: info.name })}
      style={style}
      // biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard
      tabIndex={0}
    >
      <div className="gr h" role="row">
        {head("area", t("model.area"))}
        {head("address", t("model.address"))}
        <span role="columnheader" aria-label={t("model.access")} title={t("model.access.legend")}>
          {t("model.access")}
          {grip("access", t("model.access"))}
        </span>
        <span role="columnheader">{t("model.retain")}</span>
      </div>
      {info.areas.map((area) => (
        <AreaLine key={area.first} area={area} />
      ))}
    </div>
  );
}

function AreaLine({ area }: { area: Area }) {
  const access = [area.program, area.tool, area.engine].map((may) => t(`model.access.${may}`)).join(" · ");
  return (
    <div className="gr" role="row">
      <span role="cell" className="area">
        <b>{area.name}</b> <span className="muted">{area.description}</span>
      </span>
      <span role="cell" className="mono muted cut">
        {area.first}–{area.last}
      </span>
      <span role="cell" className="mono cut" title={t("model.access.legend")}>
        {access}
      </span>
      <span role="cell" className="muted cut">
        {area.retain ? t("model.retain.yes") : t("model.access.none")}
      </span>
    </div>
  );
}
