import { detailsIn, nameIn } from "../../../logic/errors/device";
import { useCatalogue } from "../../../store/errors/catalogue";
import { t } from "../../../text";
import type { DeviceErrors, DeviceRecord } from "../../../wire/types";
import { SeverityWord } from "./SeverityWord";

/** The device's own error log, the newest record first. */
export function DeviceLog({ found: { log, has_log, keeps_latest } }: { found: DeviceErrors }) {
  const title = has_log ? t("device.log") : t("device.latest");
  return (
    <section aria-label={title}>
      <h2>{has_log ? t("device.log.count", { count: log.length }) : title}</h2>
      {log.length === 0 ? (
        <p className="none faint">{t(has_log || keeps_latest ? "device.log.none" : "device.log.no")}</p>
      ) : (
        <table className="dtable" aria-label={title}>
          <thead>
            <tr>
              <th scope="col">{t("device.time")}</th>
              <th scope="col">{t("errors.code")}</th>
              <th scope="col">{t("errors.error")}</th>
              <th scope="col">{t("device.details")}</th>
              <th scope="col">{t("device.text")}</th>
              <th scope="col">{t("errors.severity")}</th>
            </tr>
          </thead>
          <tbody>
            {log.map((record) => (
              <Line key={record.number} record={record} />
            ))}
          </tbody>
        </table>
      )}
    </section>
  );
}

function Line({ record }: { record: DeviceRecord }) {
  const { byId } = useCatalogue();
  const { time, code, contents, severity, text } = record;
  const details = detailsIn(byId.get(record.id), record.details);
  return (
    <tr data-record={record.number}>
      <td className="mono">{time || "–"}</td>
      <td className="mono">{code}</td>
      <th scope="row">
        <span className="dname">{nameIn(byId, record) || t("device.log.unknown")}</span>
      </th>
      <td title={contents && t("device.contents", { contents })}>{details || <span className="faint">–</span>}</td>
      <td className="said">{text}</td>
      <td>{severity && <SeverityWord severity={severity} />}</td>
    </tr>
  );
}
