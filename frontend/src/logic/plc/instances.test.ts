import { describe, expect, it } from "vitest";
import type { Instance } from "../../wire/types";
import { copyName, shownInstances, sumOf } from "./instances";

function plc(id: number, name: string, cpu: number, mode: "RUN" | "MONITOR" = "MONITOR"): Instance {
  return {
    id,
    name,
    project: { id: 1, name: "conveyor", model: "CJ1M-CPU63", version: 1, watch: [] },
    model: "CJ1M-CPU63",
    load: { cpu_percent: cpu, memory_bytes: 1000, run_bytes: 0 },
    limits: { memory_mib: null, cpu_percent: null, run_mib: null },
    users: [],
    state: { state: "running", mode, scan: id, interval_ns: 1, late_percent: 0 } as Instance["state"],
  };
}

const all = [plc(1, "line-10", 5), plc(2, "line-9", 7, "RUN"), plc(3, "press", 5)];
const names = (shown: Instance[]) => shown.map(({ name }) => name);

describe("the instance list", () => {
  it("sorts numbers by size, names alphabetically with numbers by size, equal values by name", () => {
    expect(names(shownInstances(all, "", { by: "name", down: false }))).toEqual(["line-9", "line-10", "press"]);
    expect(names(shownInstances(all, "", { by: "cpu", down: true }))).toEqual(["line-9", "line-10", "press"]);
    expect(names(shownInstances(all, "", { by: "cpu", down: false }))).toEqual(["line-10", "press", "line-9"]);
  });

  it("filters by every word", () => {
    expect(names(shownInstances(all, "LINE run", { by: "name", down: false }))).toEqual(["line-9", "line-10"]);
    expect(names(shownInstances(all, "monitor conv", { by: "name", down: true }))).toEqual(["press", "line-10"]);
    expect(shownInstances(all, "nothing", { by: "name", down: false })).toEqual([]);
  });

  it("adds up the load", () => {
    expect(sumOf(all)).toEqual({ running: 3, cpu: 17, memory: 3000 });
  });

  it("finds a free name", () => {
    expect(copyName("line", ["line"])).toBe("line-2");
    expect(copyName("line-1", ["line-1", "line-2"])).toBe("line-3");
  });
});
