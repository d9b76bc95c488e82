import { useState } from "react";
import {
  type Fitted,
  type FittedItem,
  freeNumber,
  freePlace,
  hasNumber,
  hasPlace,
  isText,
  racksOf,
  withItem,
} from "../../../logic/errors/hardware";
import { changeHardware } from "../../../store/errors/hardware";
import { useBench } from "../../../store/plc/bench";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { HardwareKind, Problem } from "../../../wire/types";
import { Row } from "./Row";
import { UsedNumbers } from "./UsedNumbers";
import { kindWord } from "./words";

interface Props {
  /** Which kind, and its numbers; null: what the model does not have. */
  range: HardwareKind | null;
  fitted: readonly Fitted[];
  all: readonly Fitted[];
  problems: readonly Problem[];
}

/** Everything of one kind that is fitted. */
export function Kind({ range, fitted, all, problems }: Props) {
  const [fresh, setFresh] = useState<number | null>(null);
  const kind = range?.kind ?? "";
  const title = range ? kindWord(kind, "kind") : t("hardware.other");
  const shows = {
    kind: range === null,
    number: range === null || hasNumber(kind),
    place: range === null || hasPlace(kind),
  };
  const next = useNext(range, all);
  const numbers = range && hasNumber(kind) ? range.highest - range.lowest + 1 : 1;
  return (
    <section className="hwkind" aria-label={title}>
      <div className="row">
        <h3>{title}</h3>
        {range && hasNumber(kind) && <span className="faint num">{t("hardware.range", range)}</span>}
        <span className="grow" />
        {range && (
          <button
            type="button"
            className="btn sm"
            aria-label={t("hardware.add.of", { kind: title })}
            title={next ? undefined : t("hardware.full", { count: numbers })}
            disabled={!next}
            onClick={() => {
              if (!next) return;
              changeHardware((text) => withItem(text, next));
              setFresh(all.length);
            }}
          >
            <Icon name="plus" small />
            {t("hardware.add")}
          </button>
        )}
      </div>
      {fitted.length > 0 && (
        <table className="hwtable" aria-label={title}>
          <thead>
            <tr>
              {shows.number && <th scope="col">{t("hardware.field.number")}</th>}
              {shows.place && <th scope="col">{t("hardware.field.rack")}</th>}
              {shows.place && <th scope="col">{t("hardware.field.slot")}</th>}
              {shows.place && (
                <th scope="col" className="hwwords">
                  {t("hardware.field.words")}
                </th>
              )}
              <th scope="col">{t(isText(kind) ? "hardware.field.text" : "hardware.field.name")}</th>
              <td />
            </tr>
          </thead>
          <tbody>
            {fitted.map((one) => (
              <Row
                key={one.index}
                fitted={one}
                range={range}
                shows={shows}
                fresh={one.index === fresh}
                problems={problems.filter(({ line }) => one.first <= line && line <= one.last)}
              />
            ))}
          </tbody>
        </table>
      )}
      {range && isText(kind) && <UsedNumbers kind={kind} fitted={fitted} />}
    </section>
  );
}

/** What *Add* adds: the next free number, or the next empty slot; null when there is none. */
function useNext(range: HardwareKind | null, all: readonly Fitted[]): FittedItem | null {
  const fits = useBench((bench) => bench.model?.fits) ?? [];
  if (!range) return null;
  const { kind } = range;
  if (hasNumber(kind)) {
    const number = freeNumber(all, range);
    return number === null ? null : { kind, number };
  }
  if (!hasPlace(kind)) return all.some(({ item }) => item.kind === kind) ? null : { kind };
  const racks = fits.find((each) => each.kind === "rack");
  const slots = fits.find((each) => each.kind === "slot");
  const place = racks && slots ? freePlace(all, racksOf(all, racks), slots) : null;
  return place && { kind, ...place };
}
