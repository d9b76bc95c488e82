import { useEffect, useState } from "react";
import { changeMqtt, useCommunication } from "../../../store/plc/communication";
import { t } from "../../../text";
import { Field } from "../../../ui/Field";
import { Icon } from "../../../ui/Icon";
import { Segments } from "../../../ui/Segments";
import { StateWord } from "../../../ui/StateWord";
import { Switch } from "../../../ui/Switch";
import type { CommunicationMqtt, MqttSettings } from "../../../wire/types";
import { Count, HostAndPort } from "./Fields";
import { Proofs } from "./Proofs";
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
      <Settings mqtt={mqtt} />
      {settings.on && <Frames frames={mqtt.frames} of={title} told />}
    </section>
  );
}

/** What is typed stays as typed until it is applied; what somebody else applied meanwhile takes its place. */
function Settings({ mqtt }: { mqtt: CommunicationMqtt }) {
  const { on: _on, ...known } = mqtt.settings;
  const [draft, setDraft] = useState(() => textOf(known));
  const applied = JSON.stringify(textOf(known));
  useEffect(() => setDraft(JSON.parse(applied) as Draft), [applied]);
  const change = (part: Partial<Draft>) => setDraft((before) => ({ ...before, ...part }));
  return (
    <form
      onSubmit={async (event) => {
        event.preventDefault();
        const variables = draft.variables.split(/\s*[\n;]\s*/).filter((path) => path.trim() !== "");
        const done = await changeMqtt({ ...draft, variables: variables.map((path) => path.trim()) });
        if (done) setDraft(({ password: _password, identity: _identity, ...rest }) => rest);
      }}
    >
      <div className="comsettings">
        <HostAndPort label={t("communication.mqtt.host")} host={draft.host} port={draft.port} onChange={change} />
        <Field
          label={t(draft.sparkplug ? "communication.mqtt.group" : "communication.mqtt.prefix")}
          look="sm"
          mono
          value={draft.prefix}
          onChange={(prefix) => change({ prefix })}
        />
        <Count
          label={t("communication.plant.every")}
          value={draft.every_ms}
          onChange={(every_ms) => change({ every_ms })}
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
      <Proofs mqtt={mqtt} draft={draft} onChange={change} />
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

type Draft = Omit<MqttSettings, "on" | "variables"> & { variables: string; password?: string; identity?: string };

const textOf = (settings: Omit<MqttSettings, "on">): Draft => ({
  ...settings,
  variables: settings.variables.join("\n"),
});
