import { type PointerEvent, useEffect, useMemo, useState } from "react";
import { useShallow } from "zustand/react/shallow";
import { grouped } from "../../logic/format/numbers";
import { lanePath, lengthOf, lengthsOf, type Stretch, stretchAt, stretchesOf } from "../../logic/graphic/lanes";
import { spanText } from "../../logic/trace/plots";
import { openFile } from "../../store/page/navigate";
import { useBench } from "../../store/plc/bench";
import { usePlc } from "../../store/plc/plc";
import {
  isRecording,
  newTrace,
  recordEarlier,
  refreshTraces,
  type Shown,
  shownOf,
  useTraces,
} from "../../store/trace/traces";
import { t } from "../../text";
import { Empty } from "../../ui/Empty";
import { Icon } from "../../ui/Icon";
import { Segments } from "../../ui/Segments";
import "./steps.css";
import { type ShownChart, useLastSamples, useShownChart } from "./useSteps";

/** How many signals a trace can have. */
const MOST = 64;
const WINDOWS = ["1000", "3000", "10000"] as const;
const EARLIER = 10_000;
const WIDTH = 1000;
const HEIGHT = 10;

interface Lane {
  name: string;
  line: number;
  stretches: readonly Stretch[];
}

/** When each step of a chart was active, over the last scans: from a trace, so that no scan is left out. */
export function StepsPanel() {
  const bench = useBench((now) => now.instance?.id ?? null);
  const chart = useShownChart();
  const signals = useMemo(
    () =>
      chart?.instance === undefined ? [] : chart.steps.map(({ name }) => `${chart.instance}.${name}.X`).slice(0, MOST),
    [chart?.instance, chart?.steps],
  );
  const shown = useSource(signals);
  const [rows, setRows] = useState<(typeof WINDOWS)[number]>("1000");
  // biome-ignore lint/correctness/useExhaustiveDependencies: a different PLC has different traces
  useEffect(() => void refreshTraces(), [bench]);
  const [pointed, point] = useState("");
  if (!chart)
    return (
      <div className="pane flexcol steps" data-pane="steps">
        <Empty title={t("steps.empty.title")} about={t("steps.empty.about")} ways={[]} />
      </div>
    );
  return (
    <div className="pane flexcol steps" data-pane="steps" data-live>
      <div className="sub hbar" role="toolbar" aria-label={t("panel.steps")}>
        <span className="cut">
          <b>{chart.instance ?? chart.pou}</b>
        </span>
        <Bar shown={shown} signals={signals} chart={chart} />
        <span className="grow" />
        <span className="cut faint stpoint" role="status">
          {pointed}
        </span>
        <Windows shown={shown} rows={rows} onChoose={setRows} />
      </div>
      {chart.steps.length > MOST && (
        <p className="hint">{t("steps.more", { most: MOST, steps: chart.steps.length })}</p>
      )}
      {shown ? (
        <Lanes chart={chart} shown={shown} rows={Number(rows)} onPoint={point} />
      ) : (
        <Empty
          title={t("steps.none.title")}
          about={chart.instance === undefined ? t("steps.noinstance") : t("steps.none.about")}
          ways={[
            { icon: "record", strong: t("steps.begin"), rest: t("steps.begin.hint") },
            { icon: "past", strong: t("steps.earlier"), rest: t("steps.earlier.hint", { scans: grouped(EARLIER) }) },
          ]}
        />
      )}
    </div>
  );
}

/** The trace that records these signals, or else the latest record of them. */
function useSource(signals: readonly string[]): Shown | null {
  const { traces, records } = useTraces(useShallow(({ traces, records }) => ({ traces, records })));
  return useMemo(() => {
    if (signals.length === 0) return null;
    const has = (of: { signals: readonly { text: string }[] }) => {
      const texts = new Set(of.signals.map(({ text }) => text.toUpperCase()));
      return signals.every((signal) => texts.has(signal.toUpperCase()));
    };
    const all = traces.filter((trace) => has(trace));
    const trace = all.find(isRecording) ?? all.find(({ rows }) => rows > 0);
    const record = records.filter((each) => has(each)).sort((a, b) => b.id - a.id)[0];
    const source = trace
      ? { kind: "trace" as const, id: trace.id }
      : record && { kind: "record" as const, id: record.id };
    return source ? shownOf({ source, traces, records }) : null;
  }, [signals, traces, records]);
}

/** Begins a recording, forwards or of the scans that are over. */
function Bar({ shown, signals, chart }: { shown: Shown | null; signals: readonly string[]; chart: ShownChart }) {
  const [refused, setRefused] = useState("");
  const making = useTraces(({ retrospectives }) => retrospectives.length > 0);
  if (signals.length === 0) return null;
  const name = t("steps.trace", { instance: chart.instance ?? "" });
  const record = async () => {
    await newTrace(signals, name);
    setRefused(useTraces.getState().trouble?.message ?? "");
  };
  const earlier = () =>
    recordEarlier(signals, EARLIER, 1).then(
      () => setRefused(""),
      (error: unknown) => setRefused(error instanceof Error ? error.message : String(error)),
    );
  return (
    <>
      {shown && (
        <span className="faint cut">{shown.trace ? stateOf(shown) : t("steps.record", { name: shown.name })}</span>
      )}
      {!isRecording(shown?.trace ?? null) && (
        <button type="button" className="btn sm" title={t("steps.begin.hint")} onClick={() => void record()}>
          <Icon name="record" small />
          {t("steps.begin")}
        </button>
      )}
      <button
        type="button"
        className="btn quiet sm"
        disabled={making}
        title={t("steps.earlier.hint", { scans: grouped(EARLIER) })}
        onClick={() => void earlier()}
      >
        <Icon name="past" small />
        {t(making ? "steps.earlier.now" : "steps.earlier")}
      </button>
      {refused !== "" && (
        <span className="st fatal cut" role="alert">
          {refused}
        </span>
      )}
    </>
  );
}

