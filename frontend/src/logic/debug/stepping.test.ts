import { describe, expect, it } from "vitest";
import type { InstanceState } from "../../wire/types";
import { permits } from "./stepping";

const plc = (state: InstanceState["state"], count: number | null = null) =>
  ({ state, halt: count === null ? null : { count } }) as InstanceState;

describe("steps", () => {
  it("begin from a PLC that runs as well, which they halt", () => {
    expect(permits(plc("running"), "stepIn")).toBe(true);
    expect(permits(plc("running"), "pause")).toBe(true);
    expect(permits(plc("running"), "stepBack")).toBe(false);
    expect(permits(plc("running"), "continue")).toBe(false);
  });
  it("go out of a frame only where there is one", () => {
    expect(permits(plc("halted", 7), "stepOut")).toBe(true);
    expect(permits(plc("halted", 0), "stepOut")).toBe(false);
    expect(permits(plc("paused"), "stepOut")).toBe(false);
  });
  it("go back and on in the past, too", () => {
    expect(permits(plc("past", 7), "stepBack")).toBe(true);
    expect(permits(plc("past", 7), "continue")).toBe(true);
  });
  it("mean nothing while nothing can run", () => {
    for (const state of ["off", "starting", "failed"] as const)
      for (const command of ["next", "stepIn", "continue", "stepBack"] as const)
        expect(permits(plc(state), command)).toBe(false);
    expect(permits(null, "next")).toBe(false);
  });
  it("go back, and only that, where the program broke off", () => {
    for (const state of ["trapped", "fatal", "stopped"] as const) {
      expect(permits(plc(state), "stepBack")).toBe(true);
      expect(permits(plc(state), "reverseContinue")).toBe(true);
      for (const command of ["next", "stepIn", "continue"] as const) expect(permits(plc(state), command)).toBe(false);
    }
  });
});
