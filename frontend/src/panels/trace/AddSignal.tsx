import { complete } from "../../store/plc/completion";
import { addAllToTrace } from "../../store/trace/traces";
import { t } from "../../text";
import { PathBox } from "../../ui/PathBox";
import type { PlcSymbol } from "../../wire/types";

/** A field for a variable, an address or an expression to record, with completion. */
export function AddSignal() {
  async function record(text: string): Promise<{ text: string }> {
    const signal = text.trim();
    return { text: signal !== "" && (await addAllToTrace([signal])) ? "" : text };
  }

  /** Choosing a name with members continues with its members; any other name is recorded. */
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
