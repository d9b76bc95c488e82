import { putAwayDamage, useTimeline } from "../../../store/plc/timeline";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";

/** The run file: nothing is recorded at the moment, or the file was damaged when it was opened. */
export function RecordingBanner() {
  const recording = useTimeline((timeline) => timeline.info?.recording ?? "");
  const damage = useTimeline((timeline) => timeline.info?.damage ?? "");
  const read = useTimeline((timeline) => timeline.read);
  if (recording)
    return (
      <div className="banner fatal" role="alert">
        <Icon name="error" />
        <span className="grow">
          <b>{t("recording.title")}</b> {recording} <span className="muted">{t("recording.about")}</span>
        </span>
      </div>
    );
  if (damage === "" || damage === read) return null;
  return (
    <div className="banner stale" role="alert">
      <Icon name="warning" />
      <span className="grow">
        <b>{t("damage.title")}</b> {damage} <span className="muted">{t("damage.about")}</span>
      </span>
      <button type="button" className="btn sm" onClick={putAwayDamage}>
        {t("damage.read")}
      </button>
    </div>
  );
}
