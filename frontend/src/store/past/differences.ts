/** The differences found by verifications and by the shown comparison: marks of the timeline besides those of the journal. */
import { useMemo } from "react";
import { create } from "zustand";
import { type ShownMark, withDifferences } from "../../logic/plc/timeline";
import { t } from "../../text";
import type { VerificationInfo } from "../../wire/types";
import { verify } from "../../wire/verify";
import { useBench } from "../plc/bench";
import { useTimeline } from "../plc/timeline";
import { useVerify } from "../verify/verify";
import { shownComparison, useComparisons } from "./comparisons";

interface Found {
  /** The version of the verification's rows at the request: generation and number of differing rows. */
  at: string;
  marks: readonly ShownMark[];
}

interface Differences {
  /** By the id of the verification. */
  of: ReadonlyMap<number, Found>;
}

const useDifferences = create<Differences>(() => ({ of: new Map() }));
const get = useDifferences.getState;
const set = useDifferences.setState;

/** At most this many rows of a verification are marked. */
const MOST = 200;
/** Rows come by the hundred: they are requested at most once a second. */
const PERIOD = 1000;

const versionOf = ({ differing, generation }: VerificationInfo) => `${generation} ${differing}`;
// Scans of a controller log are those of a different controller.
const ofThisRun = ({ source }: VerificationInfo) => source !== "trace";

let timer: ReturnType<typeof setTimeout> | undefined;

function follow(): void {
  const { verifications } = useVerify.getState();
  const known = new Set(verifications.map(({ id }) => id));
  if ([...get().of.keys()].some((id) => !known.has(id)))
    set(({ of }) => ({ of: new Map([...of].filter(([id]) => known.has(id))) }));
  if (timer !== undefined || verifications.every((info) => !isBehind(info))) return;
  timer = setTimeout(() => {
    timer = undefined;
    for (const info of useVerify.getState().verifications) if (isBehind(info)) void load(info);
  }, PERIOD);
}

function isBehind(info: VerificationInfo): boolean {
  if (!ofThisRun(info)) return false;
  const known = get().of.get(info.id);
  if (!known) return info.differing > 0;
  // The first differences are marked; later ones change nothing once there are enough.
  return (
    known.at !== versionOf(info) && !(known.marks.length >= MOST && known.at.split(" ")[0] === `${info.generation}`)
  );
}

async function load(info: VerificationInfo): Promise<void> {
  const { id } = info;
  try {
    const { rows } = await verify.rows({ kind: "verification", id }, 0, MOST, true);
    const marks = rows.map(({ scan, differences }) => ({
      scan,
      kind: "difference" as const,
      author: info.by,
      text: t("timeline.differ", { text: differences[0]?.name ?? info.title }),
    }));
    if (useVerify.getState().verifications.some((known) => known.id === id))
      set(({ of }) => ({ of: new Map(of).set(id, { at: versionOf(info), marks }) }));
  } catch {
    // The verification was deleted meanwhile, or the connection was lost: its next message requests the rows again.
  }
  follow();
}

useVerify.subscribe((now, before) => {
  if (now.verifications !== before.verifications) follow();
});

/** The marks of the timeline, including those of differences. */
export function useAllMarks(): readonly ShownMark[] {
  const marks = useTimeline((timeline) => timeline.marks);
  const { of } = useDifferences();
  const comparison = useComparisons(shownComparison);
  const names = useBench((bench) => bench.app?.instances);
  return useMemo(() => {
    const found = [...of.values()].flatMap((each) => each.marks);
    const scan = comparison?.result?.scan ?? null;
    if (!comparison || scan === null) return withDifferences(marks, found);
    const name = names?.find(({ id }) => id === comparison.b)?.name ?? t("compare.gone", { id: comparison.b });
    const parting: ShownMark = {
      scan,
      kind: "difference",
      author: comparison.by,
      text: t("timeline.runsdiffer", { name }),
    };
    return withDifferences(marks, [...found, parting]);
  }, [marks, of, comparison, names]);
}
