import { allErrors, detailsInWords } from "../../logic/catalogue";
import { grouped, wallTime } from "../../logic/numbers";
import { t } from "../../logic/text";
import { useBench } from "../../store/bench";
import { usePlc } from "../../store/plc";
import { StateWord } from "../../ui/StateWord";
import { STATUS_ICONS } from "../../ui/statuses";
import type { ErrorHistoryRow } from "../../wire/types";

/** One row for each error of the catalogue: was the program ever tested against it? */
export function HistoryPanel() {
  const errors = usePlc((plc) => plc.errors);
  const model = useBench((bench) => bench.model);
  const rows = [...errors.values()];
  const catalogue = new Map(allErrors(model?.catalogue ?? []).map((error) => [error.id, error]));
  return (
    <div className="pane flexcol" data-pane="history" data-live>
      {rows.length === 0 ? (
        <p className="lonely faint">{t("history.none")}</p>
      ) : (
        // biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard
        <div className="scroll both hscroll" tabIndex={0}>
          <table className="htable" aria-label={t("history.table")}>
            <thead>
              <tr>
                <th scope="col">{t("errors.error")}</th>
                <th scope="col">{t("errors.state")}</th>
                <th scope="col">{t("history.generated")}</th>
                <th scope="col">{t("history.recovered")}</th>
                <th scope="col">{t("errors.code")}</th>
                <th scope="col">{t("history.details")}</th>
                <th scope="col">{t("log.by")}</th>
                <th scope="col" className="num">
                  {t("history.count")}
                </th>
              </tr>
            </thead>
            <tbody>
              {rows.map((row) => (
                <Row key={row.id} row={row} details={detailsInWords(catalogue.get(row.id), row.details)} />
              ))}
            </tbody>
          </table>
        </div>
      )}
    </div>
  );
}

function Row({ row, details }: { row: ErrorHistoryRow; details: string }) {
  return (
    <tr data-error={row.id}>
      <th scope="row" title={row.name}>
        {row.name}
      </th>
      <td>
        <StateWord tone={row.status} icon={STATUS_ICONS[row.status]} word={t(`errors.status.${row.status}`)} />
      </td>
      <Moment at={row.generated_at} scan={row.generated_scan} />
      <Moment at={row.recovered_at} scan={row.recovered_scan} />
      <td className="mono">{row.status === "never" ? "" : row.code}</td>
      <td className="details" title={details || undefined}>
        {details}
      </td>
      <td title={row.origin ? t(`origin.${row.origin}`) : undefined}>{row.by ?? ""}</td>
      <td className="num">{row.count || ""}</td>
    </tr>
  );
}

function Moment({ at, scan }: { at: string | null; scan: number | null }) {
  const before = scan === null ? "" : t("history.scan", { scan: grouped(scan) });
  return (
    <td className="mono" title={[at, before].filter(Boolean).join(" · ") || undefined}>
      {wallTime(at)}
      {before && <span className="faint scan"> {before}</span>}
    </td>
  );
}
