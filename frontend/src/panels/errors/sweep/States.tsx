import { useState } from "react";
import { dayTime, grouped } from "../../../logic/format/numbers";
import { deleteState, useSweeps } from "../../../store/errors/sweeps";
import { useWidths } from "../../../store/page/columns";
import { t } from "../../../text";
import { Confirm } from "../../../ui/Confirm";
import { IconButton } from "../../../ui/IconButton";
import { useColumns } from "../../../ui/useColumns";
import type { ProgramState } from "../../../wire/types";

/** The kept states of the project: where sweeps can begin. */
export function States() {
  const states = useSweeps((sweeps) => sweeps.states);
  const { style, head } = useColumns(useWidths("states"));
  const [doomed, setDoomed] = useState<ProgramState | null>(null);
  return (
    <section className="swstates" aria-label={t("states.title")}>
      <h3>{t("states.title")}</h3>
      {states.length === 0 ? (
        <p className="faint">{t("states.none")}</p>
      ) : (
        <div className="grid swlist" role="table" aria-label={t("states.title")} style={style}>
          <div className="gr h" role="row">
            {(["name", "scan", "of", "version", "by", "at"] as const).map((column) =>
              head(column, t(`states.column.${column}`), column === "scan" || column === "version" ? "num" : ""),
            )}
            <span role="columnheader">
              <span className="sr">{t("menu.label")}</span>
            </span>
          </div>
          {states.map((state) => (
            <div key={state.id} className="gr" role="row">
              <span role="cell" className="cut">
                <b>{state.name}</b>
              </span>
              <span role="cell" className="num">
                {grouped(state.scan)}
              </span>
              <span role="cell" className="cut muted">
                {state.instance}
              </span>
              <span role="cell" className="num">
                {state.program_version}
              </span>
              <span role="cell" className="cut muted">
                {state.by}
              </span>
              <span role="cell" className="cut muted">
                {dayTime(state.at)}
              </span>
              <span role="cell" className="gut end">
                <IconButton
                  icon="trash"
                  small
                  label={t("states.delete", { name: state.name })}
                  onClick={() => setDoomed(state)}
                />
              </span>
            </div>
          ))}
        </div>
      )}
      {doomed && (
        <Confirm
          title={t("states.delete", { name: doomed.name })}
          about={t("states.delete.about")}
          hint={t("states.delete.hint", { instance: doomed.instance })}
          verb={t("sweep.delete.do")}
          onDo={() => deleteState(doomed)}
          onClose={() => setDoomed(null)}
        />
      )}
    </section>
  );
}
