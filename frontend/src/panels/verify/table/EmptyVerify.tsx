import { useOnline } from "../../../store/plc/plc";
import { showCampaigns } from "../../../store/verify/campaigns";
import { askVerification, verifyWholeProgram } from "../../../store/verify/verify";
import { t } from "../../../text";
import { Empty } from "../../../ui/Empty";
import { Icon } from "../../../ui/Icon";

/** No verification yet: what it is for, and how to begin. */
export function EmptyVerify() {
  const online = useOnline();
  return (
    <div className="vfempty">
      <Empty
        title={t("verify.empty.title")}
        about={t("verify.empty.about")}
        ways={[
          { icon: "mouse", strong: t("verify.empty.lines"), rest: t("verify.empty.lines.rest") },
          { icon: "list", strong: t("verify.empty.pou"), rest: t("verify.empty.pou.rest") },
          { icon: "past", strong: t("verify.empty.past"), rest: t("verify.empty.past.rest") },
        ]}
      >
        <div className="vfways">
          <button type="button" className="btn primary" disabled={!online} onClick={() => void verifyWholeProgram()}>
            <Icon name="play" small />
            {t("verify.whole")}
          </button>
          <button
            type="button"
            className="btn"
            disabled={!online}
            onClick={() => askVerification({ range: {}, stretch: null })}
          >
            {t("verify.new")}
          </button>
          <button type="button" className="btn" onClick={showCampaigns}>
            {t("campaign.show")}
          </button>
        </div>
      </Empty>
    </div>
  );
}
