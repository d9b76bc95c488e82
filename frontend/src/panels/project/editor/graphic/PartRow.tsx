import { memo, type ReactNode, useEffect, useRef, useState } from "react";
import type { AllApart } from "../../../../logic/graphic/apart";
import { type Drop, dropsOf } from "../../../../logic/graphic/drops";
import type { PartFlow } from "../../../../logic/graphic/flow";
import type { Heading } from "../../../../logic/graphic/heading";
import type { Place } from "../../../../logic/graphic/ladderLayout";
import { type DrawnPart, spotsOf } from "../../../../logic/graphic/sheet";
import type { Twice } from "../../../../logic/graphic/writers";
import { loadNames, seenAs, useSeenAs } from "../../../../store/debug/seenAs";
import { isAway, useMembers } from "../../../../store/plc/members";
import { usePlc } from "../../../../store/plc/plc";
import { useForces } from "../../../../store/watch/forces";
import { t } from "../../../../text";
import { Icon, type IconName } from "../../../../ui/Icon";
import type { Pou, VerifyRow } from "../../../../wire/types";
import { ApartMark } from "./ApartMark";
import { ChartPicture } from "./ChartPicture";
import { DiagramPicture } from "./DiagramPicture";
import { clear } from "./follow";
import { followFlow } from "./followFlow";
import { showRung } from "./live";
import { showChart } from "./liveChart";
import { showDiagram } from "./liveDiagram";
import type { PartMarks } from "./marks";
import { type Note, Notes, notesOf } from "./Notes";
import { RungDrawing } from "./RungDrawing";
import { useApart } from "./useApart";
import { type Wrong, wrongText } from "./wrong";

interface Props {
  path: string;
  part: DrawnPart;
  number: number;
  head: Heading;
  /** How wide its heading can be. */
  room: number;
  /** How large its drawing is, 1 at most. */
  scale: number;
  /** The action of a chart that it is written in. */
  action: string | null;
  /** The POU whose instance gives the values; undefined where there are none to show. */
  pou: Pou | undefined;
  id: string;
  /** The place of the cursor; null where it is in a different part. */
  cursor: Place | null;
  /** Of the element that is being named. */
  field: ReactNode;
  marks: PartMarks;
  twice: readonly Twice[];
  /** The verification row that is selected. */
  verified: VerifyRow | null;
  /** Its elements that are chosen together; empty: all of it is. Null where nothing is. */
  chosen: readonly Place[] | null;
  /** Where what is dragged would come; null where nothing is dragged. */
  drop: Drop | "elsewhere" | null;
  /** What a drop means: an element by its place, `above` or `below` all of it; else empty. */
  target: string;
  /** What runs has not got it yet, or not as it is drawn. */
  unbuilt: boolean;
  /** What the compiler says about it. */
  wrong: readonly Wrong[];
}

/** One rung, network or chart: its number, label, title and comment, and its drawing; a text that cannot be read below the last drawing. */
export const PartRow = memo(function PartRow({
  path,
  part,
  number,
  head,
  room,
  scale,
  action,
  pou,
  id,
  cursor,
  field,
  marks,
  twice,
  verified,
  wrong,
  chosen,
  drop,
  target,
  unbuilt,
}: Props) {
  const { found, readable } = part;
  const { label, title, off } = found.head;
  const [said, setSaid] = useState("");
  const apart = useApart(part, path, pou, verified);
  const differing = apart.marks.filter(({ power }) => !power);
  const headline = part.kind === "chart" ? (pou?.name ?? "") : title;
  const lines = part.kind === "chart" ? [headline] : head.title;
  const differs = t("graphic.differences", { count: differing.length, scan: verified?.scan ?? 0 });
  const notes: Note[] = [
    ...(marks.halt ? [note("halted", marks.next === "" ? marks.halt.text : t("graphic.next"))] : []),
    ...(differing.length > 0 ? [note("bad", differs, "differs")] : []),
    ...(readable ? [] : [note("bad", t("graphic.unread"))]),
    ...notesOf(part, wrong, twice),
    ...(unbuilt ? [note("faint", t("graphic.unbuilt"))] : said === "" ? [] : [note("faint", said)]),
    ...(off ? [note("faint", t("graphic.off"))] : []),
  ];
  return (
    <div
      className={`net${cursor === null ? "" : " cur"}${off ? " off" : ""}${readable ? "" : " old"}${marks.halt ? ` ${marks.halt.look}` : ""}${chosen?.length === 0 ? " whole" : ""}${target === "above" || target === "below" ? ` drop${target}` : ""}`}
      role="group"
      aria-label={t(`graphic.${part.kind}`, { number, title: headline || label })}
    >
      <span className="g" title={t(marks.any ? `graphic.breakpoint.${part.kind}` : "debug.bp.hint")}>
        {marks.halt ? <Icon name={marks.any ? "here-bp" : "here"} small /> : marks.any && <Icon name="bp" small />}
      </span>
      <span className="no">{number}</span>
      <div className="netbody">
        <div className="hd" style={{ width: room }}>
          {action !== null && <span className="cm">{action}</span>}
          {label !== "" && <span className="lab">{label}:</span>}
          <b>
            {lines.map((line) => (
              <span key={line}>{line}</span>
            ))}
          </b>
          {head.beside && <span className="cm cut">{head.comment[0]}</span>}
          <Notes notes={notes} />
        </div>
        {!head.beside && (
          <div className="cm below">
            {head.comment.map((line, index) => (
              // biome-ignore lint/suspicious/noArrayIndexKey: a line is nothing but its place
              <span key={index}>{line}</span>
            ))}
          </div>
        )}
        <Picture
          path={path}
          part={part}
          scale={scale}
          pou={pou}
          id={id}
          cursor={cursor}
          field={field}
          marks={marks}
          onSaid={setSaid}
          apart={apart}
          wrong={wrongText(wrong)}
          chosen={chosen?.map((place) => place.join(".")).join(" ") ?? ""}
          drop={drop}
          target={target}
        />
        {!readable && <pre className="nettext">{found.text}</pre>}
      </div>
    </div>
  );
}, isSame);

