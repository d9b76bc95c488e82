/** What the tour does: the README's *Try it*, step by step. Each step waits for the event itself, whoever causes it. */

import { isSample } from "../../logic/project/sample";
import { breakpointsAt } from "../../store/debug/debug";
import { useStack } from "../../store/debug/stack";
import { useSweeps } from "../../store/errors/sweeps";
import { openFile, showPanel } from "../../store/page/navigate";
import { usePlc } from "../../store/plc/plc";
import { currentText } from "../../store/plc/values";
import { useDocuments } from "../../store/project/documents";
import { type TextKey, t } from "../../text";

export interface Step {
  name: "sample" | "write" | "raise" | "recover" | "history" | "sweep" | "halt" | "into" | "back" | "go";
  /** Brings the control into sight. */
  show: () => void;
  /** The control that does it; null while it is not in the page. */
  target: () => Element | null;
  /** What was there before the step; `done` compares with it. */
  before?: () => number;
  done: (before: number) => boolean;
  /** It is done only as long as this is so: somebody may choose a different project. */
  lasts?: boolean;
}

const ERROR = "basic-io-error";
const FILE = "Main.st";
const LINE = 26;

/** Variables whose values decide about steps. */
export const WATCHED = ["start"];

const find = (selector: string) => document.querySelector(selector);
const named = (label: TextKey) => find(`.runset [aria-label="${t(label)}"]`);
const errorStatus = () => usePlc.getState().errors.get(ERROR)?.status;
const halted = () => usePlc.getState().state?.halt ?? null;
const frames = () => useStack.getState().frames.length;
const newestSweep = () => Math.max(0, ...(useSweeps.getState().list ?? []).map(({ id }) => id));

/** The number in the gutter of the editor. */
const lineNumber = () =>
  [...document.querySelectorAll(`[data-pane="editor"] .line-numbers`)].find(
    ({ textContent }) => textContent === String(LINE),
  ) ?? null;

export const STEPS: readonly Step[] = [
  {
    name: "sample",
    show: () => undefined,
    target: () => find(".picker"),
    done: () => isSample(useDocuments.getState().files),
    lasts: true,
  },
  {
    name: "write",
    show: () => showPanel("watch"),
    target: () => find(`[data-path="start"] input`),
    done: () => currentText("start") === "TRUE",
  },
  {
    name: "raise",
    show: () => showPanel("errors"),
    target: () =>
      find(`[data-key="${ERROR}"][aria-selected="true"]`)
        ? find(`[data-pane="errors"] .acts .btn.primary`)
        : find(`[data-key="${ERROR}"]`),
    done: () => errorStatus() === "generated",
  },
  {
    name: "recover",
    show: () => showPanel("errors"),
    target: () => find(`[data-pane="errors"] .acts .btn:not(.primary, .quiet)`),
    done: () => errorStatus() === "cleared",
  },
  {
    name: "history",
    show: () => undefined,
    target: () => find(`[data-panel="history"]`),
    done: () => (find(`[data-pane="history"]`)?.getBoundingClientRect().height ?? 0) > 0,
  },
  {
    name: "sweep",
    show: () => showPanel("errors"),
    target: () => find(`dialog[open] .btn.primary`) ?? find(`[data-tour="runall"]`),
    before: newestSweep,
    done: (before) => newestSweep() > before,
  },
  {
    name: "halt",
    show: () => openFile(FILE, LINE),
    target: lineNumber,
    done: () => halted()?.file.endsWith(FILE) === true && halted()?.line === LINE,
  },
  { name: "into", show: () => undefined, target: () => named("debug.in"), done: () => frames() >= 2 },
  {
    name: "back",
    show: () => undefined,
    target: () => named("debug.back"),
    done: () => halted() !== null && frames() === 1,
  },
  {
    name: "go",
    show: () => openFile(FILE, LINE),
    target: () => (breakpointsAt(FILE, LINE).length > 0 ? lineNumber() : named("run.continue")),
    done: () => breakpointsAt(FILE, LINE).length === 0 && usePlc.getState().state?.state === "running",
  },
];
