import { forbidden } from "../../logic/permits";
import { t } from "../../logic/text";
import type { Format } from "../../logic/values";
import type { ValueRow } from "../../logic/watchrows";
import { forceOf, useForces } from "../../store/forces";
import { usePlc } from "../../store/plc";
import { currentText } from "../../store/values";
import { useWatches } from "../../store/watches";
import { force, releaseForce, removeFromWatch, setFormat, useWatchList } from "../../store/watchlist";
import type { MenuItem } from "../../ui/Menu";

const FORMATS: readonly Format[] = ["default", "decimal", "hex", "binary"];

/** What can be done with a row of the watch table. */
export function rowMenu(row: ValueRow): MenuItem[] {
  const symbol = row.symbol ?? useWatches.getState().symbols.get(row.path) ?? null;
  const { drafts, formats } = useWatchList.getState();
  const forced = forceOf(useForces.getState(), row.path) !== undefined;
  const plc = usePlc.getState();
  const locked = forbidden(plc.state, plc.link.state === "open", "force");
  const single = symbol !== null && !symbol.expandable;
  const value = drafts.get(row.path) || currentText(row.path);
  const items: MenuItem[] = [];
  if (single && symbol.writable) {
    items.push(
      {
        label: t("force.to", { value }),
        icon: "forced",
        hint: locked ? t(locked) : undefined,
        disabled: locked !== null || value === "",
        onSelect: () => void force(row.path, value),
      },
      {
        label: t("force.release"),
        icon: "unforce",
        disabled: locked !== null || !forced,
        onSelect: () => void releaseForce(row.path),
      },
    );
  }
  if (single && ["int", "uint", "bits"].includes(symbol.kind)) {
    const chosen = formats.get(row.path) ?? "default";
    items.push(
      ...FORMATS.map(
        (format, index): MenuItem => ({
          label: t(`format.${format}`),
          checked: format === chosen,
          separated: index === 0,
          onSelect: () => setFormat(row.path, format),
        }),
      ),
    );
  }
  items.push(
    { label: t("copy.path"), separated: true, onSelect: () => copy(row.path) },
    { label: t("copy.value"), disabled: !single, onSelect: () => copy(currentText(row.path)) },
    { label: t("watch.remove"), hint: "Del", separated: true, onSelect: () => removeFromWatch(row.root) },
  );
  return items;
}

function copy(text: string): void {
  void navigator.clipboard?.writeText(text);
}
