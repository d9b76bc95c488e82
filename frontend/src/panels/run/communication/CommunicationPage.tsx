import { useEffect } from "react";
import { useBench } from "../../../store/plc/bench";
import { loadCommunication, useCommunication } from "../../../store/plc/communication";
import { t } from "../../../text";
import { Empty } from "../../../ui/Empty";
import { Icon } from "../../../ui/Icon";
import { useLookedAt } from "../../../ui/inSight";
import type { Communication } from "../../../wire/types";
import "./communication.css";
import { ModbusMap } from "./ModbusMap";
import { Mqtt } from "./Mqtt";
import { Plant } from "./Plant";
import { Server } from "./Server";

const ASKED_EVERY = 1000;

/** The servers to which tools, HMIs and SCADA connect, and who is there. */
export function CommunicationPage() {
  const { seen, trouble } = useCommunication();
  const instance = useBench((bench) => bench.instance?.id);
  const lookedAt = useLookedAt();
  // biome-ignore lint/correctness/useExhaustiveDependencies: a different PLC is asked at once
  useEffect(() => {
    void loadCommunication();
    const timer = setInterval(() => lookedAt() && void loadCommunication(), ASKED_EVERY);
    return () => clearInterval(timer);
  }, [instance]);

  return (
    <section
      className="pane flexcol communication"
      aria-label={t("communication.title")}
      data-pane="communication"
      data-live
    >
      {trouble !== null && (
        <p className="trouble st warning" role="status">
          <Icon name="warning" small />
          <span>{t("communication.trouble", { message: trouble })}</span>
        </p>
      )}
      {instance === undefined && <Empty title={t("communication.none")} about={t("communication.about")} ways={[]} />}
      {seen && (
        <div className="combody scroll">
          <p className="muted comabout">{t("communication.about")}</p>
          {seen.servers.map((server) => (
            <Server key={server.kind} server={server} />
          ))}
          <Plant plant={seen.plant} />
          <Mqtt mqtt={seen.mqtt} />
          <ErrorReaders readers={seen.error_readers} />
          <ModbusMap own={seen.own_map} trouble={seen.map_trouble} />
        </div>
      )}
    </section>
  );
}

function ErrorReaders({ readers }: { readers: Communication["error_readers"] }) {
  const title = t("communication.errorreaders");
  return (
    <section aria-label={title}>
      <h2>{title}</h2>
      {readers.length === 0 ? (
        <p className="faint">{t("communication.errorreaders.none")}</p>
      ) : (
        <table className="comtable" aria-label={title}>
          <thead>
            <tr>
              <th scope="col">{t("communication.word")}</th>
              <th scope="col">{t("communication.clients")}</th>
            </tr>
          </thead>
          <tbody>
            {readers.map(({ word, clients }) => (
              <tr key={word}>
                <th scope="row" className="mono">
                  {word}
                </th>
                <td>{clients.join("; ")}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
    </section>
  );
}
