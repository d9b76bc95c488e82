import { useEffect, useRef, useState } from "react";
import { appended, decode, type Samples } from "../../logic/trace/samples";
import { isRecording, readSamples, type Shown, shownOf, useTraces, viewOf, wholeOf } from "../../store/trace/traces";
import { useLookedAt } from "../../ui/inSight";

const PERIOD = 100;
const WHOLE_PERIOD = 1000;
/** Up to this many rows a browser holds all samples; of more rows it holds the least and greatest value of stretches. */
const FULL = 24_000;
const POINTS = 4_000;
const OVERVIEW = 1_200;

const keyOf = (shown: Shown) => `${shown.source.kind} ${shown.source.id} ${shown.generation} ${shown.signals.length}`;

interface Held {
  key: string;
  samples: Samples;
  /** The range of scans whose samples are all held. */
  from: number;
  to: number;
}

/** Whether the held samples cover the view finely enough: all samples, or decimated ones of at most four times the visible range. */
function enough({ samples, from, to }: Held, wanted: { from: number; to: number }, grown: boolean): boolean {
  if (grown || wanted.from < from || wanted.to > to) return false;
  return !samples.decimated || to - from <= 4 * (wanted.to - wanted.from);
}

/** The samples of the view, fetched as the view moves and the record grows; and the overview of the whole record. */
export function useSamples(shown: Shown | null): { samples: Samples | null; whole: Samples | null } {
  const [held, setHeld] = useState<Held | null>(null);
  const [outline, setOutline] = useState<{ key: string; samples: Samples } | null>(null);
  const now = useRef<Held | null>(null);
  const key = shown ? keyOf(shown) : "";
  const lookedAt = useLookedAt();

  useEffect(() => {
    let stopped = false;
    let timer: ReturnType<typeof setTimeout>;
    const turn = async () => {
      if (lookedAt()) {
        const next = await fetched(key, now.current);
        if (!stopped && next && next !== now.current) {
          now.current = next;
          setHeld(next);
        }
      }
      if (!stopped) timer = setTimeout(() => void turn(), PERIOD);
    };
    void turn();
    return () => {
      stopped = true;
      clearTimeout(timer);
    };
  }, [key, lookedAt]);

  useEffect(() => {
    let stopped = false;
    let timer: ReturnType<typeof setTimeout>;
    let end = -1;
    const turn = async () => {
      const about = shownOf(useTraces.getState());
      if (about && keyOf(about) === key && about.end !== end && lookedAt()) {
        const data = await readSamples(about.source, 0, null, OVERVIEW);
        if (!stopped && data) {
          end = about.end;
          setOutline({ key, samples: decode(data, about.signals) });
        }
      }
      if (!stopped) timer = setTimeout(() => void turn(), WHOLE_PERIOD);
    };
    void turn();
    return () => {
      stopped = true;
      clearTimeout(timer);
    };
  }, [key, lookedAt]);

  return {
    samples: held?.key === key ? held.samples : null,
    whole: outline?.key === key ? outline.samples : null,
  };
}

/** Fetches what the view needs; returns the same object where nothing has changed. */
async function fetched(key: string, held: Held | null): Promise<Held | null> {
  const state = useTraces.getState();
  const shown = shownOf(state);
  if (!shown || keyOf(shown) !== key) return held;
  const mine = held?.key === key ? held : null;
  const end = Math.max(shown.end, mine?.samples.end ?? 0);
  const view = viewOf(state, shown, end);
  const grows = isRecording(shown.trace);
  const atEnd = grows && view.to >= end - 1 - (view.to - view.from);
  const rows = (view.to - view.from) / shown.every;
  if (mine && atEnd && !mine.samples.decimated && mine.from <= view.from && rows <= FULL) {
    const data = await readSamples(shown.source, mine.to + 1, null, POINTS);
    if (!data) return held;
    const more = decode(data, shown.signals);
    if (more.generation !== mine.samples.generation) return null;
    if (more.scans.length === 0) return held;
    if (!more.decimated) {
      const samples = appended(mine.samples, more, Math.max(2 * Math.ceil(rows) + 100, 4000));
      return { key, samples, from: samples.scans[0] ?? 0, to: samples.scans.at(-1) ?? 0 };
    }
  }
  const grown = grows && atEnd && mine?.samples.decimated === true;
  const whole = wholeOf({ ...shown, end });
  const wanted = { from: Math.max(whole.from, view.from), to: Math.min(whole.to, view.to) };
  if (mine && enough(mine, wanted, grown)) return held;
  const width = wanted.to - wanted.from;
  const from = Math.max(whole.from, Math.floor(wanted.from - width / 2));
  const to = Math.ceil(wanted.to + width / 2);
  const points = (to - from) / shown.every <= FULL ? Math.max(POINTS, Math.ceil((to - from) / shown.every)) : POINTS;
  const data = await readSamples(shown.source, from, atEnd ? null : to, points);
  if (!data) return held;
  const samples = decode(data, shown.signals);
  if (!atEnd) return { key, samples, from, to };
  // A PLC at full speed has recorded many more rows than the last message said: the rows at its end are taken in full.
  const tail = samples.decimated && rows <= FULL ? samples.end - 1 - (to - from) : null;
  const again = tail === null ? null : await readSamples(shown.source, tail, samples.end - 1, points);
  const latest = again ? decode(again, shown.signals) : samples;
  if (latest.scans.length === 0) return { key, samples, from, to: samples.scans.at(-1) ?? from };
  return { key, samples: latest, from: Math.max(from, tail ?? from), to: latest.scans.at(-1) ?? from };
}
