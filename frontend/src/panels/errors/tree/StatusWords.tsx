import { useEffect, useRef } from "react";
import { statusWords } from "../../../logic/errors/statusWords";
import { bindCell } from "../../../store/plc/values";
import { useWatches, watch } from "../../../store/plc/watches";
import { t } from "../../../text";

/** The words of the error memory, live, as the program sees them. */
export function StatusWords({ words, code }: { words: readonly string[]; code: readonly string[] }) {
  const shown = statusWords(words, code);
  const key = shown.flat().join(" ");
  // biome-ignore lint/correctness/useExhaustiveDependencies: the same words need no new watch
  useEffect(() => watch(shown.flat()), [key]);
  if (words.length === 0) return null;
  return (
    <div className="mem" role="group" aria-label={t("errors.memory")} title={t("errors.memory")}>
      {shown.map((parts) => (
        <span key={parts[0]}>
          {parts[0]}
          <b data-testid={`word:${parts[0]}`}>
            {parts.toReversed().map((word) => (
              <Word key={word} word={word} />
            ))}
          </b>
        </span>
      ))}
      <span className="grow" />
      <span className="faint caption">{t("errors.memory")}</span>
    </div>
  );
}

function Word({ word }: { word: string }) {
  const text = useRef<HTMLElement>(null);
  const known = useWatches((state) => state.symbols.has(word));
  // biome-ignore lint/correctness/useExhaustiveDependencies: reads the cell again when the symbol arrives
  useEffect(
    () =>
      bindCell(word, "word", (reading) => {
        if (text.current) text.current.textContent = reading.text || "····";
      }),
    [word, known],
  );
  return <span ref={text} />;
}
