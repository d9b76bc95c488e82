import { codeText } from "../../../logic/errors/codeText";
import { detailsIn, deviceKey, nameIn } from "../../../logic/errors/device";
import { keyOf, rowOf } from "../../../logic/plc/errorInstances";
import { useCatalogue } from "../../../store/errors/catalogue";
import { recoverPresent } from "../../../store/errors/device";
import { useForbidden, usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { DeviceError } from "../../../wire/types";
import { SeverityWord } from "./SeverityWord";

/** The errors that the memory shows, the most serious first, each with its cause below it. */
export function Present({ errors }: { errors: readonly DeviceError[] }) {
  return (
    <section aria-label={t("device.present")}>
      <h2>{t("device.present.count", { count: errors.length })}</h2>
      {errors.length === 0 ? (
        <p className="none st running">
          <Icon name="handled" small />
          <span>{t("device.present.none")}</span>
        </p>
      ) : (
        <table className="dtable" aria-label={t("device.present")}>
          <thead>
            <tr>
              <th scope="col">{t("errors.severity")}</th>
              <th scope="col">{t("errors.code")}</th>
              <th scope="col">{t("errors.error")}</th>
              <th scope="col">{t("device.details")}</th>
              <th scope="col">{t("device.text")}</th>
              <th scope="col">
                <span className="unseen">{t("errors.recover")}</span>
              </th>
            </tr>
          </thead>
          <tbody>
            {errors.map((error) => (
              <Line key={deviceKey(error)} error={error} />
            ))}
          </tbody>
        </table>
      )}
      {errors.length > 0 && <p className="ways faint">{t("device.ways")}</p>}
    </section>
  );
}

function Line({ error }: { error: DeviceError }) {
  const { byId } = useCatalogue();
  const known = byId.get(error.id);
  const forbidden = useForbidden("errors");
  const row = usePlc((plc) => rowOf(plc.instances, error.id, error.details));
  const raised = row?.status === "generated";
  const details = detailsIn(known, error.details);
  const cause = [known?.description ?? error.cause, error.lasting ? t("device.lasting") : ""].filter(Boolean).join(" ");
  const name = nameIn(byId, error);
  return (
    <tr data-device={error.id} data-top={error.top || undefined}>
      <td>
        <SeverityWord severity={error.severity} />
      </td>
      <td className="mono">{known?.code === "" ? codeText("") : error.code || "–"}</td>
      <th scope="row">
        <span className="dname">{name}</span>
        {cause && <span className="cause">{cause}</span>}
      </th>
      <td>
        {details || <span className="faint">–</span>}
        <span className="cause mono">{error.flag}</span>
      </td>
      <td className="said">{error.text}</td>
      <td>
        <button
          type="button"
          className="btn sm"
          disabled={forbidden !== null || !raised}
          title={forbidden ?? t(raised ? "device.recover.about" : "device.recover.not")}
          aria-label={t("device.recover.of", { error: [name, details].filter(Boolean).join(", ") })}
          onClick={() => row && void recoverPresent(keyOf(row))}
        >
          {t("errors.recover")}
        </button>
      </td>
    </tr>
  );
}
