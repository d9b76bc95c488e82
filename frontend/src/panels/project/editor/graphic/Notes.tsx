import type { DrawnPart } from "../../../../logic/graphic/sheet";
import type { Twice } from "../../../../logic/graphic/writers";
import { writesNothing } from "../../../../logic/graphic/writers";
import { t } from "../../../../text";
import { Icon, type IconName } from "../../../../ui/Icon";
import type { Wrong } from "./wrong";

export interface Note {
  look: "bad" | "warn" | "halted" | "faint";
  text: string;
  icon?: IconName;
}

/** What is said of a part by its text alone, the most important first. */
export function notesOf(part: DrawnPart, wrong: readonly Wrong[], twice: readonly Twice[]): Note[] {
  return [
    ...wrong.map(({ problem }): Note => ({ look: "bad", icon: "error", text: problem.message })),
    ...twice.map((each): Note => ({ look: "warn", text: sayTwice(each) })),
    ...(writesNothing(part) ? [{ look: "faint", text: t("graphic.nocoil") } as const] : []),
  ];
}

/** In one line at the right of a title: as many as have room. The others, and all that is cut off, are said by the pointer; below the drawing at the cursor. */
export function Notes({ notes }: { notes: readonly Note[] }) {
  if (notes.length === 0) return null;
  const all = notes.map(({ text }) => text);
  return (
    <span className="notes cut" title={all.join("\n")}>
      {notes.map(({ look, icon, text }, index) => (
        // biome-ignore lint/suspicious/noArrayIndexKey: a note is nothing but its place
        <span key={index} className={`st ${look}`}>
          {icon && <Icon name={icon} small />}
          {text}
        </span>
      ))}
    </span>
  );
}

const sayTwice = ({ name, rungs }: Twice) =>
  rungs.length === 1
    ? t("graphic.twice.here", { name })
    : t("graphic.twice", { name, rungs: rungs.map((index) => index + 1).join(", ") });
