import { useId } from "react";
import { type DisturbKind, KINDS } from "../../../logic/verify/disturb";
import { setDisturbance } from "../../../store/verify/disturb";
import { t } from "../../../text";
import { Icon, type IconName } from "../../../ui/Icon";

const ICONS: Record<DisturbKind, IconName> = { flip: "flip", late: "clock", stuck: "stuck", result: "differs" };

/** The kind of disturbance: four choices, each with a description. */
export function KindChoice({ kind }: { kind: DisturbKind }) {
  const name = useId();
  return (
    <div className="kinds" role="radiogroup" aria-label={t("disturb.kind")}>
      {KINDS.map((each) => (
        <label key={each} title={t(`disturb.kind.${each}.about`)} className={`kind${each === kind ? " on" : ""}`}>
          <input
            type="radio"
            className="sr"
            name={name}
            checked={each === kind}
            onChange={() => setDisturbance({ kind: each })}
          />
          <Icon name={ICONS[each]} small />
          <b>{t(`disturb.kind.${each}`)}</b>
          <span className="faint">{t(`disturb.kind.${each}.about`)}</span>
        </label>
      ))}
    </div>
  );
}
