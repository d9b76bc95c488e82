import { useBench } from "../../../store/plc/bench";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { Pou } from "../../../wire/types";
import { verifyHere } from "./verifyHere";

/** Only code that runs can be verified. */
const VERIFIED: readonly Pou["kind"][] = ["program", "function_block", "function", "method", "action"];

export const canVerify = ({ kind }: Pick<Pou, "kind">) => VERIFIED.includes(kind);

/** Verifies the selected lines, or the POU at the caret. */
export function VerifyButton({ path, pou }: { path: string; pou: Pick<Pou, "kind"> | undefined }) {
  const instance = useBench((bench) => bench.instance);
  if (!instance || !pou || !canVerify(pou)) return null;
  return (
    <button
      type="button"
      className="btn quiet sm"
      aria-label={t("verify.range.menu")}
      title={t("verify.range.hint")}
      onClick={() => verifyHere(path)}
    >
      <Icon name="differs" small />
      <span className="wide-only">{t("verify.menu")}</span>
    </button>
  );
}