/** Whether a row looks as before. A part that moved within its line, as one above it was edited, is drawn as it was. */
function isSame({ part: before, ...rest }: Props, { part, ...others }: Props): boolean {
  const [one, other] = [before.found, part.found];
  const moved = before.drawing === part.drawing && before.readable === part.readable;
  const text = one.text === other.text && one.line === other.line && one.head.off === other.head.off;
  if (!moved || !text) return false;
  return (Object.keys(rest) as (keyof typeof rest)[]).every((key) => Object.is(rest[key], others[key]));
}

function Picture({
  path,
  part,
  scale,
  pou,
  id,
  cursor,
  field,
  marks,
  onSaid,
  apart,
  wrong,
  chosen,
  drop,
  target,
}: Pick<Props, "path" | "part" | "scale" | "pou" | "id" | "cursor" | "field" | "marks"> & {
  apart: AllApart;
  onSaid: (said: string) => void;
  wrong: string;
  chosen: string;
  drop: Props["drop"];
  target: string;
}) {
  const picture = useRef<HTMLDivElement>(null);
  /** The elements that have something live. */
  const shapeShown = useRef("");
  const instance = useSeenAs((seen) => (pou === undefined ? undefined : seenAs(seen, pou.name)));
  const members = useMembers(({ of }) => of);
  const forces = useForces();
  const rung = part.kind === "rung" ? part.drawing : null;
  const chart = part.kind === "chart" ? part.drawing : null;
  const diagram = part.kind === "network" ? part.drawing : null;
  const live = part.readable && !part.found.head.off;

  const away = usePlc(() => isAway());
  // A program that comes takes what the names of the one before meant with it, also while nobody can be asked.
  // biome-ignore lint/correctness/useExhaustiveDependencies: asked again when what was known is gone
  useEffect(() => {
    if (pou !== undefined && !away) void loadNames(pou.name);
  }, [pou, instance, members, away]);
  // biome-ignore lint/correctness/useExhaustiveDependencies: what a name means depends on the instance and its variables, and forces are drawn
  useEffect(() => {
    const svg = picture.current?.querySelector("svg");
    if (!svg) return;
    const shape = spotsOf(part)
      .map(({ place, element }) => `${place.join(".")} ${element.kind}`)
      .join();
    // Of the same elements each is shown again at once, and most have what they had: to take it away first would style all of them twice.
    if (pou === undefined || !live || shape !== shapeShown.current) clear(svg);
    shapeShown.current = shape;
    onSaid("");
    if (pou === undefined || !live) return;
    const shown =
      (rung && showRung(svg, rung, pou)) ||
      (diagram && showDiagram(svg, diagram, pou)) ||
      (chart && showChart(svg, chart, pou));
    const stop = followFlow(part, path, pou, (flow) => {
      shown?.onFlow(flow);
      onSaid(wordsOf(flow));
    });
    return () => {
      stop();
      shown?.stop();
    };
  }, [rung, diagram, chart, pou, live, instance, members, forces]);

  const marked = {
    id,
    cursor: cursor?.join(".") ?? null,
    next: marks.next,
    points: marks.points,
    wrong,
    chosen,
    apart: apart.wires,
    target,
  };
  return (
    <div ref={picture} className="netdraw">
      <div style={{ zoom: scale }}>
        {rung && <RungDrawing drawing={rung} {...marked} />}
        {diagram && <DiagramPicture drawing={diagram} {...marked} />}
        {chart && <ChartPicture drawing={chart} {...marked} />}
      </div>
      {drop && rung && part.readable && (
        <svg className="drops" width={rung.width * scale} height={rung.height * scale} role="presentation">
          {dropsOf(rung).map(({ place, x, y }) => (
            <circle
              key={`${place.join(".")} ${x}`}
              className={drop !== "elsewhere" && drop.x === x && drop.y === y ? "over" : ""}
              cx={x * scale}
              cy={y * scale}
              r={4}
            />
          ))}
        </svg>
      )}
      {field}
      {apart.marks.map((mark) => (
        <ApartMark key={`${mark.key} ${mark.x} ${mark.y}`} mark={mark} scale={scale} />
      ))}
    </div>
  );
}

/** What is to be said of a part whose elements did not all run, or that was called several times. */
function wordsOf(flow: PartFlow | null): string {
  if (!flow) return "";
  const { state, call, calls } = flow;
  if (state === "uncalled") return t("graphic.flow.uncalled");
  if (state === "skipped") return t("graphic.flow.skipped");
  const which = calls > 1 ? t("graphic.flow.call", { call, calls }) : "";
  return [which, state === "last" ? t("graphic.flow.last") : ""].filter(Boolean).join(", ");
}

const note = (look: Note["look"], text: string, icon?: IconName): Note => ({ look, text, ...(icon ? { icon } : {}) });
