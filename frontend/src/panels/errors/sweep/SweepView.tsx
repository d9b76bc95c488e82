import { useMemo, useRef, useState } from "react";
import { firstFinding, inWordsOf, isCell, type MatrixView, matrixRows } from "../../../logic/errors/sweep";
import { useCatalogueOf } from "../../../store/errors/catalogue";
import { t } from "../../../text";
import type { CellRef, Sweep } from "../../../wire/types";
import { Counts } from "./Counts";
import { Details } from "./Details";
import { Matrix } from "./Matrix";
import { Problems } from "./Problems";
import { Progress } from "./Progress";

/** One sweep: its progress, its findings, and the details of the selected cell. */
export function SweepView({ sweep }: { sweep: Sweep }) {
  const [view, setView] = useState<MatrixView>({ findings: false, verdict: null });
  const [chosen, setChosen] = useState<CellRef | null>(null);
  const details = useRef<HTMLElement>(null);
  const { groups } = useCatalogueOf(sweep.model);
  const rows = useMemo(() => matrixRows(inWordsOf(sweep, groups), view), [sweep, view, groups]);
  const ref = chosen ?? firstFinding(rows);
  const row = rows.find((known) => known.kind === "error" && known.error.id === ref?.error);
  const slot = row?.kind === "error" && ref ? row.slots[sweep.states.indexOf(ref.state)] : undefined;

  return (
    <>
      <Progress sweep={sweep} />
      <Counts sweep={sweep} view={view} onView={setView} />
      {sweep.message && <p className="swnote muted">{sweep.message}</p>}
      <Problems sweep={sweep} />
      <div className="swbody">
        <Matrix
          sweep={sweep}
          rows={rows}
          selected={ref}
          onSelect={setChosen}
          onEnter={() => details.current?.querySelector<HTMLElement>(".btn, button")?.focus()}
        />
        <section
          className="swside scroll"
          aria-label={t("sweep.details")}
          ref={details}
          onKeyDown={(event) => {
            if (event.key === "Escape") event.currentTarget.parentElement?.querySelector<HTMLElement>(".sw")?.focus();
          }}
        >
          {ref && row?.kind === "error" ? (
            <Details
              key={`${ref.error} ${ref.state}`}
              sweep={sweep}
              error={row.error}
              state={ref.state}
              cell={isCell(slot) ? slot : null}
            />
          ) : (
            <p className="hint">{t("sweep.choose")}</p>
          )}
        </section>
      </div>
    </>
  );
}
