import { useEffect, useRef } from "react";
import { type Fitted, type HardwareField, isText, withField, withoutItem } from "../../../logic/errors/hardware";
import { changeHardware } from "../../../store/errors/hardware";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import type { HardwareKind, Problem } from "../../../wire/types";
import { kindWord, whatIs } from "./words";

interface Props {
  fitted: Fitted;
  range: HardwareKind | null;
  shows: { kind: boolean; number: boolean; place: boolean };
  /** It was added here just now: one types on in it. */
  fresh: boolean;
  problems: readonly Problem[];
}

type NumberField = "number" | "rack" | "slot";

/** One thing that is fitted, with what the checks say of it. */
export function Row({ fitted: { index, item }, range, shows, fresh, problems }: Props) {
  const row = useRef<HTMLTableRowElement>(null);
  useEffect(() => {
    if (fresh) row.current?.querySelector("input")?.focus();
  }, [fresh]);
  const what = whatIs(item);
  const bad = problems.length > 0;
  const set = (field: HardwareField, value: string | number | null) =>
    changeHardware((text) => withField(text, index, field, value));
  const number = (field: NumberField) => (
    <td className="hwnumber">
      <input
        type="number"
        className={`inp sm mono${bad ? " bad" : ""}`}
        aria-label={`${what}: ${t(`hardware.field.${field}`)}`}
        aria-invalid={bad}
        min={(field === "number" && range?.lowest) || 0}
        max={field === "number" ? range?.highest : undefined}
        value={item[field] ?? ""}
        onChange={({ target }) => set(field, target.value === "" ? null : Number(target.value))}
      />
    </td>
  );
  return (
    <>
      <tr ref={row} data-fitted={index}>
        {shows.number && number("number")}
        {shows.place && number("rack")}
        {shows.place && number("slot")}
        {shows.place && (
          <td>
            <input
              className={`inp sm mono${bad ? " bad" : ""}`}
              aria-label={`${what}: ${t("hardware.field.words")}`}
              aria-invalid={bad}
              title={t("hardware.field.words.hint")}
              autoComplete="off"
              value={item.words ?? ""}
              onChange={({ target }) => set("words", target.value === "" ? null : target.value)}
            />
          </td>
        )}
        <td>
          <div className="row">
            {shows.kind && <span className="mono muted">{kindWord(item.kind, "one") || "?"}</span>}
            <input
              className="inp sm"
              aria-label={`${what}: ${t(isText(item.kind) ? "hardware.field.text" : "hardware.field.name")}`}
              maxLength={100}
              autoComplete="off"
              value={item.name ?? ""}
              onChange={({ target }) => set("name", target.value === "" ? null : target.value)}
            />
          </div>
        </td>
        <td className="hwremove">
          <IconButton
            icon="x"
            small
            label={t("hardware.remove", { what })}
            onClick={() => changeHardware((text) => withoutItem(text, index))}
          />
        </td>
      </tr>
      {problems.map(({ column, message }) => (
        <tr key={`${column}:${message}`} className="hwwrong">
          <td colSpan={6}>
            <span className="hint bad" role="alert">
              <Icon name="error" small />
              <span>{message}</span>
            </span>
          </td>
        </tr>
      ))}
    </>
  );
}
