/** The address of the shown scan, and the request of an address that was opened. */
import { create } from "zustand";
import { grouped } from "../../logic/format/numbers";
import {
  isBrokenLink,
  isOwnComputer,
  type Link,
  linkPath,
  loneIn,
  operatedPanel,
  readLink,
  wayTo,
} from "../../logic/plc/links";
import { t } from "../../text";
import { isPanel, showPanel } from "../page/navigate";
import { useBench } from "./bench";
import { usePlc } from "./plc";
import { liveScan, travel, useTimeline } from "./timeline";

interface Links {
  /** The address with which the page was opened, until it has been followed. */
  opened: Link | null;
  /** The scan of the question: others use this PLC. */
  question: number | null;
  /** Why a link could not be followed. */
  trouble: string | null;
}

export const useLinks = create<Links>(() => ({
  opened: readLink(location),
  question: null,
  trouble: isBrokenLink(location) ? t("link.broken", { example: "/i/1/scan/4711" }) : null,
}));
const get = useLinks.getState;
const set = useLinks.setState;

/** After each connection: the first one follows the link with which the page was opened. */
export function followLink(): void {
  const { opened } = get();
  const instance = useBench.getState().instance?.id;
  if (opened === null || opened.instance !== instance) return;
  set({ opened: null });
  if (opened.panel !== null) {
    if (isPanel(opened.panel)) showPanel(opened.panel);
    else set({ trouble: t("link.nopanel", { panel: opened.panel }) });
  }
  if (opened.scan !== null) follow(opened.scan);
  writeAddress();
}

function follow(scan: number): void {
  const { state, users, you } = usePlc.getState();
  const first = useTimeline.getState().info?.first_scan ?? 0;
  const live = liveScan();
  const others = users.filter(({ name }) => name !== you?.name).length;
  const way = wayTo(scan, { first, live, past: state?.past ? state.scan : null, others });
  if (way === "go") void travel(scan);
  if (way === "ask") set({ question: scan });
  if (way === "outside")
    set({ trouble: t("link.outside", { scan: grouped(scan), first: grouped(first), live: grouped(live) }) });
}

/** The answer to the question: go there, or stay. */
export function answerLink(go: boolean): void {
  const { question } = get();
  set({ question: null });
  if (go && question !== null) void travel(question, 0, true);
  writeAddress();
}

export const putAwayLinkTrouble = () => set({ trouble: null });

/** The absolute address of a scan of the selected instance; empty without an instance. */
export function scanLink(scan: number | null, panel: string | null = null): string {
  const instance = useBench.getState().instance?.id;
  return instance === undefined ? "" : linkOrigin() + linkPath({ instance, scan, panel });
}

/** The address of an operator panel alone; empty without an instance. */
export function panelLink(file: string): string {
  const link = scanLink(null);
  return link === "" ? "" : `${link}?operate=${encodeURIComponent(file)}`;
}

/** The beginning of shared links: the public address of the server, else that of this page. */
export const linkOrigin = () => useBench.getState().app?.public_url || location.origin;

/** The labels of a button that copies a link, before and after the click: they say for whom the link works. */
export function linkWords(): { title: string; done: string } {
  const host = new URL(linkOrigin()).hostname;
  return isOwnComputer(host)
    ? { title: t("link.copy.hint.here", { host }), done: t("link.copied.here") }
    : { title: t("link.copy.hint"), done: t("link.copied") };
}

const QUIET = 300;
let later: ReturnType<typeof setTimeout> | undefined;

/** The address bar contains the instance, and the scan while the page shows the past: it can be copied at any time. */
function writeAddress(): void {
  clearTimeout(later);
  later = setTimeout(() => {
    const { opened, question } = get();
    if (opened !== null || question !== null || (operatedPanel(location) ?? loneIn(location)) !== null) return;
    const instance = useBench.getState().instance?.id;
    const { state } = usePlc.getState();
    if (instance === undefined) return;
    const path = linkPath({ instance, scan: state?.past ? state.scan : null, panel: null });
    if (location.pathname + location.search !== path) history.replaceState(null, "", path);
  }, QUIET);
}

useBench.subscribe((now, before) => {
  const { opened } = get();
  if (
    opened !== null &&
    now.phase === "ready" &&
    now.app &&
    !now.app.instances.some(({ id }) => id === opened.instance)
  )
    set({ opened: null, trouble: t("link.gone", { instance: opened.instance }) });
  if (now.instance?.id !== before.instance?.id) {
    if (before.instance) set({ question: null });
    writeAddress();
  }
});
usePlc.subscribe(({ state: now }, { state: before }) => {
  if (now?.past !== before?.past || now?.scan !== before?.scan) {
    // Somebody else went to the scan of the question.
    if (now?.past && now.scan === get().question) set({ question: null });
    if (now?.past || before?.past) writeAddress();
  }
});
