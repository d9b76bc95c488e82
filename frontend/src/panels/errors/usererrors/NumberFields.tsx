import { t } from "../../../text";
import type { UserAddress } from "../../../wire/types";
import { Choose, Entry, Wrong } from "./Entry";

const NUMBER_TYPES = { Word: "Word", Byte: "Byte", BCD: "BCD", Nibble: "Nibble", BitArray: "BitArray" };

interface Props {
  control: string;
  address: UserAddress;
  found: ReadonlyMap<string, string>;
  onChange: (address: UserAddress) => void;
}

/** The address to which a Spin or an Edit writes its number, and the allowed numbers. */
export function NumberFields({ control, address, found, onChange }: Props) {
  const field = (name: "address" | "shift" | "width" | "min" | "max" | "default", label: string) => (
    <Entry
      label={label}
      value={address[name]}
      mono
      onChange={(text) => onChange({ ...address, [name]: text })}
      wrong={found.get(name)}
    />
  );
  const isText = address.base === "text";
  const bases: Record<string, string> = { "10": t("usererrors.base.10"), "16": t("usererrors.base.16") };
  if (control === "Edit") bases.text = t("usererrors.base.text");
  return (
    <>
      <div className="uefields ue4">
        {field("address", t("usererrors.address"))}
        <Choose
          label={t("usererrors.type")}
          value={address.type}
          options={NUMBER_TYPES}
          onChange={(type) => onChange({ ...address, type })}
          wrong={found.get("type")}
        />
        <Choose
          label={t("usererrors.base")}
          value={address.base || "10"}
          options={bases}
          onChange={(base) =>
            onChange(base === "text" ? asText(address) : { ...address, base: base === "10" ? "" : base })
          }
          wrong={found.get("base")}
        />
        {!isText && field("min", t("usererrors.limits"))}
        {field("max", t(isText ? "usererrors.max.text" : "usererrors.max"))}
        {!isText && field("default", t("usererrors.default"))}
        {!isText && field("shift", t("usererrors.first"))}
        {!isText && field("width", t("usererrors.width"))}
      </div>
      {!isText && (
        <label className="row ueadds" title={t("usererrors.adds.hint")}>
          <input
            type="checkbox"
            className="box"
            checked={address.adds === "true" || address.adds === "1"}
            onChange={(event) => onChange({ ...address, adds: event.target.checked ? "true" : "" })}
          />
          {t("usererrors.adds")}
        </label>
      )}
      <Wrong message={found.get("")} />
    </>
  );
}

/** A text has characters and none of the properties of a number. */
function asText(address: UserAddress): UserAddress {
  const none = { shift: "", width: "", value: "", min: "", default: "", adds: "" };
  return { ...address, ...none, type: "Word", base: "text", max: address.max || "8" };
}
