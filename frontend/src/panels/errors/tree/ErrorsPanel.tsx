import { useMemo } from "react";
import { useShallow } from "zustand/react/shallow";
import { catalogueRows } from "../../../logic/errors/catalogue";
import { idOf, instancesByKind } from "../../../logic/plc/errorInstances";
import { useCatalogue } from "../../../store/errors/catalogue";
import { generate, setFilters, useSimulator } from "../../../store/errors/simulator";
import { openSweep } from "../../../store/errors/sweeps";
import { useBench } from "../../../store/plc/bench";
import { useForbidden, usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { ModelInfo } from "../../../wire/types";
import { Actions } from "./Actions";
import { ArmedList } from "./ArmedList";
import { Details } from "./Details";
import { DetailsDialog } from "./DetailsDialog";
import { ErrorTree } from "./ErrorTree";
import "./errors.css";
import "./reaction.css";
import { FilterMenu } from "./FilterMenu";
import { FirstSteps } from "./FirstSteps";
import { Lines } from "./Lines";
import { refusedRow } from "./refusal";
import { StatusWords } from "./StatusWords";

/** Every error that the model knows. Raising and recovering them needs no change of the program. */
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
  // Details and shape are not selected here: they change with each key.
  const { filter, status, severity, reaction, closed, checked, selected, outcome, asking } = useSimulator(
    useShallow(({ details, shape, told, ...rest }) => rest),
  );
  const { groups, errors, byId } = useCatalogue();
  const history = usePlc((plc) => plc.errors);
  const known = usePlc((plc) => plc.instances);
  const instances = useMemo(() => instancesByKind(known), [known]);
  const hardware = model.hardware;
  const faults = usePlc((plc) => plc.armed);
  const armed = useMemo(() => new Set(faults.flatMap((fault) => fault.errors)), [faults]);
  const locked = useForbidden("errors") !== null;
  const rows = useMemo(
    () =>
      catalogueRows(groups, {
        filter,
        status,
        severity,
        reaction,
        closed,
        checked,
        history,
        instances,
        hardware,
        armed,
      }),
    [groups, filter, status, severity, reaction, closed, checked, history, instances, hardware, armed],
  );
  const error = selected === null ? undefined : byId.get(idOf(selected));
  const untouched = useMemo(() => [...history.values()].every((row) => row.status === "never"), [history]);
  const refused = refusedRow(rows, outcome);
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
            onChange={(event) => setFilters({ filter: event.target.value })}
          />
        </span>
        <FilterMenu />
        <button type="button" className="btn sm" data-tour="runall" title={t("errors.runall.hint")} onClick={openSweep}>
          {t("errors.runall")}
        </button>
      </div>
      <ErrorTree
        rows={rows}
        label={t("errors.of", { model: model.name })}
        refused={refused}
        onGenerate={() => {
          if (!locked) void generate(errors);
        }}
      />
      {error && selected !== null && <Details error={error} of={selected} />}
      {!error && untouched && <FirstSteps />}
      <Lines servers={model.servers} />
      <ArmedList />
      <StatusWords words={model.status_words} code={model.code_words} />
      <Actions refusedInTree={refused !== null} />
      {asking && <DetailsDialog errors={errors.filter((known) => asking.includes(known.id))} />}
    </>
  );
}
