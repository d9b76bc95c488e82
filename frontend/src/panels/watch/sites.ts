/** Call sites of an in-out: the one that its writes go to. */
import type { Binding, BoundTo } from "../../wire/types";

export const siteName = ({ file, line }: BoundTo) => `${file}:${line}`;

/** The call that was picked, else the one that ran last. */
export function siteShown(binding: Binding, chosen: string | undefined): BoundTo | undefined {
  const { sites } = binding;
  return sites.find((site) => siteName(site) === chosen) ?? sites.find(({ last }) => last) ?? sites[0];
}
