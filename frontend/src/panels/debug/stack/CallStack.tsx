import { grouped } from "../../../logic/format/numbers";
import { haltCause, haltPlace } from "../../../logic/plc/halted";
import { chooseFrame, type Frame, useStack } from "../../../store/debug/stack";
import { openFile } from "../../../store/page/navigate";
import { usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Tree, type TreeRow } from "../../../ui/Tree";
import type { HaltInfo } from "../../../wire/types";
import { Section } from "./Section";

/** The frames, the one with the next statement first; a click shows the place and the instance. */
export function CallStack({ halt }: { halt: HaltInfo }) {
  const { frames, frame } = useStack();
  const you = usePlc((plc) => plc.you?.name);
  const scan = usePlc((plc) => plc.state?.scan ?? 0);
  const meta = halt.past ? t("debug.scan", { scan: grouped(scan) }) : halt.task;
  const rows = frames.map((each, index) => ({
    ...frameRow(each, index, halt.past, each.id === frame),
    // By its depth, not by its id: the ids are new whenever the stack is read again, and the focus has to stay.
    key: String(frames.length - index),
  }));
  const cause = haltCause(halt);
  return (
    <Section id="stack" title={t("debug.stack")} meta={meta}>
      {cause !== "" && <p className="sectnote cause">{cause}</p>}
      {halt.by !== "" && halt.by !== you && <ByOther halt={halt} />}
      {rows.length > 0 ? (
        <Tree label={t("debug.stack")} rows={rows} />
      ) : (
        <p className="sectnote">{t("debug.stack.seam", { scan: grouped(scan) })}</p>
      )}
    </Section>
  );
}

/** Somebody else halted the PLC: the open text stays, and one click leads to the place of the halt. */
function ByOther({ halt }: { halt: HaltInfo }) {
  return (
    <p className="sectnote" title={halt.text}>
      {t("debug.by", { by: halt.by })}{" "}
      {halt.file !== "" && (
        <button type="button" className="link" onClick={() => openFile(halt.file, halt.line, halt.column)}>
          {t("debug.goto", { place: haltPlace(halt) })}
        </button>
      )}
    </p>
  );
}

function frameRow(frame: Frame, index: number, past: boolean, selected: boolean): Omit<TreeRow, "key"> {
  const { pou = frame.name, instance = "" } = frame.scanbench ?? {};
  const own = instance.slice(instance.lastIndexOf(".") + 1);
  return {
    level: 0,
    icon: index === 0 ? "here" : undefined,
    tone: past ? "pastc" : "haltc",
    label: (
      <>
        {pou} {own !== "" && own !== pou && <span className="faint">{own}</span>}
      </>
    ),
    name: `${frame.name}, ${frame.source?.name ?? ""}:${frame.line}`,
    meta: <span className="mono">{frame.line}</span>,
    selected,
    title: `${frame.name}\n${frame.source?.path ?? ""}:${frame.line}`,
    onActivate: () => {
      void chooseFrame(frame.id);
      if (frame.source?.path) openFile(frame.source.path, frame.line, frame.column);
    },
  };
}
