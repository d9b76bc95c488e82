/** When a fault begins and how it continues: the fields as typed, and the request to the server. */

import type { TextKey } from "../../text";
import type { FaultShape, FaultStart } from "../../wire/types";
import { readScan } from "../plc/timeline";

export interface ShapeForm {
  when: FaultStart["kind"];
  scan: string;
  condition: string;
  /** `FILE:LINE` */
  place: string;
  how: FaultShape["kind"];
  scans: string;
  period: string;
  /** Empty: until it is taken back. */
  times: string;
  chance: boolean;
  seed: string;
  acknowledge: string;
  /** Probability in each scan, in percent. */
  percent: string;
}

export type ShapeField = keyof ShapeForm;

export const WHENS = ["now", "scan", "condition", "line"] as const;
export const HOWS = ["stay", "for", "intermittent", "chatter", "chance", "unacknowledged"] as const;

export const plainShape: ShapeForm = {
  when: "now",
  scan: "",
  condition: "",
  place: "",
  how: "stay",
  scans: "10",
  period: "100",
  times: "",
  chance: false,
  seed: "1",
  acknowledge: "",
  percent: "1",
};

/** Now, and until somebody recovers it: an ordinary Generate. */
export const isPlain = (form: ShapeForm): boolean => form.when === "now" && form.how === "stay";

interface ReadShape {
  start: FaultStart;
  shape: FaultShape;
  troubles: Partial<Record<ShapeField, TextKey>>;
}

/** Reads the typed fields; hidden fields are not checked. `now` is the scan that the PLC has reached. */
export function readShape(form: ShapeForm, now = 0): ReadShape {
  const troubles: ReadShape["troubles"] = {};
  return { start: readStart(form, now, troubles), shape: readHow(form, troubles), troubles };
}

function readStart(form: ShapeForm, now: number, troubles: ReadShape["troubles"]): FaultStart {
  const start: FaultStart = { kind: form.when, scan: null, condition: "", file: "", line: 0 };
  if (form.when === "scan") {
    start.scan = readScan(form.scan);
    if (start.scan === null) troubles.scan = "shape.bad.scan";
    else if (start.scan < now) troubles.scan = "shape.bad.past";
  }
  if (form.when === "condition") {
    start.condition = form.condition.trim();
    if (start.condition === "") troubles.condition = "run.noexpression";
  }
  if (form.when === "line") {
    const found = /^(.+):(\d+)$/.exec(form.place.trim());
    if (!found || Number(found[2]) < 1) troubles.place = "shape.bad.place";
    else Object.assign(start, { file: found[1]?.trim(), line: Number(found[2]) });
  }
  return start;
}

function readHow(form: ShapeForm, troubles: ReadShape["troubles"]): FaultShape {
  const { how } = form;
  const shape: FaultShape = {
    kind: how,
    scans: 1,
    period: 2,
    times: null,
    seed: null,
    acknowledge: "",
    per_million: 1000,
  };
  const count = (field: "scans" | "period" | "times" | "seed", least: number, otherwise: number): number => {
    const read = readScan(form[field]);
    if (read !== null && read >= least) return read;
    troubles[field] = "shape.bad.count";
    return otherwise;
  };
  if (how === "for" || how === "intermittent" || how === "unacknowledged" || how === "chance")
    shape.scans = count("scans", 1, 1);
  if (how === "intermittent") {
    shape.period = count("period", 2, 2);
    if (!troubles.period && !troubles.scans && shape.period <= shape.scans) troubles.period = "shape.bad.period";
    if (form.chance) shape.seed = count("seed", 0, 0);
  }
  if (how === "chance") {
    const millionths = readPercent(form.percent);
    if (millionths === null) troubles.percent = "shape.bad.percent";
    else shape.per_million = millionths;
    shape.seed = count("seed", 0, 0);
  }
  if (how === "intermittent" || how === "chatter" || how === "chance")
    shape.times = form.times.trim() === "" ? null : count("times", 1, 1);
  if (how === "unacknowledged") {
    shape.acknowledge = form.acknowledge.trim();
    if (shape.acknowledge === "") troubles.acknowledge = "run.noexpression";
  }
  return shape;
}

/** A percentage, as millionths: 0.0001 to 100 %. */
function readPercent(text: string): number | null {
  const value = /^\d{1,3}([.,]\d{1,4})?$/.test(text.trim())
    ? Math.round(Number(text.trim().replace(",", ".")) * 10_000)
    : 0;
  return value >= 1 && value <= 1_000_000 ? value : null;
}

/** Milliseconds as scans of a task; at least one. */
export function scansOf(ms: number, interval_ns: number): number {
  return Math.max(1, Math.round((ms * 1e6) / Math.max(1, interval_ns)));
}
