import { openInstance, useInstances } from "../../../store/plc/instances";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { Instance } from "../../../wire/types";
import type { Question } from "./Asking";
import { deeds } from "./deeds";
import { Underway } from "./Underway";

interface Props {
  instance: Instance | null;
  onAsk: (question: Question) => void;
}

/** The actions for the selected instance; during a file transfer, its progress. */
export function Actions({ instance, onAsk }: Props) {
  const transfer = useInstances((instances) => instances.transfer);
  if (transfer) {
    return (
      <>
        <Underway transfer={transfer} />
        <button type="button" className="btn quiet" onClick={transfer.cancel}>
          {t("cancel")}
        </button>
      </>
    );
  }
  if (!instance) return <span className="hint">{t("instances.choose")}</span>;
  return (
    <div className="row wrap insacts" role="toolbar" aria-label={instance.name}>
      {deeds(instance, onAsk).map(({ icon, label, about, onSelect }) => (
        <button key={label} type="button" className="btn quiet" title={about} onClick={onSelect}>
          <Icon name={icon} small />
          {label}
        </button>
      ))}
      <span className="grow" />
      <button type="button" className="btn primary" onClick={() => openInstance(instance)}>
        {t("instances.open")}
      </button>
    </div>
  );
}
