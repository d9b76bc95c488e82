import { useEffect, useState } from "react";
import { changeMqtt, useCommunication } from "../../../store/plc/communication";
import { t } from "../../../text";
import { Field } from "../../../ui/Field";
import { Icon } from "../../../ui/Icon";
import { Segments } from "../../../ui/Segments";
import { StateWord } from "../../../ui/StateWord";
import { Switch } from "../../../ui/Switch";
import type { CommunicationMqtt, MqttSettings } from "../../../wire/types";
import { Frames } from "./Seen";

/** Variables that are published to a broker: as topics with JSON, or as an edge node of Sparkplug B. */
export function Mqtt({ mqtt }: { mqtt: CommunicationMqtt }) {
  const { settings, trouble, connected, published } = mqtt;
  const title = t("communication.mqtt");
  const refused = useCommunication(({ refused }) => refused?.kind === "mqtt" && refused.message);
  const said = refused || (settings.on ? trouble : "");
  return (
    <section className="comserver" aria-label={title} data-server="mqtt">
      <div className="row">
        <Switch on={settings.on} onToggle={() => changeMqtt({ on: !settings.on })}>
          <h2>{title}</h2>
        </Switch>
        <span className="grow" />
        {settings.on && connected && (
          <span className="faint num">{t("communication.mqtt.now", { count: published })}</span>
        )}
        {settings.on && !connected && (
          <StateWord tone="generated" icon="generated" word={t("communication.mqtt.lost")} />
        )}
      </div>
      <p className="muted comabout">{t("communication.mqtt.about")}</p>
      {said !== "" && (
        <p className="trouble st warning" role="alert">
          <Icon name="warning" small />
          <span>{said}</span>
        </p>
      )}
      <Settings settings={settings} />
      {settings.on && <Frames frames={mqtt.frames} of={title} />}
    </section>
  );
}

/** What is typed stays as typed until it is applied; what somebody else applied meanwhile takes its place. */
function Settings({ settings }: { settings: MqttSettings }) {
  const { on: _on, ...known } = settings;
  const [draft, setDraft] = useState(() => textOf(known));
  const applied = JSON.stringify(textOf(known));
  useEffect(() => setDraft(JSON.parse(applied) as Draft), [applied]);
  const change = (part: Partial<Draft>) => setDraft((before) => ({ ...before, ...part }));
  return (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        const variables = draft.variables.split(/\s*[\n;]\s*/).filter((path) => path.trim() !== "");
        changeMqtt({ ...draft, variables: variables.map((path) => path.trim()) });
      }}
    >
      <div className="comsettings">
        <Field
          label={t("communication.mqtt.host")}
          look="sm"
          mono
          value={draft.host}
          onChange={(host) => change({ host })}
        />
        <Field
          label={t("communication.port")}
          look="sm comcount"
          mono
          number
          value={`${draft.port}`}
          onChange={(port) => change({ port: Number(port) })}
        />
        <Field
          label={t(draft.sparkplug ? "communication.mqtt.group" : "communication.mqtt.prefix")}
          look="sm"
          mono
          value={draft.prefix}
          onChange={(prefix) => change({ prefix })}
        />
        <Field
          label={t("communication.plant.every")}
          look="sm comcount"
          mono
          number
          value={`${draft.every_ms}`}
          onChange={(every) => change({ every_ms: Number(every) })}
        />
        <span className="field">
          <span>{t("communication.mqtt.form")}</span>
          <Segments
            label={t("communication.mqtt.form")}
            value={draft.sparkplug ? "sparkplug" : "json"}
            options={[
              { value: "json", word: t("communication.mqtt.json") },
              { value: "sparkplug", word: t("communication.mqtt.sparkplug") },
            ]}
            onChoose={(form) => change({ sparkplug: form === "sparkplug" })}
          />
        </span>
      </div>
      <label className="field comvariables">
        <span>{t("communication.mqtt.variables")}</span>
        <textarea
          className="inp mono"
          rows={Math.min(8, 2 + draft.variables.split("\n").length)}
          spellCheck={false}
          placeholder={"Main.level\nD100"}
          value={draft.variables}
          onChange={(event) => change({ variables: event.target.value })}
        />
      </label>
      <button type="submit" className="btn sm" disabled={JSON.stringify(draft) === applied}>
        {t("communication.apply")}
      </button>
    </form>
  );
}

type Draft = Omit<MqttSettings, "on" | "variables"> & { variables: string };

const textOf = (settings: Omit<MqttSettings, "on">): Draft => ({
  ...settings,
  variables: settings.variables.join("\n"),
});
