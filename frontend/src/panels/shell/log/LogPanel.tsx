import { type RefObject, useCallback, useEffect, useLayoutEffect, useMemo, useRef, useState } from "react";
import { inNames } from "../../../logic/errors/catalogue";
import { grouped, wallTime } from "../../../logic/format/numbers";
import { useCatalogue } from "../../../store/errors/catalogue";
import { useWidths } from "../../../store/page/columns";
import { usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon, type IconName } from "../../../ui/Icon";
import { MenuButton } from "../../../ui/Menu";
import { useColumns } from "../../../ui/useColumns";
import { useGrid } from "../../../ui/useGrid";
import type { ErrorInfo, LogLine } from "../../../wire/types";

const LOOK: Record<LogLine["kind"], { icon: IconName; tone: string }> = {
  write: { icon: "check", tone: "info" },
  force: { icon: "forced", tone: "forced" },
  error: { icon: "generated", tone: "generated" },
  recover: { icon: "cleared", tone: "cleared" },
  mode: { icon: "swap", tone: "stopped" },
  run: { icon: "running", tone: "stopped" },
  build: { icon: "init", tone: "stopped" },
  system: { icon: "info", tone: "warning" },
  halt: { icon: "halted", tone: "halted" },
  disturbance: { icon: "disturbance", tone: "warning" },
};

/** Every command for this PLC, with its author and the scan before which it was applied; the newest at the end. */
export function LogPanel() {
  const log = usePlc((plc) => plc.log);
  const [kind, setKind] = useState<Filter>("all");
  const shown = useMemo(() => (kind === "all" ? log : log.filter((line) => line.kind === kind)), [log, kind]);
  return (
    <div className="pane flexcol" data-pane="log">
      {log.length === 0 ? (
        <p className="lonely faint">{t("log.none")}</p>
      ) : (
        <>
          <div className="sub">
            <span className="grow" />
            <KindMenu kind={kind} onKind={setKind} />
          </div>
          {shown.length === 0 ? <p className="lonely faint">{t("log.nomatch")}</p> : <Lines key={kind} log={shown} />}
        </>
      )}
    </div>
  );
}

type Filter = LogLine["kind"] | "all";
const FILTERS = ["all", ...(Object.keys(LOOK) as LogLine["kind"][])] as const;

function KindMenu({ kind, onKind }: { kind: Filter; onKind: (kind: Filter) => void }) {
  return (
    <MenuButton
      label={t("log.filter", { kind: t(`log.kind.${kind}`) })}
      items={() =>
        FILTERS.map((value) => ({
          label: t(`log.kind.${value}`),
          checked: value === kind,
          onSelect: () => onKind(value),
        }))
      }
    >
      {t(`log.kind.${kind}`)}
      <Icon name="chev-d" small />
    </MenuButton>
  );
}

function Lines({ log }: { log: readonly LogLine[] }) {
  const { errors } = useCatalogue();
  const grid = useGrid({ count: log.length });
  const onScroll = useFollow(grid.scroll, log);
  const { style, head } = useColumns(useWidths("log"));
  return (
    <div
      ref={grid.scroll}
      className="grid scroll loglines"
      role="table"
      aria-label={t("log.label")}
      aria-rowcount={log.length + 1}
      // biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard
      tabIndex={0}
      style={style}
      onScroll={onScroll}
    >
      <div className="gr h" role="row">
        {head("at", t("log.at"))}
        {head("scan", t("log.scan"), "num")}
        {head("kind", t("log.kind"))}
        {head("text", t("log.text"))}
        <span role="columnheader">{t("log.by")}</span>
      </div>
      <div {...grid.body}>
        {grid.items.map((item) => {
          const line = log[item.index];
          return (
            line && <Line key={item.key} line={line} errors={errors} start={grid.topOf(item)} index={item.index} />
          );
        })}
      </div>
    </div>
  );
}

/** Keeps the end of a growing list visible, also when its panel is shown or resized, until somebody scrolls up. */
function useFollow(scroll: RefObject<HTMLDivElement | null>, log: readonly LogLine[]): () => void {
  const following = useRef(true);
  const height = useRef(0);
  const toEnd = useCallback(() => {
    const element = scroll.current;
    if (!element || !following.current) return;
    element.scrollTop = element.scrollHeight;
  }, [scroll]);
  // biome-ignore lint/correctness/useExhaustiveDependencies: runs when a line is added
  useLayoutEffect(toEnd, [toEnd, log]);
  useEffect(() => {
    if (!scroll.current) return;
    const sized = new ResizeObserver(toEnd);
    sized.observe(scroll.current);
    return () => sized.disconnect();
  }, [scroll, toEnd]);

  return () => {
    const element = scroll.current;
    if (!element) return;
    const { scrollTop, scrollHeight, clientHeight } = element;
    // Showing or resizing the panel also causes a scroll event, which is not from the user.
    const byHand = clientHeight === height.current;
    const atEnd = scrollTop + clientHeight > scrollHeight - 30;
    if (atEnd || byHand) following.current = atEnd;
    height.current = clientHeight;
  };
}

interface LineProps {
  line: LogLine;
  errors: readonly ErrorInfo[];
  start: number;
  index: number;
}

function Line({ line, errors, start, index }: LineProps) {
  const text = line.kind === "error" || line.kind === "recover" ? inNames(errors, line.text) : line.text;
  const { icon, tone } = LOOK[line.kind];
  return (
    <div className="gr" role="row" aria-rowindex={index + 2} style={{ transform: `translateY(${start}px)` }}>
      <span role="cell" className="mono muted" title={line.at}>
        {wallTime(line.at)}
      </span>
      <span role="cell" className="num muted">
        {grouped(line.scan)}
      </span>
      <span role="cell" className={`st ${tone}`}>
        <Icon name={icon} small />
        {t(`log.kind.${line.kind}`)}
      </span>
      <span role="cell" className="cut" title={text}>
        {text}
      </span>
      <span role="cell" className="muted cut">
        {line.author}
      </span>
    </div>
  );
}
