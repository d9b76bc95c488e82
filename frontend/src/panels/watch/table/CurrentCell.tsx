import { useEffect, useRef } from "react";
import type { Format } from "../../../logic/format/formats";
import { useMembers } from "../../../store/plc/members";
import { useShownProgram } from "../../../store/project/shownProgram";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { PlcSymbol, Refusal } from "../../../wire/types";
import { showLive } from "../live";

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

function LiveCell({ path, from, known, format }: { path: string; from: string; known: boolean; format: Format }) {
  const cell = useRef<HTMLSpanElement>(null);
  const lamp = useRef<HTMLSpanElement>(null);
  const text = useRef<HTMLSpanElement>(null);

  // biome-ignore lint/correctness/useExhaustiveDependencies: reads the cell again when the symbol arrives
  useEffect(() => {
    if (!cell.current || !text.current || !lamp.current) return;
    return showLive(from, format, { cell: cell.current, text: text.current, lamp: lamp.current });
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
