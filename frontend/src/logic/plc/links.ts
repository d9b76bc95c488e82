/** The address of an instance, of one of its scans, and of the panel to show: `/i/3/scan/4711?panel=verify`. */

export interface Link {
  instance: number;
  /** Null is live. */
  scan: number | null;
  /** The internal name of a tab; null is whichever tab is active. */
  panel: string | null;
}

const PATH = /^\/i\/(\d{1,9})(?:\/scan\/(\d{1,15}))?\/?$/;
/** Names that an address may use besides those of the tabs. */
const ALIASES: Readonly<Record<string, string>> = { verification: "verify", simulator: "errors", events: "log" };

type Address = Pick<Location, "pathname" | "search">;

/** What an address asks for; null when it is not the address of an instance. */
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

/** The file of the operator panel that has the whole window: `/i/3?operate=Belt.panel.json`. */
export const operatedPanel = ({ search }: Pick<Location, "search">) =>
  new URLSearchParams(search).get("operate") || null;

/** The panel that has a window of its own: `/i/3?alone=watch`, `/i/3?alone=file:Main.st`. */
export const loneIn = ({ search }: Pick<Location, "search">) => new URLSearchParams(search).get("alone") || null;

/** The address of such a window, from the server's root. */
export const lonePath = (instance: number, panel: string) => `/i/${instance}?alone=${encodeURIComponent(panel)}`;

/** True for `/i/...` that this page does not understand. */
export function isBrokenLink(address: Address): boolean {
  return address.pathname.startsWith("/i/") && readLink(address) === null;
}

/** The path of an address, from the server's root. */
export function linkPath({ instance, scan, panel }: Link): string {
  const at = scan === null ? "" : `/scan/${scan}`;
  const shown = panel === null ? "" : `?panel=${encodeURIComponent(panel === "verify" ? "verification" : panel)}`;
  return `/i/${instance}${at}${shown}`;
}

/** True for a host that means a different computer on every computer (such as localhost): a link with it leads a colleague to their own. */
export function isOwnComputer(host: string): boolean {
  return /^(localhost|.+\.localhost|127(\.\d+){3}|\[::1\])$/i.test(host);
}

type LinkWay = "there" | "go" | "ask" | "outside";

/** How to follow a link to a scan. While others look at the PLC, the page asks first, because going to the past takes everybody along. */
export function wayTo(
  scan: number,
  now: { first: number; live: number; past: number | null; others: number },
): LinkWay {
  if (now.past === scan) return "there";
  if (scan < now.first || scan > now.live) return "outside";
  return now.others > 0 ? "ask" : "go";
}
