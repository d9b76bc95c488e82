import { grouped } from "../../../logic/format/numbers";
import { FATES, fates } from "../../../logic/project/change";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { OnlineChange } from "../../../wire/types";
import { Variables } from "./Variables";

interface Props {
  change: OnlineChange;
  chosen: boolean;
  onToggle: () => void;
}

/** One PLC: whether to change it, and which variables are kept, reinitialized, new, or removed. */
export function OnePlc({ change, chosen, onToggle }: Props) {
  const sorted = fates(change);
  const lost = sorted.reinitialized.length;
  const able = change.refusal === "";
  const more = change.lost_count - change.lost.length;
  return (
    <section aria-label={change.name} className={able && !chosen ? "left" : undefined}>
      <label className="row">
        <input
          type="checkbox"
          className="box"
          aria-label={t("change.choose", change)}
          checked={chosen}
          disabled={!able}
          onChange={onToggle}
        />
        <Icon name="plc" />
        <b className="cut">{change.name}</b>
        <span className="grow" />
        {able && lost > 0 && (
          <span className="st warning">
            <Icon name="init" small />
            {t("change.lost", { count: grouped(lost) })}
          </span>
        )}
        {able && (
          <span className="st cleared">
            <Icon name="check" small />
            {t("change.kept", { count: grouped(change.kept) })}
          </span>
        )}
      </label>
      {!able && (
        <p className="st fatal why">
          <Icon name="error" small />
          <span>{t("change.refused", { why: change.refusal })}</span>
        </p>
      )}
      {able && change.lost_count === 0 && <p className="hint">{t("change.none")}</p>}
      {able &&
        FATES.filter((fate) => sorted[fate].length > 0).map((fate) => (
          <Variables key={fate} plc={change.name} fate={fate} variables={sorted[fate]} />
        ))}
      {able && more > 0 && <p className="hint">{t("change.more", { count: grouped(more) })}</p>}
    </section>
  );
}
