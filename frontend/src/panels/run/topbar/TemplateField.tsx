import { type TextKey, t } from "../../../text";
import type { ProjectTemplate } from "../../../wire/types";

interface Props {
  templates: readonly ProjectTemplate[];
  value: string;
  /** The files come from an archive. */
  disabled: boolean;
  onChoose: (id: string) => void;
}

/** Asks what the program of a new project begins with. */
export function TemplateField({ templates, value, disabled, onChoose }: Props) {
  return (
    <label className="field">
      <span>{t("newproject.template")}</span>
      <select className="inp" value={value} disabled={disabled} onChange={({ target }) => onChoose(target.value)}>
        <option value="">{t("newproject.template.empty")}</option>
        {templates.map(({ id, name, model }) => (
          <option key={id} value={id}>
            {`${nameOf(id, name)} (${model})`}
          </option>
        ))}
      </select>
    </label>
  );
}

/** Names of the templates in the language of the page; a sample has its own. */
const NAMES: Readonly<Record<string, TextKey>> = {
  "error-handler": "template.error-handler",
  "instruction-list": "template.instruction-list",
  sequence: "template.sequence",
};

function nameOf(id: string, name: string): string {
  const key = NAMES[id];
  return key ? t(key) : t("newproject.template.sample", { name });
}
