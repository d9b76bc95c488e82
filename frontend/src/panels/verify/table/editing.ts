import { type RefObject, useState } from "react";
import { literalOf } from "../../../logic/format/formats";
import { plainArrangement, type Track } from "../../../logic/verify/verifyColumns";
import { shapeOf, shownValue } from "../../../logic/verify/verifyValues";
import { type ShownVerification, setCell } from "../../../store/verify/verify";
import { useArrangements } from "../../../store/verify/verifyColumns";
import { selectRow } from "../../../store/verify/verifyRows";
import type { VerifyRow } from "../../../wire/types";

export interface Editing {
  at: { index: number; track: string } | null;
  draft: string;
  /** Nothing was typed yet: the first key replaces the content. */
  fresh: boolean;
  refused: string | null;
  begin: (row: VerifyRow, track: Track) => void;
  type: (text: string) => void;
  enter: () => void;
  leave: () => void;
}

/** One input that is edited in its cell. A refused entry stays as typed, with the reason below. */
export function useEditing(shown: ShownVerification, grid: RefObject<HTMLElement | null>): Editing {
  const [at, setAt] = useState<{ index: number; track: string; row: VerifyRow; of: Track } | null>(null);
  const [draft, setDraft] = useState("");
  const [fresh, setFresh] = useState(true);
  const [refused, setRefused] = useState<string | null>(null);
  const range = shown.info.title;
  const formatOf = (name: string) =>
    (useArrangements.getState().of.get(range) ?? plainArrangement).formats[name] ?? "default";

  function begin(row: VerifyRow, track: Track): void {
    if (shown.record || track.kind !== "input" || !track.unit) return;
    const { column } = track.unit;
    const input = row.inputs[column.name];
    if (!input) return;
    setAt({ index: row.index, track: track.key, row, of: track });
    setDraft(shownValue(column, input.set ?? input.recorded, formatOf(column.name)).text);
    setFresh(true);
    setRefused(null);
    selectRow(row.index, track.key);
  }

  function leave(): void {
    setAt(null);
    setRefused(null);
    grid.current?.focus();
  }

  function type(text: string): void {
    setDraft(text);
    setFresh(false);
  }

  async function enter(): Promise<void> {
    if (!at?.of.unit) return;
    const { column } = at.of.unit;
    const text = draft.trim();
    const value = text === "" ? "" : literalOf(shapeOf(column), formatOf(column.name), text);
    const why = await setCell(at.row.scan, at.row.call, column.name, value);
    if (why === null) leave();
    else setRefused(why);
  }

  return { at, draft, fresh, refused, begin, type, enter: () => void enter(), leave };
}
