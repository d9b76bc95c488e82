/** What a refused entry could have meant, from the values that the PLC says it allows. */

const MOST = 3;

export function corrections(message: string, entry: string): string[] {
  const range = /is outside of .*?(-?\d+)(?: to |\.\.)(-?\d+)/.exec(message);
  if (range?.[1] && range[2]) return nearest(message, range[1], range[2]);
  const values = /; write ([\p{L}_][\p{L}\d_]*(?:(?:, | or )[\p{L}_][\p{L}\d_]*)+)$/u.exec(message)?.[1];
  return values
    ? values
        .split(/, | or /)
        .filter((value) => value !== entry)
        .slice(0, MOST)
    : [];
}

function nearest(message: string, low: string, high: string): string[] {
  const typed = /(-?\d+) is outside of/.exec(message)?.[1];
  if (typed === undefined) return [];
  return [BigInt(typed) < BigInt(low) ? low : high];
}
