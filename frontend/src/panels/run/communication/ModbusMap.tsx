import { useEffect } from "react";
import { useBench } from "../../../store/plc/bench";
import { loadMap, useCommunication } from "../../../store/plc/communication";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";

/** Which memory each coil and register of Modbus means. */
export function ModbusMap({ own, trouble }: { own: boolean; trouble: string }) {
  const map = useCommunication(({ map }) => map);
  const instance = useBench((bench) => bench.instance?.id);
  // biome-ignore lint/correctness/useExhaustiveDependencies: that of a different PLC, or of the project's own file
  useEffect(() => void loadMap(), [instance, own, trouble]);
  const title = t("communication.map");
  return (
    <section aria-label={title}>
      <div className="row">
        <h2>{title}</h2>
        <span className="grow" />
        <a className="btn sm" href={`/api/instances/${instance}/communication/modbus/map.csv`} download>
          <Icon name="export" small />
          {t("communication.map.csv")}
        </a>
      </div>
      <p className="faint comabout">{own ? t("communication.map.own") : t("communication.map.default")}</p>
      {trouble !== "" && (
        <p className="trouble st warning" role="alert">
          <Icon name="warning" small />
          <span>{trouble}</span>
        </p>
      )}
      <table className="comtable" aria-label={title}>
        <thead>
          <tr>
            <th scope="col">{t("communication.map.group")}</th>
            <th scope="col" className="num">
              {t("communication.map.first")}
            </th>
            <th scope="col" className="num">
              {t("communication.map.last")}
            </th>
            <th scope="col">{t("communication.map.from")}</th>
            <th scope="col">{t("communication.map.to")}</th>
            <th scope="col" className="num">
              {t("communication.map.width")}
            </th>
          </tr>
        </thead>
        <tbody>
          {map?.map(({ group, first, count, begins, ends, width }) => (
            <tr key={`${group} ${first}`}>
              <th scope="row">{t(`communication.map.${group}`)}</th>
              <td className="num">{first}</td>
              <td className="num">{first + count - 1}</td>
              <td className="mono">{begins}</td>
              <td className="mono">{ends}</td>
              <td className="num">{width}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}
