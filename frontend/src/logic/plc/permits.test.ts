import { describe, expect, it } from "vitest";
import type { InstanceState } from "../../wire/types";
import { forbidden } from "./permits";

const monitor: InstanceState = {
  state: "running",
  mode: "MONITOR",
  message: "",
  scan: 1,
  time_ns: 0,
  interval_ns: 10_000_000,
  cycle_us: 1,
  speed: 1,
  pid: 1,
  restarts: 0,
  trap: null,
  forces: 0,
  program_version: 1,
  previous_version: null,
  past: null,
  target: "",
  halt: null,
  flavour: "",
  late_percent: 0,
  late_us: 0,
  worst_us: 0,
  startable: true,
};

describe("permits", () => {
  it("MONITOR allows everything", () => {
    for (const deed of ["write", "force", "errors", "mode", "run", "restart", "newrun", "change"] as const)
      expect(forbidden(monitor, true, deed)).toBeNull();
  });

  it("a build is possible without a PLC", () => {
    expect(forbidden(null, false, "build")).toBeNull();
    expect(forbidden({ ...monitor, mode: "RUN" }, true, "build")).toBeNull();
  });

  it("RUN allows neither writes nor changes, but errors, modes and restarts", () => {
    const run = { ...monitor, mode: "RUN" } as const;
    expect(forbidden(run, true, "write")).toBe("permit.run");
    expect(forbidden(run, true, "force")).toBe("permit.run");
    expect(forbidden(run, true, "change")).toBe("permit.run.change");
    for (const deed of ["errors", "mode", "run", "restart"] as const) expect(forbidden(run, true, deed)).toBeNull();
  });

  it("nothing is possible while a PLC does not answer, has no process because it waits for disk space, or cannot be started", () => {
    const away = {
      "permit.silent": { ...monitor, state: "silent" },
      "permit.no_space": { ...monitor, state: "no_space", pid: null },
      "permit.failed": { ...monitor, state: "failed", pid: null },
    } as const;
    for (const [why, state] of Object.entries(away)) {
      for (const deed of ["write", "force", "errors", "mode", "run", "restart", "change", "travel"] as const)
        expect(forbidden(state, true, deed)).toBe(why);
      expect(forbidden({ ...state, past: { live_scan: 9, by: "Ann" } }, true, "travel")).toBe(why);
      expect(forbidden(state, true, "newrun")).toBeNull();
      expect(forbidden(state, true, "build")).toBeNull();
    }
  });

  it("no new run is possible while the model is missing", () => {
    const missing: InstanceState = { ...monitor, state: "failed", pid: null, startable: false };
    for (const deed of ["write", "restart", "newrun", "change", "travel"] as const)
      expect(forbidden(missing, true, deed)).toBe("permit.model");
    expect(forbidden(missing, true, "build")).toBeNull();
  });

  it("a PLC with a process can be used while it waits for disk space", () => {
    expect(forbidden({ ...monitor, state: "no_space" }, true, "write")).toBeNull();
  });

  it("nothing is possible in the past, while the PLC is switched off, and without a connection", () => {
    const past = { ...monitor, past: { live_scan: 9, by: "Ann" } };
    expect(forbidden(past, true, "errors")).toBe("permit.past");
    expect(forbidden(past, true, "travel")).toBeNull();
    expect(forbidden(past, true, "build")).toBe("permit.past.build");
    expect(forbidden({ ...monitor, state: "off" }, true, "mode")).toBe("permit.off");
    expect(forbidden(monitor, false, "run")).toBe("permit.offline");
    expect(forbidden(null, true, "run")).toBe("permit.offline");
  });
});
