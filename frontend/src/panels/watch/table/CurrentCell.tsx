import { useEffect, useRef } from "react";
import type { Format } from "../../../logic/format/formats";
import { useMembers } from "../../../store/plc/members";
import { bindCell } from "../../../store/plc/values";
import { useShownProgram } from "../../../store/project/shownProgram";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { PlcSymbol, Refusal } from "../../../wire/types";

interface Props {
  path: string;
  /** The path whose value is shown: for an in-out with a chosen call, a different variable. */
  from: string;
  symbol: PlcSymbol | null;
  refusal: Refusal | null;
  format: Format;
}

/** The live value. Value frames write into this cell directly; React only places it. */
export function CurrentCell({ path, from, symbol, refusal, format }: Props) {
  const version = useShownProgram((shown) => shown.version);
  if (refusal) {
    return (
      <span className="val sum bad" role="gridcell" title={refusal.message}>
        {version === null ? t("watch.notfound") : t("watch.notinversion", { version })}
      </span>
    );
  }
  if (symbol?.expandable) return <MemberCount path={path} />;
  return <LiveCell path={path} from={from} known={symbol !== null} format={format} />;
}

function MemberCount({ path }: { path: string }) {
  const count = useMembers((members) => members.of.get(path)?.length);
  return (
    <span className="val sum" role="gridcell">
      {count === undefined ? "" : t("watch.members", { count })}
    </span>
  );
}

const FADE_AFTER = 120;
const MARK_FOR = 1000;

function LiveCell({ path, from, known, format }: { path: string; from: string; known: boolean; format: Format }) {
  const cell = useRef<HTMLSpanElement>(null);
  const lamp = useRef<HTMLSpanElement>(null);
  const text = useRef<HTMLSpanElement>(null);

  // biome-ignore lint/correctness/useExhaustiveDependencies: reads the cell again when the symbol arrives
  useEffect(() => {
    let fade: ReturnType<typeof setTimeout> | undefined;
    let unmark: ReturnType<typeof setTimeout> | undefined;
    const unbind = bindCell(from, format, (reading) => {
      if (text.current) text.current.textContent = reading.text;
      lamp.current?.classList.toggle("on", reading.lamp === true);
      lamp.current?.toggleAttribute("hidden", reading.lamp === null);
      text.current?.classList.toggle("bw", reading.lamp !== null);
      if (!reading.changed) return;
      cell.current?.classList.add("flash", "changed");
      clearTimeout(fade);
      clearTimeout(unmark);
      fade = setTimeout(() => cell.current?.classList.remove("flash"), FADE_AFTER);
      unmark = setTimeout(() => cell.current?.classList.remove("changed"), MARK_FOR);
    });
    return () => {
      unbind();
      clearTimeout(fade);
      clearTimeout(unmark);
    };
  }, [from, format, known]);

  return (
    <span
      ref={cell}
      className="val"
      role="gridcell"
      aria-label={t("watch.current.of", { path })}
      data-testid={`current:${path}`}
      onMouseEnter={({ currentTarget }) => {
        currentTarget.title = text.current?.textContent ?? ""; // a long value is cut off
      }}
    >
      <Icon name="changed" />
      <span ref={lamp} className="lamp" hidden />
      <span ref={text} className="txt" />
    </span>
  );
}