const stateOf = ({ trace, name }: Shown) =>
  isRecording(trace) ? t("steps.recording", { name }) : t("steps.stopped", { name });

function Windows({
  shown,
  rows,
  onChoose,
}: {
  shown: Shown | null;
  rows: (typeof WINDOWS)[number];
  onChoose: (rows: (typeof WINDOWS)[number]) => void;
}) {
  const plc = usePlc(({ state }) => state?.interval_ns ?? 0);
  const interval = shown?.interval || plc;
  return (
    <Segments
      label={t("steps.window")}
      value={rows}
      options={WINDOWS.map((value) => ({
        value,
        word: spanText(Number(value) * interval * (shown?.every ?? 1)),
        title: t("steps.window.scans", { scans: grouped(Number(value)) }),
      }))}
      onChoose={onChoose}
    />
  );
}

interface LanesProps {
  chart: ShownChart;
  shown: Shown;
  rows: number;
  onPoint: (text: string) => void;
}

function Lanes({ chart, shown, rows, onPoint }: LanesProps) {
  const samples = useLastSamples(shown, rows);
  const lanes = useMemo(() => {
    const columns = new Map(shown.signals.map(({ text }, index) => [text.toUpperCase(), index]));
    return chart.steps.flatMap(({ name, line }): Lane[] => {
      const index = columns.get(`${chart.instance}.${name}.X`.toUpperCase());
      const column = index === undefined ? undefined : samples?.columns[index];
      return column && samples ? [{ name, line, stretches: stretchesOf(samples.scans, column, shown.every) }] : [];
    });
  }, [samples, shown.signals, shown.every, chart.steps, chart.instance]);
  const last = samples?.scans.at(-1) ?? 0;
  const first = Math.max(samples?.scans[0] ?? 0, last + 1 - rows * shown.every);
  // The end of a record is not now.
  const live = isRecording(shown.trace);
  const time = (scans: number | null) => (scans === null ? "–" : spanText(scans * shown.interval));
  if (lanes.length === 0) return <p className="hint stwait">{t("steps.waiting")}</p>;

  function onPointerMove({ clientX, currentTarget }: PointerEvent<SVGSVGElement>, { name, stretches }: Lane): void {
    const { left, width } = currentTarget.getBoundingClientRect();
    const found = stretchAt(stretches, first + ((clientX - left) / Math.max(1, width)) * (last + 1 - first));
    onPoint(found ? said(name, found, shown.interval) : "");
  }

  return (
    <div className="stbody">
      <table className="sttable" aria-label={t("steps.table")}>
        <thead>
          <tr>
            <th scope="col">{t("steps.step")}</th>
            <th scope="col" className="stlane">
              <Axis first={first} last={last} shown={shown} />
            </th>
            <th scope="col">{t("steps.times")}</th>
            <th scope="col">{t("steps.last")}</th>
            <th scope="col">{t("steps.least")}</th>
            <th scope="col">{t("steps.most")}</th>
          </tr>
        </thead>
        <tbody onPointerLeave={() => onPoint("")}>
          {lanes.map((lane) => {
            const { times, last: latest, least, most } = lengthsOf(lane.stretches);
            const active = live && lane.stretches.at(-1)?.to === last;
            return (
              <tr key={lane.name} className={active ? "on" : ""}>
                <th scope="row">
                  <button type="button" className="link plain cut" onClick={() => openFile(chart.path, lane.line, 1)}>
                    {lane.name}
                  </button>
                  {active && (
                    <span className="stnow" title={t("steps.active")} role="img" aria-label={t("steps.active")} />
                  )}
                </th>
                <td className="stlane">
                  <svg
                    viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
                    preserveAspectRatio="none"
                    aria-hidden="true"
                    onPointerMove={(event) => onPointerMove(event, lane)}
                  >
                    <rect className="ground" width={WIDTH} height={HEIGHT} />
                    <path className="bars" d={lanePath(lane.stretches, first, last, WIDTH, HEIGHT)} />
                    {active && (
                      <path className="bars now" d={lanePath(lane.stretches.slice(-1), first, last, WIDTH, HEIGHT)} />
                    )}
                  </svg>
                </td>
                <td>{grouped(times)}</td>
                <td>{time(latest)}</td>
                <td>{time(least)}</td>
                <td>{time(most)}</td>
              </tr>
            );
          })}
        </tbody>
      </table>
    </div>
  );
}

const said = (name: string, stretch: Stretch, interval: number) =>
  t(stretch.begins && stretch.ends ? "steps.point" : "steps.point.part", {
    name,
    span: spanText(lengthOf(stretch) * interval),
    from: grouped(stretch.from),
    to: grouped(stretch.to),
  });

/** The times of the lanes: before the last sample, or the scans of a record. */
function Axis({ first, last, shown }: { first: number; last: number; shown: Shown }) {
  const live = isRecording(shown.trace);
  const at = (share: number) => {
    const scan = Math.round(first + share * (last - first));
    if (!live) return grouped(scan);
    return share === 1 ? t("steps.now") : `−${spanText((last - scan) * shown.interval)}`;
  };
  return (
    <span className="staxis">
      {[0, 0.25, 0.5, 0.75, 1].map((share) => (
        <span key={share}>{at(share)}</span>
      ))}
    </span>
  );
}
