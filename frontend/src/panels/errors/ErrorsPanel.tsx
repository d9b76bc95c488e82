import { useMemo } from "react";
import { allErrors, catalogueRows } from "../../logic/catalogue";
import { t } from "../../logic/text";
import { useBench } from "../../store/bench";
import { usePlc } from "../../store/plc";
import { setFilter, setStatusFilter, useSimulator } from "../../store/simulator";
import { Icon } from "../../ui/Icon";
import { MenuButton } from "../../ui/Menu";
import type { ModelInfo } from "../../wire/types";
import { Actions } from "./Actions";
import { Details } from "./Details";
import { ErrorTree } from "./ErrorTree";
import { StatusWords } from "./StatusWords";

const STATUSES = ["all", "never", "generated", "cleared"] as const;

/** Every error the model knows, to be raised and recovered without touching the program. */
export function ErrorsPanel() {
  const model = useBench((bench) => bench.model);
  const instance = useBench((bench) => bench.instance);
  return (
    <div className="pane flexcol" data-pane="errors" data-live>
      {model && instance ? <Simulator model={model} /> : <p className="lonely faint">{t("errors.noinstance")}</p>}
    </div>
  );
}

function Simulator({ model }: { model: ModelInfo }) {
  const { filter, status, closed, checked, selected } = useSimulator();
  const history = usePlc((plc) => plc.errors);
  const rows = useMemo(
    () => catalogueRows(model.catalogue, { filter, status, closed, checked, history }),
    [model, filter, status, closed, checked, history],
  );
  const error = useMemo(() => allErrors(model.catalogue).find((known) => known.id === selected), [model, selected]);
  return (
    <>
      <div className="sub">
        <span className="inp sm grow">
          <Icon name="search" small />
          <input
            type="search"
            aria-label={t("errors.filter")}
            placeholder={t("errors.filter")}
            value={filter}
            spellCheck={false}
            onChange={(event) => setFilter(event.target.value)}
          />
        </span>
        <MenuButton
          label={t("errors.status", { status: t(`errors.status.${status}`) })}
          items={() =>
            STATUSES.map((value) => ({
              label: t(`errors.status.${value}`),
              checked: value === status,
              onSelect: () => setStatusFilter(value),
            }))
          }
        >
          {t(`errors.status.${status}`)}
          <Icon name="chev-d" small />
        </MenuButton>
      </div>
      <ErrorTree rows={rows} label={t("errors.of", { model: model.name })} />
      {error && <Details error={error} />}
      <StatusWords words={model.status_words} />
      <Actions model={model} />
    </>
  );
}
