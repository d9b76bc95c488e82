import { describe, expect, it } from "vitest";
import type { OnlineChange } from "../../wire/types";
import { builtNote, changeNote, changeVerb, fates } from "./change";

const plc = (instance: number, name: string, refusal = ""): OnlineChange => ({
  instance,
  name,
  kept: 58,
  reinitialized: 1,
  new: 1,
  removed: 1,
  lost: [
    { path: "Main.shift", reason: "type changed from INT to TIME" },
    { path: "Main.extra", reason: "new" },
    { path: "Main.old", reason: "removed" },
  ],
  lost_count: 3,
  refusal,
});
const one = plc(1, "line-1");
const two = plc(2, "What-If");
const refusing = plc(1, "line-1", "mode RUN");

describe("online change", () => {
  it("lists the variables that are not kept: only a changed type loses a value", () => {
    expect(fates(one).reinitialized.map(({ path }) => path)).toEqual(["Main.shift"]);
    expect(changeNote(one)).toBe("58 kept, 1 reinitialized, 1 new, 1 removed");
    expect(changeNote({ ...one, reinitialized: 0, new: 0, removed: 0 })).toBe("58 kept");
    expect(changeNote({ ...one, new: 8 })).toBe("58 kept, 1 reinitialized, 8 new, 1 removed");
  });

  it("names on the button the PLCs that are changed", () => {
    expect(changeVerb([one], new Set([1]))).toBe("Change line-1");
    expect(changeVerb([one, two], new Set([1, 2]))).toBe("Change all 2 PLCs");
    expect(changeVerb([one, two], new Set([2]))).toBe("Change What-If only");
    expect(changeVerb([refusing, two], new Set([1, 2]))).toBe("Change What-If only");
    expect(changeVerb([one, two, plc(3, "c")], new Set([1, 3]))).toBe("Change 2 of 3 PLCs");
    expect(changeVerb([one, two], new Set())).toBeNull();
    expect(changeVerb([refusing], new Set([1]))).toBeNull();
  });

  it("says in the result what was changed where", () => {
    const note = "58 kept, 1 reinitialized, 1 new, 1 removed";
    expect(builtNote([], 1)).toBe("Built");
    expect(builtNote([one], 1)).toBe(`Built for line-1; variables: ${note}`);
    expect(builtNote([one, two], 2)).toBe(`Built for line-1, What-If; variables: ${note}`);
    expect(builtNote([one, two], 7)).toBe("Built for line-1, What-If");
    expect(builtNote([refusing, two], 1)).toBe("Built for What-If; line-1 not changed: mode RUN");
  });
});
