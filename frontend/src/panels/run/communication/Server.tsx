import { useEffect, useState } from "react";
import { changeServer, useCommunication } from "../../../store/plc/communication";
import { t } from "../../../text";
import { CopyButton } from "../../../ui/CopyButton";
import { Icon } from "../../../ui/Icon";
import { Segments } from "../../../ui/Segments";
import { Switch } from "../../../ui/Switch";
import type { CommunicationServer, CommunicationServerSettings } from "../../../wire/types";
import { Count, HostAndPort } from "./Fields";
import { Line } from "./Line";
import { Clients, Frames } from "./Seen";

/** One server: how it is set, and what happens there. */
export function Server({ server }: { server: CommunicationServer }) {
  const { kind, settings, listening, trouble } = server;
  const title = t(`communication.kind.${kind}`);
  const refused = useCommunication(({ refused }) => refused?.kind === kind && refused.message);
  const said = refused || trouble;
  const form = useDraft(settings);
  // What is seen is what is switched on; switching off leaves what is typed as it is.
  const toggle = () => changeServer(kind, settings.on ? { on: false } : { ...form.draft, on: true });
  return (
    <section className="comserver" aria-label={title} data-server={kind}>
      <div className="row">
        <Switch on={settings.on} onToggle={toggle}>
          <h2>{title}</h2>
        </Switch>
        <span className="grow" />
        {listening && (
          <span className="faint num">{t("communication.persecond", { count: Math.round(server.per_second) })}</span>
        )}
      </div>
      {said !== "" && (
        <p className="trouble st warning" role="alert">
          <Icon name="warning" small />
          <span>{said}</span>
        </p>
      )}
      {listening && <Address server={server} />}
      {listening && kind === "opcua" && settings.access === "write" && (
        <p className="faint">{t("communication.users")}</p>
      )}
      <Settings kind={kind} {...form} />
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

type Wanted = Omit<CommunicationServerSettings, "on">;

interface Form {
  draft: Wanted;
  edited: boolean;
  change: (part: Partial<Wanted>) => void;
}

/** What is typed stays as typed until it is applied; what somebody else applied meanwhile takes its place. */
function useDraft({ on: _on, ...settings }: CommunicationServerSettings): Form {
  const [draft, setDraft] = useState<Wanted>(settings);
  const applied = JSON.stringify(settings);
  useEffect(() => setDraft(JSON.parse(applied) as Wanted), [applied]);
  const change = (part: Partial<Wanted>) => setDraft((before) => ({ ...before, ...part }));
  return { draft, edited: JSON.stringify(draft) !== applied, change };
}

function Settings({ kind, draft, edited, change }: Form & { kind: CommunicationServer["kind"] }) {
  return (
    <form
      className="comsettings"
      onSubmit={(event) => {
        event.preventDefault();
        changeServer(kind, draft);
      }}
    >
      <HostAndPort
        label={t("communication.host")}
        title={t("communication.host.about")}
        about={t("communication.port.about")}
        host={draft.host}
        port={draft.port}
        onChange={change}
      />
      {kind === "fins" && (
        <Count label={t("communication.node")} value={draft.node} onChange={(node) => change({ node })} />
      )}
      <span className="field">
        <span>{t("communication.access")}</span>
        <Segments
          label={t("communication.access")}
          value={draft.access}
          options={[
            { value: "read", word: t("communication.access.read") },
            { value: "write", word: t("communication.access.write") },
          ]}
          onChoose={(access) => change({ access })}
        />
      </span>
      {kind === "opcua" && draft.access === "write" && (
        <Switch on={draft.anonymous_writes} onToggle={() => change({ anonymous_writes: !draft.anonymous_writes })}>
          <span title={t("communication.anonymous.about")}>{t("communication.anonymous")}</span>
        </Switch>
      )}
      {kind === "fins" && (
        <Switch on={draft.error_bits} onToggle={() => change({ error_bits: !draft.error_bits })}>
          <span title={t("communication.errorbits.about")}>{t("communication.errorbits")}</span>
        </Switch>
      )}
      <button type="submit" className="btn sm" disabled={!edited}>
        {t("communication.apply")}
      </button>
      {draft.port === 0 && <span className="faint">{t("communication.port.any")}</span>}
    </form>
  );
}
