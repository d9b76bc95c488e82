import { describe, expect, it } from "vitest";
import { type RerunForm, readRerun } from "./rerun";

const FORM: RerunForm = { name: " again ", how: "same", instead: "", way: "earlier", by: "1", scansAfter: "0" };
// No fields beyond those of the request: the server refuses unknown ones.
const OF = { scan: 100, error: "battery-error", how: "same" };
const read = (part: Partial<RerunForm>, first = 0) => readRerun({ ...FORM, ...part }, OF, first);

describe("a replay with a change", () => {
  it("moves the error", () => {
    const wanted = { name: "again", scan: 100, error: "battery-error", instead: "", leave_out: false, scans_after: 0 };
    expect(read({})).toEqual({ wanted: { ...wanted, by: -1 } });
    expect(read({ way: "later", by: "1 000" })).toEqual({ wanted: { ...wanted, by: 1000 } });
  });

  it("raises a different error, or none, without a shift", () => {
    expect(read({ how: "instead", instead: "io-bus", way: "same" })).toMatchObject({
      wanted: { instead: "io-bus", by: 0, leave_out: false },
    });
    expect(read({ how: "out", by: "nonsense" })).toMatchObject({ wanted: { leave_out: true, by: 0, instead: "" } });
  });

  it("says what is missing", () => {
    expect(read({ name: "  " })).toEqual({ trouble: "name.missing" });
    expect(read({ by: "-1" })).toEqual({ trouble: "rerun.number" });
    expect(read({ by: "1.5" })).toEqual({ trouble: "rerun.number" });
    expect(read({ scansAfter: "2000000" })).toEqual({ trouble: "rerun.number" });
    expect(read({ way: "same" })).toEqual({ trouble: "rerun.nochange" });
    expect(read({ by: "0" })).toEqual({ trouble: "rerun.nochange" });
    expect(read({ how: "instead" })).toEqual({ trouble: "rerun.noerror" });
  });

  it("refuses a scan before the beginning of the run", () => {
    expect(read({ by: "51" }, 50)).toEqual({ trouble: "rerun.toosoon" });
    expect(read({ by: "50" }, 50)).toMatchObject({ wanted: { by: -50 } });
  });
});
