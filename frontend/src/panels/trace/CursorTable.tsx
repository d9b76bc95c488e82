import { useEffect, useState } from "react";
import { grouped, plcTime } from "../../logic/format/numbers";
import { axisText, layoutOf, spanText, unitOf } from "../../logic/trace/plots";
import { decode, rowAt, type Samples, textAt } from "../../logic/trace/samples";
import { useWidths } from "../../store/page/columns";
import { moveTo, readSamples, removeSignal, type Shown, setCursor, useTraces } from "../../store/trace/traces";
import { t } from "../../text";
import { Icon } from "../../ui/Icon";
import { IconButton } from "../../ui/IconButton";
import { Menu } from "../../ui/Menu";
import { useColumns } from "../../ui/useColumns";
import type { TraceSignal } from "../../wire/types";
import { AddSignal } from "./AddSignal";

interface Props {
  shown: Shown;
  samples: Samples | null;
}

/** Values at the cursors: the content of the plots as text. Without a cursor, the newest values. */
export function CursorTable({ shown, samples }: Props) {
  const a = useTraces((traces) => traces.a);
  const b = useTraces((traces) => traces.b);
  const moved = useTraces((traces) => traces.moved);
  const { style, grip, head } = useColumns(useWidths("cursors"));
  const newest = samples?.scans.at(-1) ?? null;
  const atA = useRow(shown, samples, a ?? newest);
  const atB = useRow(shown, samples, b);
  const [menu, setMenu] = useState<{ signal: TraceSignal; x: number; y: number } | null>(null);
  const { plots, lanes } = layoutOf(shown.signals, moved);
  const lines = [...plots.flatMap((plot) => plot.lines), ...lanes];
  const time = (scan: number | null) => (scan === null ? "" : plcTime(scan * shown.interval).replace(/^00:/, ""));
  return (
    <>
      <div
        className={`grid trtable${b === null ? " one" : ""}`}
        role="grid"
        aria-label={t("trace.table")}
        style={style}
      >
        <div className="gr h" role="row">
          {head("signal", t("trace.signal"))}
          <span role="columnheader" className="num">
            {a === null ? t("trace.newest") : <Head name="A" onDrop={() => setCursor("a", null)} />}
            {grip("a", "A")}
          </span>
          <span role="columnheader" className="num">
            {b === null ? (
              <button
                type="button"
                className="link"
                disabled={newest === null}
                onClick={() => setCursor(a === null ? "a" : "b", newest)}
              >
                {t("trace.cursor.set", { name: a === null ? "A" : "B" })}
              </button>
            ) : (
              <Head name="B" onDrop={() => setCursor("b", null)} />
            )}
            {grip("b", "B")}
          </span>
          <span role="columnheader" className="num">
            B − A
          </span>
        </div>
        <Facts
          name={t("read.scan")}
          a={scanText(a ?? newest)}
          b={scanText(b)}
          d={a !== null && b !== null ? grouped(b - a) : ""}
        />
        <Facts
          name={t("trace.time")}
          a={time(a ?? newest)}
          b={time(b)}
          d={a !== null && b !== null ? spanText((b - a) * shown.interval) : ""}
        />
        {lines.map(({ index, signal, color, dash }) => (
          <div
            key={signal.text}
            className="gr"
            role="row"
            tabIndex={-1}
            data-signal={signal.text}
            draggable
            onDragStart={(event) => event.dataTransfer.setData("application/x-trace-signal", signal.text)}
            onContextMenu={(event) => {
              event.preventDefault();
              setMenu({ signal, x: event.clientX, y: event.clientY });
            }}
          >
            <span role="gridcell" className="row tight" title={signal.message || `${signal.text}: ${signal.type}`}>
              <Swatch color={color} dash={dash} bool={(signal.kind || "bool") === "bool"} />
              <span className="mono cut front">
                <bdi>{signal.text}</bdi>
              </span>
              {signal.message && <Icon name="warning" small />}
              {shown.trace && (
                <IconButton
                  icon="x"
                  small
                  className="rowx"
                  label={t("trace.remove", { signal: signal.text })}
                  onClick={() => removeSignal(signal.text)}
                />
              )}
            </span>
            <Value at={atA} index={index} signal={signal} />
            <Value at={atB} index={index} signal={signal} />
            <span role="gridcell" className="num muted">
              {a === null || b === null ? "" : difference(atA, atB, index, signal)}
            </span>
          </div>
        ))}
      </div>
      {shown.trace && <AddSignal />}
      {menu && (
        <Menu
          label={menu.signal.text}
          at={menu}
          onClose={() => setMenu(null)}
          items={[
            ...(menu.signal.kind === "bool"
              ? []
              : [
                  { label: t("trace.ownplot"), onSelect: () => moveTo(menu.signal.text, `= ${menu.signal.text}`) },
                  ...plots
                    .filter((plot) => plot.unit === unitOf(menu.signal))
                    .filter((plot) => !plot.lines.some(({ signal }) => signal.text === menu.signal.text))
                    .map((plot) => ({
                      label: t("trace.toplot", { plot: plot.title }),
                      onSelect: () => moveTo(menu.signal.text, plot.key),
                    })),
                ]),
            {
              label: t("trace.remove", { signal: menu.signal.text }),
              icon: "trash" as const,
              disabled: !shown.trace,
              onSelect: () => removeSignal(menu.signal.text),
            },
          ]}
        />
      )}
    </>
  );
}

