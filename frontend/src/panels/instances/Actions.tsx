import { percent } from "../../logic/numbers";
import { t } from "../../logic/text";
import { exportInstance, openInstance, setPower, type Transfer, useInstances } from "../../store/instances";
import { Icon, type IconName } from "../../ui/Icon";
import type { Instance } from "../../wire/types";
import type { Question } from "./Asking";

interface Props {
  instance: Instance | null;
  onAsk: (question: Question) => void;
}

/** What can be done with the chosen instance; while a file is on its way, how far it got. */
export function Actions({ instance, onAsk }: Props) {
  const transfer = useInstances((instances) => instances.transfer);
  if (transfer) return <Underway transfer={transfer} />;
  if (!instance) return <span className="hint">{t("instances.choose")}</span>;
  const off = instance.state.state === "off";
  return (
    <div className="row wrap insacts" role="toolbar" aria-label={instance.name}>
      <Act
        icon="off"
        text={t(off ? "instances.power.on" : "instances.power.off")}
        hint={t(off ? "instances.power.on.hint" : "instances.power.off.hint")}
        onClick={() => void setPower(instance, off)}
      />
      <Act icon="plc" text={t("instances.clone")} onClick={() => onAsk({ ask: "clone", instance })} />
      <Act icon="branch" text={t("instances.branch")} onClick={() => onAsk({ ask: "branch", instance })} />
      <Act icon="keyboard" text={t("instances.rename")} onClick={() => onAsk({ ask: "rename", instance })} />
      <Act icon="fit" text={t("instances.limits")} onClick={() => onAsk({ ask: "limits", instance })} />
      <Act
        icon="export"
        text={t("instances.export")}
        hint={t("instances.export.hint")}
        onClick={() => void exportInstance(instance)}
      />
      <Act icon="trash" text={t("instances.delete")} onClick={() => onAsk({ ask: "delete", instance })} />
      <span className="grow" />
      <button type="button" className="btn primary" onClick={() => openInstance(instance)}>
        {t("instances.open")}
      </button>
    </div>
  );
}

interface ActProps {
  icon: IconName;
  text: string;
  hint?: string;
  onClick: () => void;
}

function Act({ icon, text, hint, onClick }: ActProps) {
  return (
    <button type="button" className="btn quiet" title={hint} onClick={onClick}>
      <Icon name={icon} small />
      {text}
    </button>
  );
}

function Underway({ transfer }: { transfer: Transfer }) {
  const what = t(transfer.text === "import" ? "instances.importing" : "instances.exporting", { name: transfer.name });
  const share = transfer.share === null ? "" : percent(Math.floor(transfer.share * 100));
  return (
    <>
      <span className="cut">{t("instances.intransit", { what, share })}</span>
      <progress className="grow" aria-label={what} value={transfer.share ?? undefined} max={1} />
      <button type="button" className="btn quiet" onClick={transfer.cancel}>
        {t("cancel")}
      </button>
    </>
  );
}
