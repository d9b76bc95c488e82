import { allErrors, detailsInWords } from "../../logic/catalogue";
import { grouped } from "../../logic/numbers";
import { t } from "../../logic/text";
import { useBench } from "../../store/bench";
import { usePlc } from "../../store/plc";
import { clearFatal } from "../../store/simulator";
import { Icon } from "../../ui/Icon";
import type { InstanceState } from "../../wire/types";

/** A fatal error: its code and cause, what it did, and the way back. */
export function FatalBanner({ state }: { state: InstanceState }) {
  const errors = usePlc((plc) => plc.errors);
  const cause = [...errors.values()].find((row) => row.status === "generated" && row.severity === "fatal");
  const count = [...errors.values()].filter((row) => row.status === "generated" && row.severity === "fatal").length;
  const model = useBench((bench) => bench.model);
  const error = allErrors(model?.catalogue ?? []).find((known) => known.id === cause?.id);
  const details = detailsInWords(error, cause?.details ?? "");
  const title = cause ? t("fatal.title", { code: cause.code, name: cause.name }) : t("fatal.plain");
  const scan = cause?.generated_scan ?? state.scan;
  return (
    <div className="banner fatal" role="alert">
      <Icon name="fatal" />
      <span className="grow">
        <b>{title}</b>
        {details ? ` (${details}). ` : ". "}
        <span className="muted">{t("fatal.about", { scan: grouped(scan) })}</span>
      </span>
      <button type="button" className="btn danger sm" onClick={() => void clearFatal()}>
        {count > 1 ? t("fatal.clear.all", { count: String(count) }) : t("fatal.clear")}
      </button>
    </div>
  );
}
