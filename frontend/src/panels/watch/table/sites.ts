/** Call sites of an in-out: the one that its writes go to. */
import type { Binding, BoundTo } from "../../../wire/types";

export const siteName = ({ file, line }: BoundTo) => `${file}:${line}`;

/** The chosen call, else the one that ran last; none before the first one ran. */
export function siteShown({ ok, sites }: Binding, chosen: string | undefined): BoundTo | undefined {
  const picked = sites.find((site) => siteName(site) === chosen) ?? sites.find(({ last }) => last);
  return picked ?? (ok ? sites[0] : undefined);
}
