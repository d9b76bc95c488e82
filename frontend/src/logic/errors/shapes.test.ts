import { describe, expect, it } from "vitest";
import { isPlain, plainShape, readShape, type ShapeForm, scansOf } from "./shapes";

const form = (over: Partial<ShapeForm>): ShapeForm => ({ ...plainShape, ...over });

describe("the shape of a fault", () => {
  it("is by default an ordinary Generate: now, and permanent", () => {
    expect(isPlain(plainShape)).toBe(true);
    expect(isPlain(form({ how: "for" }))).toBe(false);
    expect(isPlain(form({ when: "line" }))).toBe(false);
    expect(readShape(plainShape)).toEqual({
      start: { kind: "now", scan: null, condition: "", file: "", line: 0 },
      shape: { kind: "stay", scans: 1, period: 2, times: null, seed: null, acknowledge: "", per_million: 1000 },
      troubles: {},
    });
  });

  it("begins at a future scan", () => {
    expect(readShape(form({ when: "scan", scan: "1 500" }), 1000).start.scan).toBe(1500);
    expect(readShape(form({ when: "scan", scan: "900" }), 1000).troubles).toEqual({ scan: "shape.bad.past" });
    expect(readShape(form({ when: "scan", scan: "soon" }), 1000).troubles).toEqual({ scan: "shape.bad.scan" });
  });

  it("begins when a condition holds, or at a line", () => {
    expect(readShape(form({ when: "condition", condition: " Main.n > 3 " })).start.condition).toBe("Main.n > 3");
    expect(readShape(form({ when: "condition" })).troubles).toEqual({ condition: "run.noexpression" });
    expect(readShape(form({ when: "line", place: "blocks/FB_Belt.st:29" })).start).toMatchObject({
      file: "blocks/FB_Belt.st",
      line: 29,
    });
    expect(readShape(form({ when: "line", place: "FB_Belt.st" })).troubles).toEqual({ place: "shape.bad.place" });
  });

  it("continues as the visible fields say; hidden fields are not checked", () => {
    expect(readShape(form({ how: "for", scans: "5", period: "x", times: "y" }))).toMatchObject({
      shape: { kind: "for", scans: 5 },
      troubles: {},
    });
    const often = form({ how: "intermittent", scans: "10", period: "100", times: "3", chance: true, seed: "7" });
    expect(readShape(often).shape).toMatchObject({ scans: 10, period: 100, times: 3, seed: 7 });
    expect(readShape(form({ how: "intermittent", times: "" })).shape).toMatchObject({ times: null, seed: null });
    expect(readShape(form({ how: "chatter", times: "4" })).shape).toMatchObject({ kind: "chatter", times: 4 });
    const gone = form({ how: "unacknowledged", scans: "3", acknowledge: "reset" });
    expect(readShape(gone).shape).toMatchObject({ scans: 3, acknowledge: "reset" });
  });

  it("comes by chance, with a probability in each scan", () => {
    const chance = form({ how: "chance", percent: "0.5", scans: "3", seed: "7" });
    expect(readShape(chance)).toMatchObject({
      shape: { kind: "chance", per_million: 5000, scans: 3, times: null, seed: 7 },
      troubles: {},
    });
    expect(readShape(form({ how: "chance", percent: "100" })).shape.per_million).toBe(1_000_000);
    for (const percent of ["", "0", "101", "x", "0.00001"])
      expect(readShape(form({ how: "chance", percent })).troubles).toEqual({ percent: "shape.bad.percent" });
  });

  it("names the field that is wrong", () => {
    expect(readShape(form({ how: "for", scans: "0" })).troubles).toEqual({ scans: "shape.bad.count" });
    expect(readShape(form({ how: "intermittent", scans: "10", period: "10" })).troubles).toEqual({
      period: "shape.bad.period",
    });
    expect(readShape(form({ how: "unacknowledged" })).troubles).toEqual({ acknowledge: "run.noexpression" });
    expect(readShape(form({ how: "chatter", times: "-1" })).troubles).toEqual({ times: "shape.bad.count" });
  });

  it("converts milliseconds to scans", () => {
    expect(scansOf(100, 10_000_000)).toBe(10);
    expect(scansOf(1, 10_000_000)).toBe(1);
  });
});
