import type { FormEvent } from "react";
import { KINDS } from "../../../logic/verify/campaign";
import { beginCampaign, changeForm, useCampaigns } from "../../../store/verify/campaigns";
import { t } from "../../../text";
import { Field } from "../../../ui/Field";
import { Icon } from "../../../ui/Icon";

/** How many disturbances, of which kinds, in which scans; and what says that the program has noticed one. */
export function CampaignForm() {
  const form = useCampaigns((campaigns) => campaigns.form);

  function submit(event: FormEvent): void {
    event.preventDefault();
    void beginCampaign();
  }

  const number = (name: "count" | "seed" | "first" | "last" | "window", hint = "") => (
    <Field
      label={t(`campaign.${name}`)}
      look="sm"
      mono
      placeholder={hint}
      value={form[name]}
      onChange={(value) => changeForm({ [name]: value })}
    />
  );

  return (
    <form className="campaignform" aria-label={t("campaign.form")} onSubmit={submit}>
      {number("count")}
      {number("seed")}
      {number("first", t("campaign.first.hint"))}
      {number("last", t("campaign.last.hint"))}
      {number("window")}
      <Field
        label={t("campaign.alarms")}
        look="sm wide"
        mono
        placeholder="Main.alarm"
        title={t("campaign.alarms.about")}
        value={form.alarms}
        onChange={(alarms) => changeForm({ alarms })}
      />
      <fieldset className="campaignkinds">
        <legend>{t("campaign.kinds")}</legend>
        {KINDS.map((kind) => (
          <label key={kind} className="row tight">
            <input
              type="checkbox"
              checked={form.kinds.includes(kind)}
              onChange={({ target }) =>
                changeForm({
                  kinds: KINDS.filter((each) => (each === kind ? target.checked : form.kinds.includes(each))),
                })
              }
            />
            {t(`disturb.kind.${kind}`)}
          </label>
        ))}
      </fieldset>
      <button type="submit" className="btn primary sm">
        <Icon name="play" small />
        {t("campaign.do")}
      </button>
    </form>
  );
}
