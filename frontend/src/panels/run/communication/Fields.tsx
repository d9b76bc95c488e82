import { t } from "../../../text";
import { Field } from "../../../ui/Field";

interface HostAndPortProps {
  label: string;
  title?: string;
  /** What is said of the port. */
  about?: string;
  host: string;
  port: number;
  onChange: (part: { host?: string; port?: number }) => void;
}

/** Where something listens. */
export function HostAndPort({ label, title, about, host, port, onChange }: HostAndPortProps) {
  return (
    <>
      <Field label={label} title={title} look="sm" mono value={host} onChange={(host) => onChange({ host })} />
      <Count label={t("communication.port")} title={about} value={port} onChange={(port) => onChange({ port })} />
    </>
  );
}

interface CountProps {
  label: string;
  title?: string;
  value: number;
  onChange: (value: number) => void;
}

export function Count({ label, title, value, onChange }: CountProps) {
  return (
    <Field
      label={label}
      title={title}
      look="sm comcount"
      mono
      number
      value={`${value}`}
      onChange={(text) => onChange(Number(text))}
    />
  );
}
