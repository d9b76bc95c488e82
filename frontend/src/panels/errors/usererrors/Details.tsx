import { type Control, newDetail, textOf, withControl, withText } from "../../../logic/errors/userErrors";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import type { UserDetail } from "../../../wire/types";
import { Choices } from "./Choices";
import { Choose, Entry } from "./Entry";
import { NumberFields } from "./NumberFields";

interface Props {
  details: readonly UserDetail[];
  /** The problems of the details, by the rest of their path within the error. */
  found: ReadonlyMap<string, string>;
  onChange: (details: UserDetail[]) => void;
}

/** The details that are asked for when the error is raised. */
export function Details({ details, found, onChange }: Props) {
  const add = () => {
    const names = details.map(({ name }) => name);
    onChange([...details, newDetail("List", names)]);
  };
  return (
    <fieldset className="uedetails">
      <legend>{t("usererrors.details")}</legend>
      <p className="hint">{t("usererrors.details.about")}</p>
      {details.map((detail, index) => (
        <Detail
          // biome-ignore lint/suspicious/noArrayIndexKey: names change while one types
          key={index}
          detail={detail}
          found={within(found, `details.${index}`)}
          onChange={(changed) => onChange(details.map((other, at) => (at === index ? changed : other)))}
          onRemove={() => onChange(details.toSpliced(index, 1))}
        />
      ))}
      <button type="button" className="btn sm" onClick={add}>
        <Icon name="plus" small />
        {t("usererrors.detail.add")}
      </button>
    </fieldset>
  );
}

function within(found: ReadonlyMap<string, string>, path: string): ReadonlyMap<string, string> {
  const inside = [...found].filter(([key]) => key === path || key.startsWith(`${path}.`));
  return new Map(inside.map(([key, message]) => [key.slice(path.length + 1), message]));
}

interface DetailProps {
  detail: UserDetail;
  found: ReadonlyMap<string, string>;
  onChange: (detail: UserDetail) => void;
  onRemove: () => void;
}

function Detail({ detail, found, onChange, onRemove }: DetailProps) {
  const { name, control, addresses, texts } = detail;
  const [first] = addresses;
  return (
    <div className="uedetail" role="group" aria-label={`${t("usererrors.detail.name")} ${name}`}>
      <div className="uefields uedet">
        <Entry
          label={t("usererrors.detail.name")}
          value={name}
          mono
          onChange={(changed) => onChange({ ...detail, name: changed })}
          wrong={found.get("name") ?? found.get("")}
        />
        <Choose
          label={t("usererrors.control")}
          value={control}
          options={{
            List: t("usererrors.control.List"),
            Spin: t("usererrors.control.Spin"),
            Edit: t("usererrors.control.Edit"),
          }}
          onChange={(changed) => onChange(withControl(detail, changed as Control))}
          wrong={found.get("control")}
        />
        <Entry
          label={t("usererrors.description")}
          value={textOf(texts, "en", "description")}
          onChange={(text) => onChange({ ...detail, texts: withText(texts, "en", "description", text) })}
        />
        <IconButton icon="trash" small label={t("usererrors.detail.remove", { name })} onClick={onRemove} />
      </div>
      {control === "List" ? (
        <Choices detail={detail} found={found} onChange={onChange} />
      ) : (
        first && (
          <NumberFields
            control={control}
            address={first}
            found={within(found, "addresses.0")}
            onChange={(changed) => onChange({ ...detail, addresses: [changed] })}
          />
        )
      )}
    </div>
  );
}
