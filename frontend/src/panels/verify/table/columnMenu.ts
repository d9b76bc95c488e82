import { formatsFor } from "../../../logic/format/formats";
import { plainArrangement, type Unit } from "../../../logic/verify/verifyColumns";
import { shapeOf } from "../../../logic/verify/verifyValues";
import {
  moveColumn,
  setColumnFormat,
  toggleHidden,
  togglePinned,
  useArrangements,
} from "../../../store/verify/verifyColumns";
import { t } from "../../../text";
import type { MenuItem } from "../../../ui/Menu";

/** The actions for a column; the first two move it to the left and to the right. */
export function columnMenu(range: string, units: readonly Unit[], { key, column }: Unit): MenuItem[] {
  const arrangement = useArrangements.getState().of.get(range) ?? plainArrangement;
  const pinned = arrangement.pinned.includes(key);
  const chosen = arrangement.formats[column.name] ?? "default";
  return [
    { label: t("verify.column.left"), hint: "Alt+←", onSelect: () => moveColumn(range, units, key, -1) },
    { label: t("verify.column.right"), hint: "Alt+→", onSelect: () => moveColumn(range, units, key, 1) },
    { label: t(pinned ? "verify.unpin" : "verify.pin.menu"), onSelect: () => togglePinned(range, key) },
    { label: t("verify.column.hide"), onSelect: () => toggleHidden(range, key) },
    ...formatsFor(shapeOf(column)).map((format, at) => ({
      label: t(`format.${format}`),
      checked: format === chosen,
      separated: at === 0,
      onSelect: () => setColumnFormat(range, column.name, format),
    })),
  ];
}
