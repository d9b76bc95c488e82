import { noPathIn, pathsIn } from "../../../logic/format/paths";
import { useBench } from "../../../store/plc/bench";
import { complete } from "../../../store/plc/completion";
import { addToWatch } from "../../../store/watch/watchlist";
import { t } from "../../../text";
import { PathBox } from "../../../ui/PathBox";

/** A field for a path, an address or a range of addresses, with completion. Enter adds it. */
export function AddBox() {
  // A model without areas has only variables to watch.
  const example = useBench(({ model }) => {
    const first = model?.areas[0]?.first;
    return [first, model?.code_word, first && `${first}:8`].filter(Boolean).join(", ");
  });

  function add(paths: readonly string[]): { text: string } {
    if (paths.length > 0) addToWatch(paths);
    return { text: "" };
  }

  function type(text: string): { text: string; odd?: string } {
    const odd = noPathIn(text);
    return odd === null ? add(pathsIn(text)) : { text, odd: t("watch.add.nopath", { text: odd }) };
  }

  // Pasting one line edits the field as usual; many lines are many entries.
  function paste(text: string): boolean {
    const many = /\S[\r\n]+\s*\S/.test(text);
    if (many) add(pathsIn(text));
    return many;
  }

  return (
    <PathBox
      label={t("watch.add")}
      placeholder={example ? t("watch.add.placeholder.address", { example }) : t("watch.add.placeholder")}
      complete={complete}
      onType={type}
      onTake={({ path }) => add([path])}
      onPaste={paste}
    />
  );
}
