import { grouped } from "../../../logic/format/numbers";
import { isSilent, shownOf } from "../../../logic/verify/campaign";
import { openFile } from "../../../store/page/navigate";
import { useForbidden } from "../../../store/plc/plc";
import { travel } from "../../../store/plc/timeline";
import { openTrial, useCampaigns } from "../../../store/verify/campaigns";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { StateWord } from "../../../ui/StateWord";
import type { CampaignTrial } from "../../../wire/types";
import { LOOK } from "./Outcomes";

/** The disturbances that were tried so far: what came of each; its scan and its line are links. */
export function Trials({ campaign }: { campaign: number }) {
  const trials = useCampaigns((campaigns) => campaigns.trials);
  const shown = useCampaigns((campaigns) => campaigns.shown);
  if (trials?.of !== campaign) return null;
  const listed = shownOf(trials.all, shown);
  return (
    <div className="trials" role="table" aria-label={t("campaign.trials")} aria-rowcount={listed.length + 1}>
      <div className="trial h" role="row">
        {(["number", "outcome", "what", "scan", "verification", "program", "open"] as const).map((name) => (
          <span key={name} role="columnheader">
            {t(`campaign.head.${name}`)}
          </span>
        ))}
      </div>
      {listed.map((trial) => (
        <Line key={trial.number} campaign={campaign} trial={trial} />
      ))}
    </div>
  );
}

function Line({ campaign, trial }: { campaign: number; trial: CampaignTrial }) {
  const {
    number,
    outcome,
    text,
    scan,
    verification,
    place,
    program,
    program_scan: noticed,
    output_scan: output,
    refused,
    unvalued,
    why,
  } = trial;
  const opening = useCampaigns((campaigns) => campaigns.opening);
  const locked = useForbidden("travel");
  return (
    <div className="trial" role="row" data-trial={number}>
      <span role="cell" className="mono faint">
        {number}
      </span>
      <span role="cell">
        <StateWord {...LOOK[outcome]} word={t(`campaign.is.${outcome}`)} />
      </span>
      <span role="cell">
        {text}
        {why && <small className="faint">{why}</small>}
        {[...refused, ...unvalued].map((each) => (
          <small key={each} className="faint">
            {each}
          </small>
        ))}
      </span>
      <span role="cell">
        <button
          type="button"
          className="link mono"
          disabled={locked !== null}
          title={locked ?? t("campaign.goto", { scan: grouped(scan) })}
          onClick={() => void travel(scan)}
        >
          {grouped(scan)}
        </button>
      </span>
      <span role="cell">
        {verification || <NotNoticed trial={trial} />}
        {place && (
          <small>
            <button type="button" className="link mono" onClick={() => openFile(place.file, place.line)}>
              {place.file}:{place.line}
            </button>
          </small>
        )}
      </span>
      <span role="cell">
        {program.length > 0 ? program.join("; ") : <NotNoticed trial={trial} />}
        {noticed !== null && noticed !== undefined && (
          <small className="faint">{t("campaign.in", { scan: grouped(noticed) })}</small>
        )}
        {isSilent(trial) && output !== null && output !== undefined && (
          <small className="st warning">
            <Icon name="warning" small />
            {t("campaign.output", { scan: grouped(output) })}
          </small>
        )}
      </span>
      <span role="cell">
        {outcome !== "missed" && (
          <button
            type="button"
            className="btn quiet sm"
            disabled={opening !== null}
            title={t("campaign.open.about")}
            aria-label={t("campaign.open.of", { number })}
            onClick={() => void openTrial(campaign, number, scan)}
          >
            <Icon name={opening === number ? "wait" : "branch"} small />
            {t("campaign.open")}
          </button>
        )}
      </span>
    </div>
  );
}

/** There is nothing to notice of what did not come about. */
function NotNoticed({ trial: { outcome } }: { trial: CampaignTrial }) {
  return outcome === "missed" ? null : <span className="faint">{t("campaign.not")}</span>;
}
