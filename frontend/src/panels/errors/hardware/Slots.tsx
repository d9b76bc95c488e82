import {
  type Fitted,
  freeNumber,
  hasNumber,
  hasPlace,
  inSlot,
  racksOf,
  withItem,
} from "../../../logic/errors/hardware";
import { changeHardware } from "../../../store/errors/hardware";
import { t } from "../../../text";
import { MenuButton, type MenuItem } from "../../../ui/Menu";
import type { HardwareKind } from "../../../wire/types";
import { kindWord, whatIs } from "./words";

interface Props {
  fitted: readonly Fitted[];
  racks: HardwareKind;
  slots: HardwareKind;
  kinds: readonly HardwareKind[];
}

/** The racks as one sees them: what is in each slot; an empty one takes a unit. */
export function Slots({ fitted, racks, slots, kinds }: Props) {
  const numbers = Array.from({ length: slots.highest - slots.lowest + 1 }, (_, at) => slots.lowest + at);

  function items(rack: number, slot: number): MenuItem[] {
    return kinds
      .filter(({ kind }) => hasPlace(kind))
      .map((range) => {
        const { kind } = range;
        const number = hasNumber(kind) ? freeNumber(fitted, range) : undefined;
        return {
          label: number == null ? kindWord(kind, "one") : `${kindWord(kind, "one")} ${number}`,
          disabled: number === null,
          onSelect: () =>
            changeHardware((text) => withItem(text, { kind, ...(number == null ? {} : { number }), rack, slot })),
        };
      });
  }

  return (
    <div className="hwracks">
      {racksOf(fitted, racks).map((rack) => (
        <section key={rack} aria-label={t("hardware.slots", { rack })}>
          <h3>
            {kindWord("rack", "one")} {rack}
          </h3>
          <div className="hwslots">
            {numbers.map((slot) => {
              const unit = inSlot(fitted, rack, slot);
              const place = t("hardware.slot", { rack, slot });
              return unit ? (
                <Unit key={slot} unit={unit} place={place} slot={slot} />
              ) : (
                <MenuButton
                  key={slot}
                  label={`${place}: ${t("hardware.slot.empty")}`}
                  className="hwslot vacant"
                  items={() => items(rack, slot)}
                >
                  <small className="faint num">{slot}</small>
                  <span className="faint">{t("hardware.slot.empty")}</span>
                </MenuButton>
              );
            })}
          </div>
        </section>
      ))}
    </div>
  );
}

/** A unit in its slot: a click goes to its row. */
function Unit({ unit: { index, item }, place, slot }: { unit: Fitted; place: string; slot: number }) {
  const what = [whatIs(item), item.name].filter(Boolean).join(", ");
  return (
    <button
      type="button"
      className="hwslot"
      aria-label={`${place}: ${what}`}
      title={what}
      onClick={({ currentTarget }) =>
        currentTarget.closest(".hardware")?.querySelector<HTMLElement>(`[data-fitted="${index}"] input`)?.focus()
      }
    >
      <small className="faint num">{slot}</small>
      <span className="cut">{item.name || kindWord(item.kind, "one")}</span>
      <small className="cut muted">{item.name ? whatIs(item) : (item.number ?? "")}</small>
    </button>
  );
}
