import { useVirtualizer } from "@tanstack/react-virtual";
import { useEffect, useMemo, useRef } from "react";
import { allErrors, inNames } from "../../logic/catalogue";
import { grouped, wallTime } from "../../logic/numbers";
import { t } from "../../logic/text";
import { useBench } from "../../store/bench";
import { usePlc } from "../../store/plc";
import { Icon, type IconName } from "../../ui/Icon";
import type { ErrorInfo, LogLine } from "../../wire/types";

const LOOK: Record<LogLine["kind"], { icon: IconName; tone: string }> = {
  write: { icon: "check", tone: "info" },
  force: { icon: "forced", tone: "forced" },
  error: { icon: "generated", tone: "generated" },
  recover: { icon: "cleared", tone: "cleared" },
  mode: { icon: "swap", tone: "stopped" },
  run: { icon: "running", tone: "stopped" },
  build: { icon: "init", tone: "stopped" },
  system: { icon: "info", tone: "warning" },
};

/** Everything that was done to this PLC, by whom and before which scan; the newest at the end. */
export function LogPanel() {
  const log = usePlc((plc) => plc.log);
  const model = useBench((bench) => bench.model);
  const errors = useMemo(() => allErrors(model?.catalogue ?? []), [model]);
  const scroll = useRef<HTMLDivElement>(null);
  const atEnd = useRef(true);
  const virtual = useVirtualizer({
    count: log.length,
    getScrollElement: () => scroll.current,
    estimateSize: () => 24,
    overscan: 10,
    scrollMargin: 24,
    scrollPaddingStart: 24,
  });
  useEffect(() => {
    if (atEnd.current && log.length > 0) virtual.scrollToIndex(log.length - 1);
  }, [log, virtual]);

  if (log.length === 0) {
    return (
      <div className="pane flexcol" data-pane="log">
        <p className="lonely faint">{t("log.none")}</p>
      </div>
    );
  }
  return (
    <div className="pane flexcol" data-pane="log">
      <div
        ref={scroll}
        className="grid scroll loglines"
        role="table"
        aria-label={t("log.label")}
        aria-rowcount={log.length + 1}
        // biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard
        tabIndex={0}
        onScroll={(event) => {
          const { scrollTop, scrollHeight, clientHeight } = event.currentTarget;
          atEnd.current = scrollTop + clientHeight > scrollHeight - 30;
        }}
      >
        <div className="gr h" role="row">
          <span role="columnheader">{t("log.at")}</span>
          <span role="columnheader" className="num">
            {t("log.scan")}
          </span>
          <span role="columnheader">{t("log.kind")}</span>
          <span role="columnheader">{t("log.text")}</span>
          <span role="columnheader">{t("log.by")}</span>
        </div>
        <div className="virtual" role="rowgroup" style={{ height: virtual.getTotalSize() }}>
          {virtual.getVirtualItems().map((item) => {
            const line = log[item.index];
            return (
              line && <Line key={item.key} line={line} errors={errors} start={item.start - 24} index={item.index} />
            );
          })}
        </div>
      </div>
    </div>
  );
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
