import { grouped } from "../../../logic/format/numbers";
import type { Outcome, Shown } from "../../../logic/verify/campaign";
import { showOutcome, useCampaigns } from "../../../store/verify/campaigns";
import { t } from "../../../text";
import type { IconName } from "../../../ui/Icon";
import { StateWord } from "../../../ui/StateWord";
import type { CampaignState } from "../../../wire/types";

/** Icon and colour of each way in which a disturbance ends. */
export const LOOK: Record<Outcome, { tone: string; icon: IconName }> = {
  both: { tone: "running", icon: "check" },
  verification: { tone: "info", icon: "differs" },
  program: { tone: "running", icon: "plc" },
  nothing: { tone: "fatal", icon: "error" },
  "no effect": { tone: "stopped", icon: "equal" },
  missed: { tone: "stopped", icon: "minus" },
};

/** How many ended how; each is a filter of the table. */
export function Outcomes({ campaign }: { campaign: CampaignState }) {
  const shown = useCampaigns((campaigns) => campaigns.shown);
  return (
    <div className="sub campaignsum" role="toolbar" aria-label={t("campaign.outcomes")}>
      <One value={null} count={campaign.done} word={t("campaign.all")} shown={shown} />
      {campaign.outcomes.map(({ outcome, count }) => (
        <One
          key={outcome}
          value={outcome}
          count={count}
          word={t(`campaign.is.${outcome}`)}
          shown={shown}
          look={LOOK[outcome]}
        />
      ))}
      {campaign.silent > 0 && (
        <One
          value="silent"
          count={campaign.silent}
          word={t("campaign.silent")}
          shown={shown}
          look={{ tone: "warning", icon: "warning" }}
        />
      )}
    </div>
  );
}

interface OneProps {
  value: Shown;
  count: number;
  word: string;
  shown: Shown;
  look?: { tone: string; icon: IconName };
}

function One({ value, count, word, shown, look }: OneProps) {
  const said = `${word} ${grouped(count)}`;
  return (
    <button
      type="button"
      className={`btn quiet sm${value === shown ? " is-on" : ""}`}
      aria-pressed={value === shown}
      data-outcome={value ?? "all"}
      onClick={() => showOutcome(value)}
    >
      {look ? <StateWord {...look} word={said} /> : said}
    </button>
  );
}
