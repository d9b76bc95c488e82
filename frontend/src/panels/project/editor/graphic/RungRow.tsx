import { type ReactNode, useEffect, useRef } from "react";
import type { Drawing, Place } from "../../../../logic/graphic/ladderLayout";
import type { DrawnRung } from "../../../../logic/graphic/rungs";
import type { Twice } from "../../../../logic/graphic/writers";
import { loadNames, seenAs, useSeenAs } from "../../../../store/debug/seenAs";
import { useMembers } from "../../../../store/plc/members";
import { useForces } from "../../../../store/watch/forces";
import { t } from "../../../../text";
import { Icon } from "../../../../ui/Icon";
import type { Pou } from "../../../../wire/types";
import { showLive } from "./live";
import type { RungMarks } from "./marks";
import { RungDrawing } from "./RungDrawing";

interface Props {
  rung: DrawnRung;
  number: number;
  /** The POU whose instance gives the values; undefined where there are none to show. */
  pou: Pou | undefined;
  id: string;
  /** The place of the cursor; null where it is in a different rung. */
  cursor: Place | null;
  /** While an element is named: how the rung will be, and the field. */
  naming: { drawing: Drawing; field: ReactNode } | null;
  marks: RungMarks;
  twice: readonly Twice[];
}

/** One rung: its number, label, title and comment, and its drawing; a text that cannot be read below the last drawing. */
export function RungRow({ rung, number, pou, id, cursor, naming, marks, twice }: Props) {
  const { found, path } = rung;
  const drawing = naming?.drawing ?? rung.drawing;
  const { label, title, comment, off } = found.head;
  const picture = useRef<HTMLDivElement>(null);
  const instance = useSeenAs((seen) => (pou === undefined ? undefined : seenAs(seen, pou.name)));
  const members = useMembers(({ of }) => of);
  const forces = useForces();

  useEffect(() => {
    if (pou !== undefined) void loadNames(pou.name);
  }, [pou]);
  // biome-ignore lint/correctness/useExhaustiveDependencies: what a name means depends on the instance and its variables, and forces are drawn
  useEffect(() => {
    const svg = picture.current?.querySelector("svg");
    if (!svg || !drawing || pou === undefined || off || path === null) return;
    return showLive(svg, drawing, pou);
  }, [drawing, pou, off, path, instance, members, forces]);

  return (
    <div
      className={`net${cursor === null ? "" : " cur"}${off ? " off" : ""}${marks.halt ? ` ${marks.halt.look}` : ""}`}
      role="group"
      aria-label={t("graphic.rung", { number, title: title || label })}
    >
      <span className="g" title={t(marks.any ? "graphic.breakpoint" : "debug.bp.hint")}>
        {marks.halt ? <Icon name={marks.any ? "here-bp" : "here"} small /> : marks.any && <Icon name="bp" small />}
      </span>
      <span className="no">{number}</span>
      <div className="netbody">
        <div className="hd">
          {label !== "" && <span className="lab">{label}:</span>}
          <b className="cut">{title}</b>
          <span className="cm cut">{comment.join(" ")}</span>
          {off && <span className="st faint">{t("graphic.off")}</span>}
          {twice.length > 0 && <span className="st warn cut">{twice.map(sayTwice).join("; ")}</span>}
          {marks.halt && <span className="st halted">{marks.next === "" ? marks.halt.text : t("graphic.next")}</span>}
          {path === null && <span className="st bad">{t("graphic.unread")}</span>}
        </div>
        <div ref={picture} className={`netdraw${path === null ? " netold" : ""}`}>
          {drawing && (
            <RungDrawing
              drawing={drawing}
              id={id}
              cursor={cursor?.join(".") ?? null}
              next={marks.next}
              points={marks.points}
            />
          )}
          {naming?.field}
        </div>
        {path === null && <pre className="nettext">{found.text}</pre>}
      </div>
    </div>
  );
}

const sayTwice = ({ name, rungs }: Twice) =>
  rungs.length === 1
    ? t("graphic.twice.here", { name })
    : t("graphic.twice", { name, rungs: rungs.map((index) => index + 1).join(", ") });
