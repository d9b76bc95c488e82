import { type RefObject, useCallback, useEffect, useLayoutEffect, useMemo, useRef, useState } from "react";
import { inNames } from "../../../logic/errors/catalogue";
import { grouped, wallTime } from "../../../logic/format/numbers";
import { useCatalogue } from "../../../store/errors/catalogue";
import { useWidths } from "../../../store/page/columns";
import { usePlc } from "../../../store/plc/plc";
import { goLive, LOG_PAGE, turnTo, useWholeLog } from "../../../store/plc/wholelog";
import { t } from "../../../text";
import { Icon, type IconName } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import { MenuButton } from "../../../ui/Menu";
import { roomFor, useColumns } from "../../../ui/useColumns";
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
  const page = useWholeLog((whole) => whole.page);
  const [kind, setKind] = useState<Filter>("all");
  const live = useMemo(() => (kind === "all" ? log : log.filter((line) => line.kind === kind)), [log, kind]);
  const shown = page?.lines ?? live;

  function choose(next: Filter): void {
    setKind(next);
    if (page) void turnTo(null, kindOf(next));
  }
  return (
    <div className="pane flexcol" data-pane="log">
      {log.length === 0 && !page ? (
        <p className="lonely faint">{t("log.none")}</p>
      ) : (
        <>
          <div className="sub">
            <Pages kind={kindOf(kind)} />
            <span className="grow" />
            <KindMenu kind={kind} onKind={choose} />
          </div>
          {shown.length === 0 ? (
            <p className="lonely faint">{t("log.nomatch")}</p>
          ) : (
            <Lines key={`${kind} ${page?.first ?? "live"}`} log={shown} />
          )}
        </>
      )}
    </div>
  );
}

const kindOf = (kind: Filter): LogLine["kind"] | null => (kind === "all" ? null : kind);

/** From the live lines to the whole log, and from page to page in it. */
function Pages({ kind }: { kind: LogLine["kind"] | null }) {
  const { page, busy, trouble } = useWholeLog();
  const said = trouble && <span className="hint bad">{trouble}</span>;
  if (!page)
    return (
      <>
        <button
          type="button"
          className="link"
          title={t("log.whole.hint")}
          disabled={busy}
          onClick={() => void turnTo(null, kind)}
        >
          {t("log.whole")}
        </button>
        {said}
      </>
    );
  const { first, total, kept, lines } = page;
  const range = { first: grouped(first + 1), last: grouped(first + lines.length), total: grouped(total) };
  return (
    <>
      <IconButton
        icon="chev-u"
        label={t("log.earlier")}
        small
        disabled={busy || first === 0}
        onClick={() => void turnTo(Math.max(0, first - LOG_PAGE), kind)}
      />
      <IconButton
        icon="chev-d"
        label={t("log.later")}
        small
        disabled={busy || first + lines.length >= total}
        onClick={() => void turnTo(first + LOG_PAGE, kind)}
      />
      <span className="muted" role="status" title={t("log.kept", { count: grouped(kept) })}>
        {total === 0 ? t("log.page.none") : t("log.page", range)}
      </span>
      <button type="button" className="link" onClick={goLive}>
        {t("log.live")}
      </button>
      {said}
    </>
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
  const by = useMemo(() => roomFor(log.map(({ author }) => author)), [log]);
  return (
    <div
      ref={grid.scroll}
      className="grid scroll loglines"
      role="table"
      aria-label={t("log.label")}
      aria-rowcount={log.length + 1}
      // biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard
      tabIndex={0}
      style={{ ...style, ["--by" as string]: by }}
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
  const instances = usePlc((plc) => plc.instances);
  const named = line.kind === "error" || line.kind === "recover";
  const text = named ? inNames(errors, line.text, instances) : line.text;
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
      <span role="cell" className="muted cut" title={line.author}>
        {line.author}
      </span>
    </div>
  );
}
