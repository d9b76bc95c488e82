import { useEffect, useId, useState } from "react";
import { changeServer } from "../../../store/plc/communication";
import { t } from "../../../text";
import { CopyButton } from "../../../ui/CopyButton";
import { Icon } from "../../../ui/Icon";
import { Segments } from "../../../ui/Segments";
import { Switch } from "../../../ui/Switch";
import type { CommunicationServer, CommunicationServerSettings } from "../../../wire/types";
import { Line } from "./Line";
import { Clients, Frames } from "./Seen";

/** One server: how it is set, and what happens there. */
export function Server({ server }: { server: CommunicationServer }) {
  const { kind, settings, listening, trouble } = server;
  const title = t(`communication.kind.${kind}`);
  return (
    <section className="comserver" aria-label={title} data-server={kind}>
      <div className="row">
        <Switch on={settings.on ?? false} onToggle={() => changeServer(kind, { on: !settings.on })}>
          <h2>{title}</h2>
        </Switch>
        <span className="grow" />
        {listening && (
          <span className="faint num">{t("communication.persecond", { count: Math.round(server.per_second) })}</span>
        )}
      </div>
      {trouble !== "" && (
        <p className="trouble st warning" role="alert">
          <Icon name="warning" small />
          <span>{trouble}</span>
        </p>
      )}
      {listening && <Address server={server} />}
      <Settings kind={kind} settings={settings} />
      {settings.on && <Line kind={kind} fault={server.fault} />}
      {listening && (
        <>
          <Clients clients={server.clients} of={title} />
          <Frames frames={server.frames} of={title} />
        </>
      )}
    </section>
  );
}

function Address({ server: { address } }: { server: CommunicationServer }) {
  return (
    <p className="row comaddress">
      <span className="muted">{t("communication.address")}</span>
      <b className="mono">{address}</b>
      <CopyButton label={t("communication.copy")} done={t("communication.copied")} text={() => address} />
    </p>
  );
}

interface SettingsProps {
  kind: CommunicationServer["kind"];
  settings: CommunicationServerSettings;
}

/** What is typed stays as typed until it is applied; what somebody else applied meanwhile takes its place. */
function Settings({ kind, settings }: SettingsProps) {
  const [draft, setDraft] = useState(settings);
  const applied = JSON.stringify(settings);
  useEffect(() => setDraft(JSON.parse(applied) as CommunicationServerSettings), [applied]);
  const change = (part: Partial<CommunicationServerSettings>) => setDraft((before) => ({ ...before, ...part }));
  const edited = JSON.stringify(draft) !== applied;
  return (
    <form
      className="comsettings"
      onSubmit={(event) => {
        event.preventDefault();
        const { on: _on, ...wanted } = draft;
        changeServer(kind, wanted);
      }}
    >
      <Text
        label={t("communication.host")}
        title={t("communication.host.about")}
        value={draft.host ?? ""}
        onChange={(host) => change({ host })}
      />
      <Count
        label={t("communication.port")}
        title={t("communication.port.about")}
        value={draft.port ?? 0}
        onChange={(port) => change({ port })}
      />
      {kind === "fins" && (
        <Count label={t("communication.node")} value={draft.node ?? 1} onChange={(node) => change({ node })} />
      )}
      <span className="field">
        <span>{t("communication.access")}</span>
        <Segments
          label={t("communication.access")}
          value={draft.access ?? "read"}
          options={[
            { value: "read", word: t("communication.access.read") },
            { value: "write", word: t("communication.access.write") },
          ]}
          onChoose={(access) => change({ access })}
        />
      </span>
      {kind === "fins" && (
        <Switch on={draft.error_bits ?? true} onToggle={() => change({ error_bits: !(draft.error_bits ?? true) })}>
          <span title={t("communication.errorbits.about")}>{t("communication.errorbits")}</span>
        </Switch>
      )}
      <button type="submit" className="btn sm" disabled={!edited}>
        {t("communication.apply")}
      </button>
    </form>
  );
}

interface TextProps {
  label: string;
  title?: string;
  value: string;
  onChange: (value: string) => void;
}

function Text({ label, title, value, onChange }: TextProps) {
  const id = useId();
  return (
    <span className="field">
      <label htmlFor={id}>{label}</label>
      <input
        id={id}
        className="inp sm mono"
        title={title}
        value={value}
        autoComplete="off"
        spellCheck={false}
        onChange={(event) => onChange(event.target.value)}
      />
    </span>
  );
}

interface CountProps {
  label: string;
  title?: string;
  value: number;
  onChange: (value: number) => void;
}

function Count({ label, title, value, onChange }: CountProps) {
  const id = useId();
  return (
    <span className="field">
      <label htmlFor={id}>{label}</label>
      <input
        id={id}
        className="inp sm mono comcount"
        type="number"
        title={title}
        value={value}
        onChange={(event) => onChange(event.target.valueAsNumber || 0)}
      />
    </span>
  );
}
