/** The label, the title and the comment of a rung or network, as they are named in a field. */

import { type Edit, isName, type Made } from "./edit";
import type { Place } from "./ladderLayout";
import { writeHead } from "./ladderWrite";
import type { Found } from "./networks";
import type { Head } from "./tree";

type HeadField = "label" | "title" | "comment";

const FIELDS: Readonly<Record<string, HeadField>> = { l: "label", t: "title", ";": "comment" };

/** What the keys `L`, `T` and `;` open; null for other keys. Lines of a comment are divided by `//`, as in the text. */
export function headEdit(found: Found, key: string, place: Place): Made {
  const field = FIELDS[key.toLowerCase()];
  if (!field) return null;
  const { head, text } = found;
  const edit = (changed: Head): Edit => ({ text: withHead(found, changed), place, naming: null });
  const taken = (typed: string): Edit | null => {
    const wanted = typed.trim();
    if (field === "comment") {
      const lines = wanted === "" ? [] : wanted.replace(/^\/\//, "").split("//");
      return edit({ ...head, comment: lines.map((line) => line.trim()) });
    }
    if (field === "label" && wanted !== "" && !isName(wanted)) return null;
    return edit({ ...head, [field]: wanted });
  };
  const value = field === "comment" ? head.comment.join(" // ") : head[field];
  return { text, place, naming: { value, offers: "none", head: field, taken } };
}

/** The text with a different head; a comment after the first line stays there. */
function withHead({ text, indent, kind, body }: Found, head: Head): string {
  const first = text.slice(0, text.indexOf("\n") < 0 ? text.length : text.indexOf("\n"));
  const plain = first.replace(/"(?:[^"$]|\$.)*"/g, (title) => " ".repeat(title.length));
  const rest = plain.includes("//") ? ` ${first.slice(plain.indexOf("//")).trimEnd()}` : "";
  const [line = "", ...below] = writeHead(kind === "rung" ? "RUNG" : "NETWORK", head, indent)
    .trimEnd()
    .split("\n");
  return [line + rest, ...below].join("\n") + text.slice(body.at);
}
