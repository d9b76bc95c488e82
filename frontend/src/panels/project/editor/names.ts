/** The name under the mouse or the caret, and the POU around it. */
import { ownerOf, pouAt } from "../../../logic/plc/sourceLines";
import { shownText } from "../../../store/project/shownProgram";
import type { Pou } from "../../../wire/types";
import type { editor, IPosition } from "./monaco";

interface Name {
  /** The path up to the part that is meant: on `zone` of `zone.jams` it is `zone`. */
  text: string;
  from: number;
  to: number;
}

export function nameAt(model: editor.ITextModel, { lineNumber, column }: IPosition): Name | null {
  const line = model.getLineContent(lineNumber);
  for (const match of line.matchAll(/%?[\p{L}_][\p{L}\d_]*(?:\[[^\]]*\]|\.[\p{L}\d_]+|\^)*/gu)) {
    const from = match.index + 1;
    if (column < from || column > from + match[0].length) continue;
    const rest = /^(?:[\p{L}\d_]*)(?:\[[^\]]*\])*/u.exec(line.slice(column - 1))?.[0] ?? "";
    const to = Math.min(from + match[0].length, column + rest.length);
    return { text: line.slice(from - 1, to - 1), from, to };
  }
  return null;
}

const pathOfModel = (model: editor.ITextModel) => model.uri.path.slice(1);

/** A type declares the members of its variables and has no values itself, even if a variable of the same name exists. */
export const hasValues = ({ kind }: Pou) => kind !== "type" && kind !== "interface";

/** The POU around a line, whose variables are named there. */
export function pouOf(model: editor.ITextModel, line: number): Pou | undefined {
  const path = pathOfModel(model);
  const { pous, text } = shownText(path);
  const found = pouAt(pous, path, line, text);
  return found && ownerOf(pous, found);
}
