import { inNames } from "../../../logic/errors/catalogue";
import { useCatalogue } from "../../../store/errors/catalogue";
import { clearErrorLog, clearErrors, useDevice } from "../../../store/errors/device";
import { useForbidden, usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { DeviceErrors } from "../../../wire/types";
import { DeviceLog } from "./DeviceLog";
import "./device.css";
import { Present } from "./Present";
import { Standby } from "./Standby";

/** What a programming tool shows of the PLC's errors: all of it is read from the memory of the PLC. */
export function DevicePage() {
  const found = useDevice((device) => device.found);
  return (
    <section className="pane flexcol device" data-pane="plcerrors" data-live aria-label={t("device.title")}>
      {found ? <Shown found={found} /> : <p className="lonely faint">{t("device.nothing")}</p>}
    </section>
  );
}

function Shown({ found }: { found: DeviceErrors }) {
  return (
    <>
      <Toolbar found={found} />
      <Outcome />
      <div className="devicebody scroll">
        {found.standby && <Standby standby={found.standby} clear={found.errors.length === 0} />}
        <Present errors={found.errors} />
        {found.messages.length > 0 && <Messages found={found} />}
        <DeviceLog found={found} />
      </div>
    </>
  );
}

function Toolbar({ found: { code, errors, log, has_log } }: { found: DeviceErrors }) {
  const forbidden = useForbidden("errors");
  const locked = forbidden !== null;
  const why = (about: string) => forbidden ?? about;
  const none = errors.length === 0;
  return (
    <div className="sub" role="toolbar" aria-label={t("device.title")}>
      {code !== "" && (
        <span className="faint" title={t("device.code.about")}>
          {t("device.code")} <b className="mono codeword">{code}</b>
        </span>
      )}
      <span className="grow" />
      <button
        type="button"
        className="btn sm"
        disabled={locked || none}
        title={why(t("device.clear.about"))}
        onClick={() => void clearErrors("current")}
      >
        {t("device.clear")}
      </button>
      <button
        type="button"
        className="btn sm"
        disabled={locked || none}
        title={why(t("device.clearall.about"))}
        onClick={() => void clearErrors("all")}
      >
        {t("device.clearall")}
      </button>
      {has_log && (
        <button
          type="button"
          className="btn sm"
          disabled={locked || log.length === 0}
          title={why(t("device.clearlog.about"))}
          onClick={() => void clearErrorLog()}
        >
          {t("device.clearlog")}
        </button>
      )}
    </div>
  );
}

/** What became of the last command: a refusal says that a cause is still there. */
function Outcome() {
  const outcome = useDevice((device) => device.outcome);
  const { errors } = useCatalogue();
  const instances = usePlc((plc) => plc.instances);
  if (!outcome) return null;
  const message = inNames(errors, outcome.message, instances) || t("notsent.about");
  if (outcome.ok)
    return (
      <p className="outcome muted" role="status">
        {message}
      </p>
    );
  return (
    <p className="trouble st fatal" role="alert">
      <Icon name="error" small />
      <span>{message}</span>
    </p>
  );
}

function Messages({ found: { messages } }: { found: DeviceErrors }) {
  return (
    <section aria-label={t("device.messages")}>
      <h2>{t("device.messages")}</h2>
      <table className="dtable messages" aria-label={t("device.messages")}>
        <tbody>
          {messages.map(({ instruction, number, text }) => (
            <tr key={`${instruction} ${number}`}>
              <th scope="row" className="mono">
                {instruction} {number}
              </th>
              <td className="said">{text}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}
