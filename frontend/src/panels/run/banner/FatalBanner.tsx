import { detailsInWords } from "../../../logic/errors/catalogue";
import { codeText } from "../../../logic/errors/codeText";
import { grouped } from "../../../logic/format/numbers";
import { backTo, modeBefore } from "../../../store/debug/run";
import { useCatalogue } from "../../../store/errors/catalogue";
import { useDevice } from "../../../store/errors/device";
import { clearFatal, forgetOutcome } from "../../../store/errors/simulator";
import { usePlc } from "../../../store/plc/plc";
import { travel } from "../../../store/plc/timeline";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { InstanceState, Mode } from "../../../wire/types";

async function goOn(mode: Mode): Promise<void> {
  if (!(await clearFatal())) return;
  await backTo(mode);
  // Drops the message of the recovery ("the program stays stopped"), which is no longer true.
  forgetOutcome();
}

/** A fatal error: its code and cause, its effect, and how to recover. */
export function FatalBanner({ state }: { state: InstanceState }) {
  const errors = usePlc((plc) => plc.errors);
  const { byId } = useCatalogue();
  const fatal = [...errors.values()].filter((row) => row.status === "generated" && row.severity === "fatal");
  // In simplex the standby took over for the errors before the last one.
  const simplex = useDevice((device) => device.found?.standby?.duplex === false);
  const [first] = fatal;
  const latest = [...fatal].sort((a, b) => (b.generated_scan ?? 0) - (a.generated_scan ?? 0))[0];
  const cause = simplex ? latest : first;
  const error = cause && byId.get(cause.id);
  const details = [cause?.label, detailsInWords(error, cause?.details ?? "")].filter(Boolean).join(", ");
  const title = cause
    ? t("fatal.title", { code: codeText(cause.code), name: error?.name ?? cause.name })
    : t("fatal.plain");
  const scan = cause?.generated_scan ?? state.scan;
  const mode = modeBefore();
  return (
    <div className="banner fatal" role="alert">
      <Icon name="fatal" />
      <span className="grow">
        <b>{title}</b>
        {details ? ` (${details}). ` : ". "}
        <span className="muted">
          {t(mode === "PROGRAM" ? "fatal.about" : "fatal.about.goon", { scan: grouped(scan), mode })}
        </span>
      </span>
      {scan > 0 && (
        <button type="button" className="btn sm" title={t("fatal.before.hint")} onClick={() => void travel(scan - 1)}>
          <Icon name="past" small />
          {t("fatal.before")}
        </button>
      )}
      {mode !== "PROGRAM" && (
        <button type="button" className="btn sm" title={t("fatal.goon.hint", { mode })} onClick={() => void goOn(mode)}>
          {t("fatal.goon")}
        </button>
      )}
      <button type="button" className="btn danger sm" onClick={() => void clearFatal()}>
        {fatal.length > 1 ? t("fatal.clear.all", { count: String(fatal.length) }) : t("fatal.clear")}
      </button>
    </div>
  );
}
