import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import type { PlantRange } from "../../../wire/types";

const GROUPS = ["discrete input", "input register", "coil", "holding register"] as const;
const NEXT: PlantRange = { group: "discrete input", first: 0, count: 16, address: "", to: "plc" };

interface Props {
  ranges: readonly PlantRange[];
  onChange: (ranges: PlantRange[]) => void;
}

/** What of the plant is wired to which memory of the PLC. */
export function PlantRanges({ ranges, onChange }: Props) {
  const title = t("communication.plant.ranges");
  const replace = (at: number, part: Partial<PlantRange>) =>
    onChange(ranges.map((each, number) => (number === at ? { ...each, ...part } : each)));
  return (
    <>
      {ranges.length === 0 && <p className="faint">{t("communication.plant.ranges.none")}</p>}
      {ranges.length > 0 && (
        <table className="comtable comranges" aria-label={title}>
          <thead>
            <tr>
              <th scope="col">{t("communication.plant.of")}</th>
              <th scope="col">{t("communication.map.first")}</th>
              <th scope="col">{t("communication.plant.count")}</th>
              <th scope="col">{t("communication.plant.way")}</th>
              <th scope="col">{t("communication.plant.memory")}</th>
              <th scope="col" aria-label={t("communication.plant.remove.column")} />
            </tr>
          </thead>
          <tbody>
            {ranges.map((range, at) => (
              <Range
                // biome-ignore lint/suspicious/noArrayIndexKey: a range has no name, and what is typed stays in its place
                key={at}
                number={at + 1}
                range={range}
                onChange={(part) => replace(at, part)}
                onRemove={() => onChange(ranges.filter((_, number) => number !== at))}
              />
            ))}
          </tbody>
        </table>
      )}
      <button type="button" className="btn sm" onClick={() => onChange([...ranges, NEXT])}>
        <Icon name="plus" small />
        {t("communication.plant.add")}
      </button>
    </>
  );
}

interface RangeProps {
  number: number;
  range: PlantRange;
  onChange: (part: Partial<PlantRange>) => void;
  onRemove: () => void;
}

function Range({ number, range, onChange, onRemove }: RangeProps) {
  const written = range.group === "coil" || range.group === "holding register";
  const named = (word: string) => t("communication.plant.range", { number, word });
  return (
    <tr>
      <td>
        <select
          className="inp sm"
          aria-label={named(t("communication.plant.of"))}
          value={range.group}
          onChange={(event) => {
            const group = event.target.value as PlantRange["group"];
            onChange({ group, to: group === "coil" || group === "holding register" ? "plant" : "plc" });
          }}
        >
          {GROUPS.map((each) => (
            <option key={each} value={each}>
              {t(`communication.map.${each}`)}
            </option>
          ))}
        </select>
      </td>
      <td>
        <input
          className="inp sm mono comcount"
          type="number"
          aria-label={named(t("communication.map.first"))}
          value={range.first}
          onChange={(event) => onChange({ first: Number(event.target.value) })}
        />
      </td>
      <td>
        <input
          className="inp sm mono comcount"
          type="number"
          aria-label={named(t("communication.plant.count"))}
          value={range.count}
          onChange={(event) => onChange({ count: Number(event.target.value) })}
        />
      </td>
      <td>
        {written ? (
          <select
            className="inp sm"
            aria-label={named(t("communication.plant.way"))}
            value={range.to}
            onChange={(event) => onChange({ to: event.target.value as PlantRange["to"] })}
          >
            <option value="plant">{t("communication.plant.to.plant")}</option>
            <option value="plc">{t("communication.plant.to.plc")}</option>
          </select>
        ) : (
          <span className="muted">{t("communication.plant.to.plc")}</span>
        )}
      </td>
      <td>
        <input
          className="inp sm mono comaddressinput"
          aria-label={named(t("communication.plant.memory"))}
          value={range.address}
          spellCheck={false}
          onChange={(event) => onChange({ address: event.target.value })}
        />
      </td>
      <td>
        <IconButton icon="trash" small label={t("communication.plant.remove", { number })} onClick={onRemove} />
      </td>
    </tr>
  );
}
