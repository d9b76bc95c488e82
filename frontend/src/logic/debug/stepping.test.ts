import { describe, expect, it } from "vitest";
import type { InstanceState } from "../../wire/types";
import { permits } from "./stepping";

const plc = (state: InstanceState["state"], count: number | null = null) =>
  ({ state, halt: count === null ? null : { count } }) as InstanceState;

describe("steps", () => {
  it("are possible while the PLC runs; they halt it first", () => {
    expect(permits(plc("running"), "stepIn")).toBe(true);
    expect(permits(plc("running"), "pause")).toBe(true);
    expect(permits(plc("running"), "stepBack")).toBe(false);
    expect(permits(plc("running"), "continue")).toBe(false);
  });
  it("step out only from a frame that has a caller", () => {
    expect(permits(plc("halted", 7), "stepOut")).toBe(true);
    expect(permits(plc("halted", 0), "stepOut")).toBe(false);
    expect(permits(plc("paused"), "stepOut")).toBe(false);
  });
  it("go back and forward in the past, too", () => {
    expect(permits(plc("past", 7), "stepBack")).toBe(true);
    expect(permits(plc("past", 7), "continue")).toBe(true);
  });
  it("are not possible while the PLC cannot run", () => {
    for (const state of ["off", "starting", "failed"] as const)
      for (const command of ["next", "stepIn", "continue", "stepBack"] as const)
        expect(permits(plc(state), command)).toBe(false);
    expect(permits(null, "next")).toBe(false);
  });
  it("only go back where the program stopped with an error", () => {
    for (const state of ["trapped", "fatal", "stopped"] as const) {
      expect(permits(plc(state), "stepBack")).toBe(true);
      expect(permits(plc(state), "reverseContinue")).toBe(true);
      for (const command of ["next", "stepIn", "continue"] as const) expect(permits(plc(state), command)).toBe(false);
    }
  });
});
