import { scansOf } from "../../../logic/errors/shapes";
import { interval } from "../../../logic/format/numbers";
import { readScan } from "../../../logic/plc/timeline";
import { usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";

export interface GapForm {
  /** One by one, instead of all in one seam. */
  sequence: boolean;
  text: string;
  unit: "scans" | "ms";
}

const taskInterval = () => usePlc.getState().state?.interval_ns ?? 10_000_000;

/** Scans from one error to the next, 0 for all in one scan; null while the entry is invalid. */
export function gapOf({ sequence, text, unit }: GapForm): number | null {
  if (!sequence) return 0;
  const read = readScan(text);
  if (read === null || read < 1) return null;
  return unit === "scans" ? read : scansOf(read, taskInterval());
}

interface Props {
  form: GapForm;
  several: boolean;
  onForm: (form: GapForm) => void;
}

/** All in one scan, or one by one at a distance. */
export function Gap({ form, several, onForm }: Props) {
  const scans = gapOf(form);
  if (!several) return null;
  const choose = (sequence: boolean) => () => onForm({ ...form, sequence });
  return (
    <>
      <span className="muted">{t("dialog.apply")}</span>
      <span className="seg" role="group" aria-label={t("dialog.apply")}>
        <button
          type="button"
          className={form.sequence ? "" : "on"}
          aria-pressed={!form.sequence}
          onClick={choose(false)}
        >
          {t("dialog.apply.batch")}
        </button>
        <button type="button" className={form.sequence ? "on" : ""} aria-pressed={form.sequence} onClick={choose(true)}>
          {t("dialog.apply.sequence")}
        </button>
      </span>
      {form.sequence && (
        <>
          <input
            className={`inp mono count${scans === null ? " bad" : ""}`}
            aria-label={t("dialog.gap")}
            aria-invalid={scans === null}
            title={scans === null ? undefined : asScans(form, scans)}
            inputMode="numeric"
            value={form.text}
            onChange={(event) => onForm({ ...form, text: event.target.value })}
          />
          <select
            className="inp"
            aria-label={t("dialog.gap.unit")}
            value={form.unit}
            onChange={(event) => onForm({ ...form, unit: event.target.value as GapForm["unit"] })}
          >
            <option value="scans">{t("dialog.gap.scans")}</option>
            <option value="ms">{t("dialog.gap.ms")}</option>
          </select>
          {scans === null && (
            <span className="hint bad" role="alert">
              {t("dialog.gap.bad")}
            </span>
          )}
        </>
      )}
    </>
  );
}

function asScans({ unit }: GapForm, scans: number): string | undefined {
  return unit === "ms" ? t("dialog.gap.asscans", { scans, interval: interval(taskInterval()) }) : undefined;
}
