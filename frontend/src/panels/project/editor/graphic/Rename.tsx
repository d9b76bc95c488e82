import { t } from "../../../../text";
import { AskName } from "../../../../ui/AskName";
import { renameAt } from "../rename";
import type { Operand } from "./operand";

/** Asks for a different name of a variable, in all files. */
export function Rename({ path, operand, onClose }: { path: string; operand: Operand; onClose: () => void }) {
  const last = operand.name.split(".").at(-1) ?? "";
  // Of `jam.Q` the last part is what is renamed.
  const at = { line: operand.line, column: operand.column + operand.name.length - last.length };
  return (
    <AskName
      title={t("graphic.rename", { name: last })}
      about={t("graphic.rename.about")}
      label={t("graphic.rename.label")}
      action={t("graphic.rename.do")}
      initial={last}
      onName={(name) => renameAt(path, at, name)}
      onClose={onClose}
    />
  );
}
