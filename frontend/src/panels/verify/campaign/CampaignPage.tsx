import { useState } from "react";
import { grouped } from "../../../logic/format/numbers";
import { shareOf } from "../../../logic/past/past";
import { useBench } from "../../../store/plc/bench";
import { chooseCampaign, forgetCampaign, shownCampaign, useCampaigns } from "../../../store/verify/campaigns";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import { StateWord } from "../../../ui/StateWord";
import type { CampaignState } from "../../../wire/types";
import { CampaignForm } from "./CampaignForm";
import { Outcomes } from "./Outcomes";
import { Trials } from "./Trials";
import "./campaign.css";

/** Many random disturbances, each tried alone on the recorded run: which were noticed, by whom, and which were not. */
export function CampaignPage() {
  const instance = useBench((bench) => bench.instance);
  const campaigns = useCampaigns();
  const shown = shownCampaign(campaigns);
  return (
    <div className="pane flexcol" data-pane="campaign">
      {instance && <CampaignForm />}
      {campaigns.trouble && (
        <p className="trouble st fatal" role="alert">
          <Icon name="error" small />
          <span>{campaigns.trouble}</span>
        </p>
      )}
      {campaigns.list.length > 1 && <Known list={campaigns.list} shown={shown?.id ?? null} />}
      {shown && instance ? (
        <Shown campaign={shown} />
      ) : (
        <p className="lonely faint">{t(instance ? "campaign.none" : "sweep.noplc")}</p>
      )}
    </div>
  );
}

/** The others of this PLC. */
function Known({ list, shown }: { list: readonly CampaignState[]; shown: number | null }) {
  return (
    <div className="sub cmpknown" role="toolbar" aria-label={t("campaign.known")}>
      {list.map((campaign) => (
        <button
          key={campaign.id}
          type="button"
          className={`btn quiet sm${campaign.id === shown ? " is-on" : ""}`}
          aria-pressed={campaign.id === shown}
          onClick={() => chooseCampaign(campaign.id)}
        >
          <State campaign={campaign} />
        </button>
      ))}
    </div>
  );
}

function State({ campaign: { wanted, done, of, over, message } }: { campaign: CampaignState }) {
  const word = t("campaign.seeded", { seed: wanted.seed, count: grouped(over ? done : of) });
  if (!over) return <StateWord tone="running" icon="wait" word={word} />;
  return <StateWord tone={message ? "fatal" : "stopped"} icon={message ? "error" : "check"} word={word} />;
}

function Shown({ campaign }: { campaign: CampaignState }) {
  const { id, wanted, by, done, of, over, message } = campaign;
  const progress = t("campaign.progress", { done: grouped(done), of: grouped(of) });
  return (
    <section className="campaignview" aria-label={t("campaign.shown")}>
      <div className="cmphead">
        <State campaign={campaign} />
        <span className="muted cut">
          {t("campaign.facts", {
            first: grouped(wanted.first),
            last: grouped(wanted.last),
            window: grouped(wanted.window),
          })}
        </span>
        <span className="faint cut">{t("disturb.by", { by })}</span>
        <span className="grow" />
        {over ? (
          <>
            {done > 0 && <Exports id={id} />}
            <IconButton icon="trash" small label={t("campaign.forget")} onClick={() => void forgetCampaign(id)} />
          </>
        ) : (
          <button type="button" className="btn sm" onClick={() => void forgetCampaign(id)}>
            {t("campaign.cancel")}
          </button>
        )}
      </div>
      {!over && (
        <span
          className="progress"
          role="progressbar"
          aria-label={t("campaign.tab")}
          aria-valuemin={0}
          aria-valuemax={of}
          aria-valuenow={done}
          aria-valuetext={progress}
        >
          <i style={{ width: `${shareOf({ done, of }) * 100}%` }} />
        </span>
      )}
      {message && (
        <p className="trouble st fatal" role="alert">
          <Icon name="error" small />
          <span>{message}</span>
        </p>
      )}
      {(done > 0 || !over) && (
        <>
          <Outcomes campaign={campaign} />
          <Trials campaign={id} />
        </>
      )}
    </section>
  );
}

const REQUIRED = ["any", "program"] as const;

/** What is a failure in the files is chosen beside them. */
function Exports({ id }: { id: number }) {
  const [required, require] = useState<(typeof REQUIRED)[number]>("any");
  const path = `/api/campaigns/${id}/export?require=${required}`;
  return (
    <>
      <select
        className="inp sm"
        aria-label={t("campaign.require")}
        title={t("campaign.require.about")}
        value={required}
        onChange={({ target }) => require(REQUIRED.find((each) => each === target.value) ?? "any")}
      >
        {REQUIRED.map((each) => (
          <option key={each} value={each}>
            {t(`campaign.require.${each}`)}
          </option>
        ))}
      </select>
      <a className="btn sm" href={`${path}&format=junit`} download={`campaign-${id}.xml`}>
        <Icon name="export" small />
        JUnit
      </a>
      <a className="btn sm" href={path} download={`campaign-${id}.json`}>
        <Icon name="export" small />
        JSON
      </a>
    </>
  );
}
