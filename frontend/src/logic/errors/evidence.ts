/** What a grade is about: words that were reached, state that decides later, statements that were not reached, and who says so. */

import { t } from "../../text";
import type { Reaction } from "../../wire/types";

/** A statement of the program. */
interface Place {
  file: string;
  line: number;
}

interface Item {
  /** A variable, an address or a statement. */
  text: string;
  /** Where the text leads to. */
  place: Place | null;
  says: string;
  /** Statements that belong to it. */
  readers: readonly string[];
}

interface Group {
  label: string;
  items: readonly Item[];
}

/** Whether the two runs say it, or the text of the program; empty where that is not known. */
export function basisOf({ basis }: Reaction): string {
  return basis === "" ? "" : t(`reaction.basis.${basis}`);
}

/** The evidence, by kind; kinds without any are left out. */
export function evidenceOf(reaction: Reaction): Group[] {
  const groups: Group[] = [
    {
      label: t("reaction.displayed"),
      items: reaction.displayed.map((text) => ({ text, place: null, says: "", readers: [] })),
    },
    {
      label: t("reaction.carried"),
      items: reaction.carried.map(({ path, scan, readers }) => ({
        text: path,
        place: null,
        says: t(readers.length === 0 ? "reaction.carried.unread" : "reaction.carried.since", { scan }),
        readers,
      })),
    },
    {
      label: t("reaction.decidedby"),
      items: reaction.decided_by.map((text) => ({ text, place: placeOf(text), says: "", readers: [] })),
    },
    { label: t("reaction.unreached"), items: reaction.unreached.map(itemOf) },
  ];
  return groups.filter(({ items }) => items.length > 0);
}

function itemOf({ file, line, paths, why, at }: Reaction["unreached"][number]): Item {
  const [first] = paths;
  const on =
    first === undefined
      ? ""
      : paths.length === 1
        ? first
        : t("reaction.unreached.on", { first, count: paths.length - 1 });
  const says = [on && `(${on}):`, t(`reaction.why.${why}`, { at })].filter(Boolean).join(" ");
  return { text: `${file}:${line}`, place: { file, line }, says, readers: [] };
}

/** `file:line` as a place. */
export function placeOf(text: string): Place | null {
  const at = text.lastIndexOf(":");
  const line = Number(text.slice(at + 1));
  return at > 0 && Number.isInteger(line) ? { file: text.slice(0, at), line } : null;
}
