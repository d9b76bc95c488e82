import { describe, expect, it } from "vitest";
import type { HaltInfo } from "../../wire/types";
import { haltCause, haltDetail, haltShort } from "./halted";

const halt = (part: Partial<HaltInfo>) =>
  ({ reason: "breakpoint", text: "", file: "Main.st", line: 12, ...part }) as HaltInfo;

describe("the description of a halt", () => {
  it("is the reason where that is enough", () => {
    const here = halt({ text: "breakpoint at Main.st:12" });
    expect(haltCause(here)).toBe("");
    expect(haltDetail(here)).toBe("at breakpoint, line 12");
  });
  it("says what happened: which variable changed, from which value to which", () => {
    const here = halt({ reason: "data breakpoint", text: "Main.level changed from 3 to 7" });
    expect(haltCause(here)).toBe("Main.level changed from 3 to 7");
    expect(haltDetail(here)).toBe("Main.level changed from 3 to 7, line 12");
    expect(haltShort(here)).toBe("line 12");
  });
});
