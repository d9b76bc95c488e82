/** The address of an instance, a scan of it, and the panel to look at: `/i/3/scan/4711?panel=verify`. */

export interface Link {
  instance: number;
  /** Null is live. */
  scan: number | null;
  /** As the tabs are named inside; null is whatever is in front. */
  panel: string | null;
}

const PATH = /^\/i\/(\d{1,9})(?:\/scan\/(\d{1,15}))?\/?$/;
/** Names that an address may use beside those of the tabs. */
const ALIASES: Readonly<Record<string, string>> = { verification: "verify", simulator: "errors", events: "log" };

type Address = Pick<Location, "pathname" | "search">;

/** What an address asks for; null when it is none of an instance. */
export function readLink({ pathname, search }: Address): Link | null {
  const found = PATH.exec(pathname);
  if (!found) return null;
  const panel = new URLSearchParams(search).get("panel");
  return {
    instance: Number(found[1]),
    scan: found[2] === undefined ? null : Number(found[2]),
    panel: panel === null || panel === "" ? null : (ALIASES[panel] ?? panel),
  };
}

/** True of `/i/...` that says nothing this page understands. */
export function isBrokenLink(address: Address): boolean {
  return address.pathname.startsWith("/i/") && readLink(address) === null;
}

/** The path of an address, from the server's root. */
export function linkPath({ instance, scan, panel }: Link): string {
  const at = scan === null ? "" : `/scan/${scan}`;
  const shown = panel === null ? "" : `?panel=${encodeURIComponent(panel === "verify" ? "verification" : panel)}`;
  return `/i/${instance}${at}${shown}`;
}

/** True of a host that each computer understands as itself: an address with it leads a colleague to their own. */
export function isOwnComputer(host: string): boolean {
  return /^(localhost|.+\.localhost|127(\.\d+){3}|\[::1\])$/i.test(host);
}

type LinkWay = "there" | "go" | "ask" | "outside";

/** How a scan that a link names is come to. Where others look at the PLC they are asked for first: everybody sees the past. */
export function wayTo(
  scan: number,
  now: { first: number; live: number; past: number | null; others: number },
): LinkWay {
  if (now.past === scan) return "there";
  if (scan < now.first || scan > now.live) return "outside";
  return now.others > 0 ? "ask" : "go";
}
