/** Durations as IEC 61131-3 writes them. */

const UNITS: [string, bigint][] = [
  ["d", 86_400_000_000_000n],
  ["h", 3_600_000_000_000n],
  ["m", 60_000_000_000n],
  ["s", 1_000_000_000n],
  ["ms", 1_000_000n],
  ["us", 1_000n],
  ["ns", 1n],
];

/** T#1m5s250ms: the units that are not zero, as IEC 61131-3 writes durations. */
export function formatTime(ns: bigint, prefix = "T"): string {
  if (ns === 0n) return `${prefix}#0s`;
  let rest = ns < 0n ? -ns : ns;
  let text = ns < 0n ? `${prefix}#-` : `${prefix}#`;
  for (const [unit, size] of UNITS) {
    const count = rest / size;
    if (count > 0n) text += `${count}${unit}`;
    rest %= size;
  }
  return text;
}
