/** The chart whose steps are shown, and the samples of them. */

import { useEffect, useMemo, useRef, useState } from "react";
import { chartsOf } from "../../logic/graphic/lanes";
import { pouAt } from "../../logic/plc/sourceLines";
import { appended, decode, type Samples } from "../../logic/trace/samples";
import { loadNames, seenAs, useSeenAs } from "../../store/debug/seenAs";
import { useDocuments } from "../../store/project/documents";
import { readSamples, type Shown } from "../../store/trace/traces";
import { useLookedAt } from "../../ui/inSight";

export interface ShownChart {
  path: string;
  pou: string;
  /** The instance whose steps are shown; undefined while there is none. */
  instance: string | undefined;
  steps: readonly { name: string; line: number }[];
}

/** The chart of the file that is edited; where that has none, the one that was shown last. */
export function useShownChart(): ShownChart | null {
  const path = useDocuments(({ active }) => active);
  const edited = useDocuments(({ open }) => (path === null ? undefined : open[path]?.text));
  const line = useDocuments(({ cursor }) => cursor?.line ?? 1);
  const known = useDocuments(({ pous }) => pous);
  const last = useRef<Omit<ShownChart, "instance"> | null>(null);
  const charts = useMemo(() => (edited === undefined ? [] : chartsOf(edited)), [edited]);
  const at = Math.max(
    0,
    charts.findLastIndex(({ found }) => found.line <= line),
  );
  const here = useMemo(() => {
    const chart = charts[at];
    const pou = chart && path !== null && pouAt(known, path, chart.found.line, edited);
    if (!chart || !pou) return null;
    const lineOf = (offset: number) => chart.found.line + chart.found.text.slice(0, offset).split("\n").length - 1;
    return { path: pou.file, pou: pou.name, steps: chart.steps.map(({ name, at }) => ({ name, line: lineOf(at) })) };
  }, [charts, at, path, known, edited]);
  if (here) last.current = here;
  const shown = here ?? last.current;
  const instance = useSeenAs((seen) => (shown ? seenAs(seen, shown.pou) : undefined));
  useEffect(() => {
    if (shown) void loadNames(shown.pou);
  }, [shown]);
  return shown && { ...shown, instance };
}

const PERIOD = 250;

/** The last samples of a trace or record, at most so many, fetched as it grows. */
export function useLastSamples(shown: Shown | null, rows: number): Samples | null {
  const [held, setHeld] = useState<{ key: string; samples: Samples } | null>(null);
  const about = useRef(shown);
  about.current = shown;
  const key = shown ? `${shown.source.kind} ${shown.source.id} ${shown.generation} ${rows}` : "";
  const lookedAt = useLookedAt();

  useEffect(() => {
    let stopped = false;
    let timer: ReturnType<typeof setTimeout>;
    let samples: Samples | null = null;
    const turn = async () => {
      if (about.current && lookedAt()) {
        const next: Samples | null = await fetched(about.current, samples, rows);
        if (stopped) return;
        if (next !== samples) {
          samples = next;
          setHeld(next && { key, samples: next });
        }
      }
      if (!stopped) timer = setTimeout(() => void turn(), PERIOD);
    };
    void turn();
    return () => {
      stopped = true;
      clearTimeout(timer);
    };
  }, [key, rows, lookedAt]);

  return held?.key === key ? held.samples : null;
}

/** The samples with those that came since; the same object where nothing came, null where they begin again. */
async function fetched(shown: Shown, held: Samples | null, rows: number): Promise<Samples | null> {
  const end = Math.max(shown.end, held?.end ?? 0);
  const first = Math.max(shown.first, end - rows * shown.every);
  const next = held ? (held.scans.at(-1) ?? first - 1) + 1 : first;
  const goesOn = held !== null && next >= first;
  const data = await readSamples(shown.source, goesOn ? next : first, null, null);
  if (!data) return null;
  const more = decode(data, shown.signals);
  if (held && goesOn && more.generation !== held.generation) return null;
  if (held && goesOn && more.scans.length === 0) return held;
  return held && goesOn ? appended(held, more, rows) : more;
}
