/** A few errors of a device: one without details, one with numbers, a fatal one. */
import type { ErrorDetail, ErrorHistoryRow, ErrorInfo, ModelInfo, ReactionState } from "../wire/types";
import { MODEL } from "./samples";

function error(id: string, name: string, more: Partial<ErrorInfo>): ErrorInfo {
  return {
    id,
    name,
    code: "0000",
    flag: "",
    severity: "nonfatal",
    priority: 100,
    description: "",
    details: [],
    facts: [],
    source: "",
    absent: false,
    user: false,
    verified: true,
    ...more,
  };
}

const spin = (name: string, description: string, maximum: number): ErrorDetail => ({
  name,
  description,
  control: "Spin",
  kind: "BCD",
  address: "",
  adds: false,
  base: 10,
  default: "0",
  minimum: 0,
  maximum,
  hardware: "",
  identifies: "",
});

export const BATTERY = error("battery-error", "Battery error", {
  code: "00F7",
  flag: "A402.04",
  facts: [
    { of: "flag", value: "A402.04", source: "manual, p. 12", verified: true, inherited: false },
    { of: "code", value: "00F7", source: "known", verified: false, inherited: true },
  ],
});

export const BASIC = error("basic-io-error", "Basic I/O Unit error", {
  code: "009A",
  flag: "A402.12",
  details: [spin("rack", "Rack number", 3), spin("slot", "Slot number", 9)],
});

export const MEMORY = error("memory-error", "Memory error", { code: "80F1", flag: "A401.15", severity: "fatal" });

export const CATALOGUE: ModelInfo = {
  ...MODEL,
  error_count: 3,
  catalogue: [
    { name: "CPU", errors: [MEMORY, BATTERY], groups: [] },
    { name: "Units", errors: [BASIC], groups: [] },
  ],
};

/** What is known of an error: nobody raised it yet, unless said. */
export function row({ id, name, code, severity }: ErrorInfo, more: Partial<ErrorHistoryRow> = {}): ErrorHistoryRow {
  return {
    id,
    name,
    code,
    severity,
    status: "never",
    by: null,
    count: 0,
    details: "",
    generated_at: null,
    generated_scan: null,
    recovered_at: null,
    recovered_scan: null,
    recovered_by: "",
    recovered_way: null,
    acknowledged: null,
    origin: null,
    reaction: null,
    swept: null,
    fitted: true,
    instance: "",
    label: "",
    ...more,
  };
}

/** Raised by Mika before scan 1,234. */
export const RAISED: Partial<ErrorHistoryRow> = {
  status: "generated",
  by: "Mika",
  count: 1,
  generated_at: "2026-11-20T10:00:00+00:00",
  generated_scan: 1234,
  origin: "simulator",
};

export const CLEARED: Partial<ErrorHistoryRow> = {
  ...RAISED,
  status: "cleared",
  recovered_at: "2026-11-20T10:01:00+00:00",
  recovered_scan: 1300,
};

export const verdict = (verdict: ReactionState["verdict"], scans: number | null = null, unmet = 0): ReactionState => ({
  state: "done",
  verdict,
  scans,
  unmet,
  message: "",
});