const scanText = (scan: number | null) => (scan === null ? "" : grouped(scan));

function Head({ name, onDrop }: { name: string; onDrop: () => void }) {
  return (
    <button type="button" className="cur-l" title={t("trace.cursor.drop", { name })} onClick={onDrop}>
      {name}
    </button>
  );
}

function Facts({ name, a, b, d }: { name: string; a: string; b: string; d: string }) {
  return (
    <div className="gr sep" role="row">
      <span role="gridcell" className="muted">
        {name}
      </span>
      {[a, b, d].map((text, at) => (
        // biome-ignore lint/suspicious/noArrayIndexKey: three cells that never change places
        <span key={at} role="gridcell" className="num">
          {text}
        </span>
      ))}
    </div>
  );
}

function Swatch({ color, dash, bool }: { color: number; dash: readonly number[]; bool: boolean }) {
  return (
    <svg className={`trswatch s${color}`} viewBox="0 0 18 10" aria-hidden="true">
      {bool ? <path d="M1 8.5h5v-7h6v7h5" /> : <path d="M0 5h18" strokeDasharray={dash.join(" ")} />}
    </svg>
  );
}

interface At {
  samples: Samples;
  row: number;
}

function Value({ at, index, signal }: { at: At | null; index: number; signal: TraceSignal }) {
  const text = at ? textAt(at.samples, at.row, index, signal) : "";
  const lamp = signal.kind === "bool" && text !== "";
  return (
    <span role="gridcell" className="num mono cut" title={text}>
      {lamp ? (
        <span className="lampv">
          <span className={`lamp${text === "TRUE" ? " on" : ""}`} />
          {text}
        </span>
      ) : (
        text || (at ? "–" : "")
      )}
    </span>
  );
}

function difference(a: At | null, b: At | null, index: number, signal: TraceSignal): string {
  const one = a?.samples.columns[index]?.[a.row];
  const other = b?.samples.columns[index]?.[b.row];
  if (one === undefined || other === undefined || Number.isNaN(one) || Number.isNaN(other)) return "–";
  if (signal.kind === "bool") return one === other ? "–" : t(other > one ? "trace.rose" : "trace.fell");
  if (signal.kind === "time" || signal.kind === "date") return spanText(other - one);
  return axisText(other - one).replace("-", "−");
}

/** The samples of a scan: from the held ones if they are exact, else fetched. */
function useRow(shown: Shown, samples: Samples | null, scan: number | null): At | null {
  const [asked, setAsked] = useState<{ key: string; samples: Samples } | null>(null);
  const row = samples && scan !== null ? rowAt(samples, scan) : -1;
  const inside = samples !== null && row >= 0 && scan !== null && scan <= (samples.scans.at(-1) ?? 0) + shown.every;
  const exact = inside && !samples.decimated;
  const key = scan === null || exact ? "" : `${shown.source.kind} ${shown.source.id} ${shown.generation} ${scan}`;
  useEffect(() => {
    if (key === "" || scan === null) return;
    let stopped = false;
    void readSamples(shown.source, scan - shown.every + 1, scan, null).then((data) => {
      if (data && !stopped) setAsked({ key, samples: decode(data, shown.signals) });
    });
    return () => {
      stopped = true;
    };
  }, [key, scan, shown.source, shown.every, shown.signals]);
  if (exact && samples) return { samples, row };
  return asked && asked.key === key && asked.samples.scans.length > 0
    ? { samples: asked.samples, row: asked.samples.scans.length - 1 }
    : null;
}
