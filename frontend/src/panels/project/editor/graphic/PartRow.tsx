import { type ReactNode, useEffect, useRef } from "react";
import type { Drawing, Place } from "../../../../logic/graphic/ladderLayout";
import type { DrawnPart } from "../../../../logic/graphic/sheet";
import type { Twice } from "../../../../logic/graphic/writers";
import { loadNames, seenAs, useSeenAs } from "../../../../store/debug/seenAs";
import { useMembers } from "../../../../store/plc/members";
import { useForces } from "../../../../store/watch/forces";
import { t } from "../../../../text";
import { Icon } from "../../../../ui/Icon";
import type { Pou } from "../../../../wire/types";
import { ChartPicture } from "./ChartPicture";
import { DiagramPicture } from "./DiagramPicture";
import { clear } from "./follow";
import { showRung } from "./live";
import { showChart } from "./liveChart";
import { showDiagram } from "./liveDiagram";
import type { PartMarks } from "./marks";
import { RungDrawing } from "./RungDrawing";

interface Props {
  part: DrawnPart;
  number: number;
  /** The action of a chart that it is written in. */
  action: string | null;
  /** The POU whose instance gives the values; undefined where there are none to show. */
  pou: Pou | undefined;
  id: string;
  /** The place of the cursor; null where it is in a different part. */
  cursor: Place | null;
  /** While an element is named: how the rung will be, and the field. */
  naming: { drawing: Drawing; field: ReactNode } | null;
  marks: PartMarks;
  twice: readonly Twice[];
}

/** One rung, network or chart: its number, label, title and comment, and its drawing; a text that cannot be read below the last drawing. */
export function PartRow({ part, number, action, pou, id, cursor, naming, marks, twice }: Props) {
  const { found, readable } = part;
  const { label, title, comment, off } = found.head;
  const headline = part.kind === "chart" ? (pou?.name ?? "") : title;
  return (
    <div
      className={`net${cursor === null ? "" : " cur"}${off ? " off" : ""}${marks.halt ? ` ${marks.halt.look}` : ""}`}
      role="group"
      aria-label={t(`graphic.${part.kind}`, { number, title: headline || label })}
    >
      <span className="g" title={t(marks.any ? `graphic.breakpoint.${part.kind}` : "debug.bp.hint")}>
        {marks.halt ? <Icon name={marks.any ? "here-bp" : "here"} small /> : marks.any && <Icon name="bp" small />}
      </span>
      <span className="no">{number}</span>
      <div className="netbody">
        <div className="hd">
          {action !== null && <span className="cm">{action}</span>}
          {label !== "" && <span className="lab">{label}:</span>}
          <b className="cut">{headline}</b>
          <span className="cm cut">{comment.join(" ")}</span>
          {off && <span className="st faint">{t("graphic.off")}</span>}
          {twice.length > 0 && <span className="st warn cut">{twice.map(sayTwice).join("; ")}</span>}
          {marks.halt && <span className="st halted">{marks.next === "" ? marks.halt.text : t("graphic.next")}</span>}
          {!readable && <span className="st bad">{t("graphic.unread")}</span>}
        </div>
        <Picture part={part} pou={pou} id={id} cursor={cursor} naming={naming} marks={marks} />
        {!readable && <pre className="nettext">{found.text}</pre>}
      </div>
    </div>
  );
}

function Picture({
  part,
  pou,
  id,
  cursor,
  naming,
  marks,
}: Pick<Props, "part" | "pou" | "id" | "cursor" | "naming" | "marks">) {
  const picture = useRef<HTMLDivElement>(null);
  const instance = useSeenAs((seen) => (pou === undefined ? undefined : seenAs(seen, pou.name)));
  const members = useMembers(({ of }) => of);
  const forces = useForces();
  const rung = part.kind === "rung" ? (naming?.drawing ?? part.drawing) : null;
  const chart = part.kind === "chart" ? part.drawing : null;
  const diagram = part.kind === "network" ? part.drawing : null;
  const live = part.readable && !part.found.head.off;

  useEffect(() => {
    if (pou !== undefined) void loadNames(pou.name);
  }, [pou]);
  // biome-ignore lint/correctness/useExhaustiveDependencies: what a name means depends on the instance and its variables, and forces are drawn
  useEffect(() => {
    const svg = picture.current?.querySelector("svg");
    if (!svg || pou === undefined || !live) return;
    const stop =
      (rung && showRung(svg, rung, pou)) ||
      (diagram && showDiagram(svg, diagram, pou)) ||
      (chart && showChart(svg, chart, pou));
    return () => {
      stop?.();
      clear(svg);
    };
  }, [rung, diagram, chart, pou, live, instance, members, forces]);

  const marked = { id, cursor: cursor?.join(".") ?? null, next: marks.next, points: marks.points };
  return (
    <div ref={picture} className={`netdraw${part.readable ? "" : " netold"}`}>
      {rung && <RungDrawing drawing={rung} {...marked} />}
      {diagram && <DiagramPicture drawing={diagram} {...marked} />}
      {chart && <ChartPicture drawing={chart} {...marked} />}
      {naming?.field}
    </div>
  );
}

const sayTwice = ({ name, rungs }: Twice) =>
  rungs.length === 1
    ? t("graphic.twice.here", { name })
    : t("graphic.twice", { name, rungs: rungs.map((index) => index + 1).join(", ") });
