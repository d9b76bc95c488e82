import { freeId, newChoice, textOf, withText } from "../../../logic/errors/userErrors";
import { useWidths } from "../../../store/page/columns";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import { useColumns } from "../../../ui/useColumns";
import type { UserAddress, UserDetail } from "../../../wire/types";
import { Choose, Wrong } from "./Entry";

interface Props {
  detail: UserDetail;
  found: ReadonlyMap<string, string>;
  onChange: (detail: UserDetail) => void;
}

const TYPES = ["Bit", "Word", "Byte", "BCD", "Nibble", "BitArray"];

/** The choices of a List, each with the bit or number that it writes. */
export function Choices({ detail, found, onChange }: Props) {
  const { name, addresses } = detail;
  const { th } = useColumns(useWidths("choices"));
  const ids = addresses.map(({ id }) => id);
  const set = (index: number, changed: Partial<UserAddress>) =>
    onChange({ ...detail, addresses: addresses.map((each, at) => (at === index ? { ...each, ...changed } : each)) });
  const add = () =>
    onChange({ ...detail, addresses: [...addresses, { ...newChoice(), id: freeId(`choice-${ids.length + 1}`, ids) }] });
  return (
    <>
      <table className="uechoices" aria-label={t("usererrors.choices", { name })}>
        <thead>
          <tr>
            {(["choice.id", "description", "address", "type", "value", "adds.choice"] as const).map((column) =>
              th(column, t(`usererrors.${column}`)),
            )}
            <td />
          </tr>
        </thead>
        <tbody>
          {addresses.map((address, index) => (
            <Choice
              // biome-ignore lint/suspicious/noArrayIndexKey: ids change while one types
              key={index}
              number={index + 1}
              address={address}
              wrong={(field) => found.get(field ? `addresses.${index}.${field}` : `addresses.${index}`)}
              onChange={(changed) => set(index, changed)}
              onRemove={
                addresses.length > 1
                  ? () => onChange({ ...detail, addresses: addresses.toSpliced(index, 1) })
                  : undefined
              }
            />
          ))}
        </tbody>
      </table>
      <div className="row uefoot">
        <button type="button" className="btn sm" onClick={add}>
          <Icon name="plus" small />
          {t("usererrors.choice.add")}
        </button>
        <Choose
          label={t("usererrors.default")}
          value={detail.default}
          options={{
            "": t("usererrors.default.first"),
            ...Object.fromEntries(ids.filter(Boolean).map((id) => [id, id])),
          }}
          onChange={(changed) => onChange({ ...detail, default: changed })}
          wrong={found.get("default")}
        />
      </div>
    </>
  );
}

interface ChoiceProps {
  number: number;
  address: UserAddress;
  wrong: (field: string) => string | undefined;
  onChange: (changed: Partial<UserAddress>) => void;
  onRemove: (() => void) | undefined;
}

function Choice({ number, address, wrong, onChange, onRemove }: ChoiceProps) {
  const fields = ["id", "address", "type", "value", "adds", ""];
  const messages = [...new Set(fields.flatMap((field) => wrong(field) ?? []))];
  const cell = (field: "id" | "address" | "value", label: string) => (
    <td>
      <input
        className={`inp mono${wrong(field) ? " bad" : ""}`}
        aria-label={`${label} ${number}`}
        aria-invalid={wrong(field) !== undefined}
        value={address[field]}
        spellCheck={false}
        autoComplete="off"
        onChange={(event) => onChange({ [field]: event.target.value })}
      />
    </td>
  );
  return (
    <>
      <tr>
        {cell("id", t("usererrors.choice.id"))}
        <td>
          <input
            className="inp"
            aria-label={`${t("usererrors.description")} ${number}`}
            value={textOf(address.texts, "en", "description")}
            onChange={(event) => onChange({ texts: withText(address.texts, "en", "description", event.target.value) })}
          />
        </td>
        {cell("address", t("usererrors.address"))}
        <td>
          <select
            className="inp"
            aria-label={`${t("usererrors.type")} ${number}`}
            value={address.type}
            onChange={(event) => onChange({ type: event.target.value })}
          >
            {TYPES.map((type) => (
              <option key={type}>{type}</option>
            ))}
          </select>
        </td>
        {cell("value", t("usererrors.value"))}
        <td className="mid">
          <input
            type="checkbox"
            className="box"
            aria-label={`${t("usererrors.adds")} ${number}`}
            checked={address.adds === "true" || address.adds === "1"}
            onChange={(event) => onChange({ adds: event.target.checked ? "true" : "" })}
          />
        </td>
        <td>
          {onRemove && (
            <IconButton icon="x" small label={t("usererrors.choice.remove", { number })} onClick={onRemove} />
          )}
        </td>
      </tr>
      {messages.length > 0 && (
        <tr>
          <td colSpan={7}>
            {messages.map((message) => (
              <Wrong key={message} message={message} />
            ))}
          </td>
        </tr>
      )}
    </>
  );
}
