import { t } from "../../../text";
import { Field } from "../../../ui/Field";
import { Switch } from "../../../ui/Switch";
import type { CommunicationMqtt } from "../../../wire/types";

interface Given {
  user: string;
  tls: boolean;
  ca: string;
  /** Undefined: the one that the server keeps, which it tells nobody. */
  password?: string;
  identity?: string;
}

interface Props {
  mqtt: CommunicationMqtt;
  draft: Given;
  onChange: (part: Partial<Given>) => void;
}

/** What the broker knows us by, and we know it by. */
export function Proofs({ mqtt, draft, onChange }: Props) {
  return (
    <>
      <div className="comsettings">
        <Field
          label={t("communication.mqtt.user")}
          look="sm"
          value={draft.user}
          onChange={(user) => onChange({ user })}
        />
        <Field
          label={t("communication.mqtt.password")}
          look="sm"
          secret
          placeholder={mqtt.password ? t("communication.mqtt.kept") : ""}
          value={draft.password ?? ""}
          onChange={(password) => onChange({ password })}
        />
        <Switch on={draft.tls} onToggle={() => onChange({ tls: !draft.tls })}>
          <span>{t("communication.mqtt.tls")}</span>
        </Switch>
        {draft.user !== "" && !draft.tls && <span className="faint">{t("communication.mqtt.clear")}</span>}
      </div>
      {draft.tls && (
        <>
          <Pem
            label={t("communication.mqtt.ca")}
            placeholder={t("communication.mqtt.ca.none")}
            value={draft.ca}
            onChange={(ca) => onChange({ ca })}
          />
          <Pem
            label={t("communication.mqtt.identity")}
            placeholder={t(mqtt.identity ? "communication.mqtt.kept" : "communication.mqtt.identity.none")}
            value={draft.identity ?? ""}
            onChange={(identity) => onChange({ identity })}
          />
        </>
      )}
    </>
  );
}

interface PemProps {
  label: string;
  placeholder: string;
  value: string;
  onChange: (value: string) => void;
}

function Pem({ label, placeholder, value, onChange }: PemProps) {
  return (
    <label className="field comvariables">
      <span>{label}</span>
      <textarea
        className="inp mono"
        rows={value === "" ? 2 : 4}
        spellCheck={false}
        autoComplete="off"
        placeholder={placeholder}
        value={value}
        onChange={(event) => onChange(event.target.value)}
      />
    </label>
  );
}
