import { complete } from "../../store/plc/completion";
import { addAllToTrace } from "../../store/trace/traces";
import { t } from "../../text";
import { PathBox } from "../../ui/PathBox";
import type { PlcSymbol } from "../../wire/types";

/** Typing a variable, an address or an expression to record, with what the program has to offer. */
export function AddSignal() {
  async function record(text: string): Promise<{ text: string }> {
    const signal = text.trim();
    return { text: signal !== "" && (await addAllToTrace([signal])) ? "" : text };
  }

  /** What has members is gone on into; the rest is recorded. */
  function take({ path, kind, expandable }: PlcSymbol) {
    return expandable ? { text: kind === "array" ? `${path}[` : `${path}.` } : record(path);
  }

  return (
    <PathBox
      className="traddbox"
      label={t("trace.add")}
      placeholder={t("trace.add.placeholder")}
      complete={complete}
      onType={record}
      onTake={take}
    />
  );
}
