/** What a server would tell of a small bench: one project, one PLC that runs. A test changes what it is about. */
import type {
  AppInfo,
  Hello,
  Instance,
  InstanceState,
  ModelInfo,
  PlcSymbol,
  Project,
  Timeline,
  TraceInfo,
  User,
} from "../wire/types";

export const MIKA: User = { name: "Mika", initials: "M", client: false };
export const JO: User = { name: "Jo", initials: "J", client: false };

const RUNNING: InstanceState = {
  state: "running",
  mode: "MONITOR",
  message: "",
  scan: 1000,
  time_ns: 10_000_000_000,
  cycle_us: 40,
  interval_ns: 10_000_000,
  late_percent: 0,
  late_us: 0,
  worst_us: 0,
  speed: 1,
  flavour: "quick",
  target: "",
  forces: 0,
  halt: null,
  trap: null,
  past: null,
  pid: 4711,
  restarts: 0,
  program_version: 1,
  previous_version: null,
  startable: true,
};

export const someProject = (id: number): Project => ({ id, name: "Conveyor", model: "CJ1M", version: 1, watch: [] });

export const someInstance = (id: number, project: Project): Instance => ({
  id,
  name: "line-1",
  model: "CJ1M",
  project,
  state: RUNNING,
  limits: { cpu_percent: null, memory_mib: null, run_mib: null },
  load: { cpu_percent: 1, memory_bytes: 50_000_000, run_bytes: 1_000_000 },
  users: [],
});

export const someApp = (instance: Instance): AppInfo => ({
  version: "0.1.0",
  public_url: "",
  you: MIKA,
  projects: [instance.project],
  instances: [instance],
});

export const MODEL: ModelInfo = {
  name: "CJ1M",
  vendor: "Omron",
  description: "",
  areas: [],
  catalogue: [],
  code_word: "A400",
  hardware: false,
  code_words: ["A400"],
  servers: ["fins", "modbus", "opcua"],
  status_words: [],
  error_count: 0,
  verified_count: 0,
  fact_count: 0,
  verified_facts: 0,
};

export const RUN: Timeline = {
  type: "timeline",
  fresh: true,
  marks: [],
  info: {
    bytes: 1_000_000,
    limit_bytes: 1_000_000_000,
    first_scan: 0,
    dropped_before: 0,
    thinned_before: 0,
    recording: "",
    damage: "",
    lost: [],
  },
};

export const someHello = (instance: Instance): Hello => ({
  type: "hello",
  instance,
  you: MIKA,
  users: [MIKA],
  errors: [],
  armed: [],
  lines: { type: "lines", broken: [] },
  forces: [],
  log: [],
  breakpoints: [],
  coverage: null,
  diagnostics: { type: "diagnostics", violations: [], dropped: 0, count: 0 },
  device: null,
  disturbances: [],
  timeline: RUN,
  verifications: [],
});

/** A trace that records one signal. */
export const TRACE: TraceInfo = {
  id: 1,
  by: "Mika",
  bytes: 1000,
  definition: { name: "Trace 1", signals: ["Main.n"], every: 1, scans: 1000, trigger: null, repeat: false },
  first: 1,
  end: 100,
  generation: 1,
  hits: 0,
  interval_ns: 10_000_000,
  note: "",
  rows: 99,
  signals: [],
  state: "recording",
  triggered: null,
};

const SIZES: Record<string, [PlcSymbol["kind"], number]> = {
  BOOL: ["bool", 1],
  INT: ["int", 2],
  DINT: ["int", 4],
  BYTE: ["bits", 1],
  WORD: ["bits", 2],
  TIME: ["time", 8],
};

/** A variable or an address of an elementary type. */
export function symbol(path: string, type: keyof typeof SIZES, more: Partial<PlcSymbol> = {}): PlcSymbol {
  const [kind, size] = SIZES[type] ?? ["struct", 0];
  return {
    path,
    name: path.split(".").at(-1) ?? path,
    type,
    kind,
    size,
    address: null,
    writable: true,
    section: "VAR",
    expandable: false,
    values: [],
    range: "",
    in_out: false,
    ...more,
  };
}
