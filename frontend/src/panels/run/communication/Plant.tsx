import { useEffect, useState } from "react";
import { changePlant, useCommunication } from "../../../store/plc/communication";
import { t } from "../../../text";
import { Field } from "../../../ui/Field";
import { Icon } from "../../../ui/Icon";
import { Segments } from "../../../ui/Segments";
import { StateWord } from "../../../ui/StateWord";
import { Switch } from "../../../ui/Switch";
import type { CommunicationPlant, PlantSettings } from "../../../wire/types";
import { Count, HostAndPort } from "./Fields";
import { Line } from "./Line";
import { PlantRanges } from "./PlantRanges";
import { Frames } from "./Seen";

/** A plant that is a server of Modbus TCP: where it is, what is wired to what, and whether it answers. */
export function Plant({ plant }: { plant: CommunicationPlant }) {
  const { settings, trouble } = plant;
  const title = t("communication.plant");
  const refused = useCommunication(({ refused }) => refused?.kind === "plant" && refused.message);
  const said = refused || (settings.on ? trouble : "");
  return (
    <section className="comserver" aria-label={title} data-server="plant">
      <div className="row">
        <Switch on={settings.on} onToggle={() => changePlant({ on: !settings.on })}>
          <h2>{title}</h2>
        </Switch>
        <span className="grow" />
        {settings.on && <Now plant={plant} />}
      </div>
      <p className="muted comabout">{t("communication.plant.about")}</p>
      {said !== "" && (
        <p className="trouble st warning" role="alert">
          <Icon name="warning" small />
          <span>{said}</span>
        </p>
      )}
      {settings.on && <Line kind="plant" fault={plant.fault} />}
      <Settings settings={settings} />
      {settings.on && <Frames frames={plant.frames} of={title} />}
    </section>
  );
}

function Now({ plant: { answers, took_ms, exchanges } }: { plant: CommunicationPlant }) {
  if (!answers) return <StateWord tone="generated" icon="generated" word={t("communication.plant.lost")} />;
  return (
    <span className="faint num">
      {t("communication.plant.now", { count: exchanges, ms: took_ms.toFixed(took_ms < 10 ? 1 : 0) })}
    </span>
  );
}

/** What is typed stays as typed until it is applied; what somebody else applied meanwhile takes its place. */
function Settings({ settings }: { settings: PlantSettings }) {
  const [draft, setDraft] = useState(settings);
  const applied = JSON.stringify(settings);
  useEffect(() => setDraft(JSON.parse(applied) as PlantSettings), [applied]);
  const change = (part: Partial<PlantSettings>) => setDraft((before) => ({ ...before, ...part }));
  return (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        const { on: _on, ...wanted } = draft;
        changePlant(wanted);
      }}
    >
      <div className="comsettings">
        <HostAndPort label={t("communication.plant.host")} host={draft.host} port={draft.port} onChange={change} />
        <Count label={t("communication.plant.unit")} value={draft.unit} onChange={(unit) => change({ unit })} />
        <Count
          label={t("communication.plant.every")}
          value={draft.every_ms}
          onChange={(every_ms) => change({ every_ms })}
        />
        <Field
          label={t("communication.plant.answers")}
          title={t("communication.plant.answers.about")}
          look="sm comcount"
          mono
          value={draft.answers}
          onChange={(answers) => change({ answers })}
        />
        <span className="field">
          <span>{t("communication.plant.inputs")}</span>
          <Segments
            label={t("communication.plant.inputs")}
            value={draft.lost}
            options={[
              { value: "keep", word: t("communication.plant.keep") },
              { value: "clear", word: t("communication.plant.clear") },
            ]}
            onChoose={(lost) => change({ lost })}
          />
        </span>
      </div>
      <PlantRanges ranges={draft.ranges} onChange={(ranges) => change({ ranges })} />
      <button type="submit" className="btn sm" disabled={JSON.stringify(draft) === applied}>
        {t("communication.apply")}
      </button>
    </form>
  );
}
