/** A disturbance of the PLC: the fields as typed, and the request to the server. */

import type { TextKey } from "../../text";
import type { NewDisturbance } from "../../wire/types";
import { readScan } from "../plc/timeline";

export type DisturbKind = NewDisturbance["kind"];
export const KINDS = ["flip", "late", "stuck", "result"] as const;
export const WHENS = ["next", "scan", "chance"] as const;

export interface DisturbForm {
  kind: DisturbKind;
  path: string;
  bit: string;
  /** `FILE:LINE` */
  site: string;
  when: (typeof WHENS)[number];
  scan: string;
  /** As typed: `0.1 %`, `0.001`, `1/1000`. */
  chance: string;
  /** At random only; empty: unlimited. */
  times: string;
  seed: string;
  scans: string;
  /** A stuck input stays stuck until it is taken back. */
  endless: boolean;
}

type DisturbField = "path" | "bit" | "site" | "scan" | "chance" | "times" | "seed" | "scans";

export const plainDisturbance: DisturbForm = {
  kind: "flip",
  path: "",
  bit: "",
  site: "",
  when: "next",
  scan: "",
  chance: "1 %",
  times: "",
  seed: "1",
  scans: "10",
  endless: false,
};

/** This number of scans means: until it is taken back. */
export const ENDLESS = 1_000_000;
const MOST_BIT = 1023;

/** Kinds that flip one bit; the seed may choose which. */
export const turnsBits = (kind: DisturbKind): boolean => kind === "flip" || kind === "result";

/** The seed has an effect. */
export const isSeeded = (form: DisturbForm): boolean =>
  form.when === "chance" || (turnsBits(form.kind) && form.bit.trim() === "");

interface ReadDisturbance {
  wanted: NewDisturbance;
  troubles: Partial<Record<DisturbField, TextKey>>;
}

/** Reads the typed fields; hidden fields are not checked. `now` is the scan that the PLC has reached. */
export function readDisturbance(form: DisturbForm, now = 0): ReadDisturbance {
  const { kind, when } = form;
  const troubles: ReadDisturbance["troubles"] = {};
  const count = (field: DisturbField, least: number, most = ENDLESS): number => {
    const read = readScan(form[field]);
    if (read !== null && read >= least && read <= most) return read;
    troubles[field] = "shape.bad.count";
    return least;
  };
  const wanted: NewDisturbance = {
    kind,
    path: kind === "result" ? "" : form.path.trim(),
    bit: null,
    site: kind === "result" ? form.site.trim() : "",
    scan: null,
    probability: 0,
    seed: isSeeded(form) ? count("seed", 0, Number.MAX_SAFE_INTEGER) : 0,
    scans: 1,
    times: 0,
  };
  if (kind === "flip" && wanted.path === "") troubles.path = "disturb.bad.path";
  if (kind === "result" && !/^.+:[1-9]\d*$/.test(wanted.site)) troubles.site = "shape.bad.place";
  if (turnsBits(kind) && form.bit.trim() !== "") wanted.bit = readBit(form.bit, troubles);
  if (!turnsBits(kind)) wanted.scans = kind === "stuck" && form.endless ? ENDLESS : count("scans", 1);
  if (when === "scan" || (when === "chance" && form.scan.trim() !== "")) wanted.scan = readStart(form, now, troubles);
  if (when === "chance") {
    wanted.probability = readChance(form.chance) ?? 0;
    if (wanted.probability === 0) troubles.chance = "disturb.bad.chance";
    if (form.times.trim() !== "") wanted.times = count("times", 1);
  }
  return { wanted, troubles };
}

function readBit(text: string, troubles: ReadDisturbance["troubles"]): number | null {
  const bit = readScan(text);
  if (bit !== null && bit <= MOST_BIT) return bit;
  troubles.bit = "disturb.bad.bit";
  return null;
}

function readStart(form: DisturbForm, now: number, troubles: ReadDisturbance["troubles"]): number | null {
  const scan = readScan(form.scan);
  if (scan === null) troubles.scan = "shape.bad.scan";
  // The first scan may be in the past: the probability applies to each scan from now on.
  else if (scan < now && form.when === "scan") troubles.scan = "shape.bad.past";
  return scan;
}

/** A typed probability: `0.1 %`, `0,001`, `1/1000`; null when it is not between 0 and 1. */
export function readChance(text: string): number | null {
  const plain = text.replace(/\s/g, "").replace(",", ".");
  const found = /^(\d+(?:\.\d+)?|\.\d+)(%|\/(\d+(?:\.\d+)?))?$/.exec(plain);
  if (!found) return null;
  const divisor = found[2] === "%" ? 100 : Number(found[3] ?? 1);
  const chance = Number(found[1]) / divisor;
  return chance > 0 && chance <= 1 ? chance : null;
}
