import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { CommunicationFrame, CommunicationServer } from "../../../wire/types";

const timeOf = (at: string) => at.slice(11, 23);

export function Clients({ clients, of }: { clients: CommunicationServer["clients"]; of: string }) {
  const title = t("communication.clients");
  if (clients.length === 0) return <p className="faint">{t("communication.clients.none")}</p>;
  return (
    <table className="comtable" aria-label={`${of}: ${title}`}>
      <thead>
        <tr>
          <th scope="col">{t("communication.client")}</th>
          <th scope="col">{t("communication.since")}</th>
          <th scope="col" className="num">
            {t("communication.requests")}
          </th>
          <th scope="col" className="num">
            {t("communication.refused")}
          </th>
          <th scope="col">{t("communication.refused.last")}</th>
        </tr>
      </thead>
      <tbody>
        {clients.map(({ name, since, requests, refused, last_refused }) => (
          <tr key={name}>
            <th scope="row">{name}</th>
            <td className="mono">{timeOf(since)}</td>
            <td className="num">{requests}</td>
            <td className="num">{refused}</td>
            <td className="comwide">{last_refused}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

interface FramesProps {
  frames: readonly CommunicationFrame[];
  of: string;
  /** The PLC tells; nobody asks it. */
  told?: boolean;
}

export function Frames({ frames, of, told = false }: FramesProps) {
  const title = t(told ? "communication.mqtt.frames" : "communication.frames");
  return (
    <>
      <h3>{title}</h3>
      {frames.length === 0 ? (
        <p className="faint">{t(told ? "communication.mqtt.frames.none" : "communication.frames.none")}</p>
      ) : (
        // biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls is reached by keyboard
        <div className="comframes" tabIndex={0} role="group" aria-label={`${of}: ${title}`}>
          <table className="comtable">
            <thead>
              <tr>
                <th scope="col">{t("communication.time")}</th>
                <th scope="col">{t(told ? "communication.mqtt.broker" : "communication.client")}</th>
                <th scope="col">{t(told ? "communication.mqtt.topic" : "communication.request")}</th>
                <th scope="col">{t("communication.outcome")}</th>
              </tr>
            </thead>
            <tbody>
              {frames.toReversed().map((frame) => (
                <Frame key={frame.number} frame={frame} />
              ))}
            </tbody>
          </table>
        </div>
      )}
    </>
  );
}

function Frame({ frame: { at, client, text, outcome, request, answer } }: { frame: CommunicationFrame }) {
  return (
    <tr title={request === "" ? undefined : `> ${request}\n< ${answer}`}>
      <td className="mono">{timeOf(at)}</td>
      <td>{client}</td>
      <td className="comwide">{text}</td>
      <td className="comwide">
        {outcome === "" ? (
          <span className="faint">{t("communication.frames.done")}</span>
        ) : (
          <span className="st warning">
            <Icon name="warning" small /> {outcome}
          </span>
        )}
      </td>
    </tr>
  );
}
