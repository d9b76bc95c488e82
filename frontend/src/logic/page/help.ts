/** Which page of the help belongs to a place of the window. A place is a file below `docs/`, and a heading there: `watch.md#forces`. */

/** A place of a page, and what one can find there. */
export interface HelpEntry {
  id: string;
  title: string;
  text: string;
}

export interface HelpPage {
  title: string;
  html: string;
  entries: HelpEntry[];
}

export const CONTENTS = "README.md";

/** By the name of a panel, or of a part of the window. */
const TOPICS: Readonly<Record<string, string>> = {
  campaign: "verification.md#campaigns",
  whatif: "verification.md#what-if",
  calls: "projects.md#who-uses-it-who-calls-it",
  communication: "communication.md",
  compare: "time-travel.md#comparing-two-runs",
  console: "window.md#console",
  cross: "projects.md#who-uses-it-who-calls-it",
  debug: "debugger.md",
  diagnostics: "subranges.md",
  disturb: "verification.md#disturbances",
  editor: "window.md#editor",
  errors: "error-simulator.md",
  explorer: "window.md#explorer",
  forces: "watch.md#forces",
  hardware: "error-simulator.md#hardware-configuration",
  help: CONTENTS,
  history: "error-simulator.md#history-and-test-record",
  log: "window.md#events",
  memory: "memory.md",
  operator: "operator-panels.md",
  plcerrors: "error-simulator.md#the-plcs-own-view",
  problems: "problems/README.md",
  rack: "operator-panels.md#all-inputs-and-outputs",
  record: "error-simulator.md#history-and-test-record",
  search: "projects.md#search-and-replace-in-all-files",
  start: "window.md",
  status: "window.md",
  steps: "charts.md#the-lanes-of-the-steps",
  sweep: "error-sweep.md",
  timeline: "virtual-plc.md#timeline",
  topbar: "virtual-plc.md#modes",
  trace: "trace.md",
  usererrors: "error-simulator.md#user-defined-errors",
  verify: "verification.md",
  versions: "projects.md#versions",
  watch: "watch.md",
};

/** The names of all places that have help. */
export const topics = Object.keys(TOPICS);

/** The help of a panel, by its name in the dock or its pane; a file is a text, or an operator panel. */
export function topicOf(panel: string): string {
  const known = TOPICS[panel];
  if (known !== undefined) return known;
  return panel.toLowerCase().endsWith(".panel.json") ? "operator-panels.md" : "window.md#editor";
}

export const problemHelp = (code: string) => `problems/${code}.md`;

export const standardHelp = (name: string) => `standard-library.md#${name.toLowerCase()}`;

/** The name that a caret is in or beside; null between names. Columns count from 1. */
export function nameAt(line: string, column: number): string | null {
  const before = /[A-Za-z_]\w*$/.exec(line.slice(0, column - 1))?.[0] ?? "";
  const after = /^\w*/.exec(line.slice(column - 1))?.[0] ?? "";
  const name = before + after;
  return /^[A-Za-z_]/.test(name) ? name : null;
}

/** The place that a link of a page leads to; null: it leads out of the help. */
export function placeOf(href: string, from: string): string | null {
  if (/^[a-z]+:/i.test(href)) return null;
  const { pathname, hash } = new URL(href, `http://help/docs/${from}`);
  const path = pathname.startsWith("/docs/") ? pathname.slice("/docs/".length) : `..${pathname}`;
  return `${path}${hash}`;
}
