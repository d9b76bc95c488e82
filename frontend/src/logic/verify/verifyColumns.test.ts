import { describe, expect, it } from "vitest";
import type { VerifyColumn } from "../../wire/types";
import {
  arranged,
  heldAcross,
  inOrder,
  moved,
  movedTo,
  plainArrangement,
  toggled,
  tracksInSight,
  tracksOf,
  unitsOf,
  wholeWidth,
} from "./verifyColumns";

const column = (name: string, output: boolean, input: boolean): VerifyColumn => ({
  name,
  type: "INT",
  kind: "int",
  size: 2,
  values: [],
  output,
  input,
});

const units = unitsOf([
  column("speed", true, true),
  column("run", true, false),
  column("target", false, true),
  column("sensor", false, true),
]);
const keys = (all: readonly { key: string }[]) => all.map(({ key }) => key);
const PLAIN = { instances: false, steps: false };

describe("columns", () => {
  it("are outputs, then inputs, in the order of use; a variable can be both", () => {
    expect(keys(units)).toEqual(["output:speed", "output:run", "input:speed", "input:target", "input:sensor"]);
  });

  it("are moved within their side, and keep their place when others are added", () => {
    const other = moved(units, plainArrangement, "input:sensor", -1);
    expect(keys(inOrder(units, other)).slice(2)).toEqual(["input:speed", "input:sensor", "input:target"]);
    const more = unitsOf([
      column("speed", true, true),
      column("run", true, false),
      column("target", false, true),
      column("edge", false, true),
      column("sensor", false, true),
    ]);
    expect(keys(inOrder(more, other)).slice(2)).toEqual(["input:speed", "input:sensor", "input:target", "input:edge"]);
  });

  it("keep outputs and inputs apart", () => {
    const dragged = movedTo(units, plainArrangement, "output:speed", "input:sensor");
    expect(keys(inOrder(units, dragged))).toEqual([
      "output:run",
      "output:speed",
      "input:speed",
      "input:target",
      "input:sensor",
    ]);
    expect(moved(units, plainArrangement, "output:speed", -1)).toBe(plainArrangement);
  });

  it("are skipped when they are hidden", () => {
    const hidden = { ...plainArrangement, hidden: toggled([], "input:target") };
    expect(keys(arranged(units, hidden))).not.toContain("input:target");
    const next = moved(units, hidden, "input:sensor", -1);
    expect(keys(arranged(units, next)).slice(2)).toEqual(["input:sensor", "input:speed"]);
    expect(toggled(hidden.hidden, "input:target")).toEqual([]);
  });
});

describe("tracks", () => {
  it("are two for an output; pinned ones stay visible on the left", () => {
    const pinned = ["input:target"];
    const tracks = tracksOf(arranged(units, { ...plainArrangement, pinned }), pinned, { instances: true, steps: true });
    expect(keys(tracks)).toEqual([
      "mark",
      "scan",
      "call",
      "input:target",
      "instance",
      "place",
      "output:speed:A",
      "output:speed:A'",
      "output:run:A",
      "output:run:A'",
      "input:speed",
      "input:sensor",
      "from",
      "disturbance",
      "note",
    ]);
    expect(keys(tracks.filter(({ sticky }) => sticky))).toEqual(["mark", "scan", "call", "input:target"]);
    tracks.forEach((track, at) => {
      expect(track.left).toBe(tracks.slice(0, at).reduce((sum, { width }) => sum + width, 0));
    });
    expect(wholeWidth(tracks)).toBe((tracks.at(-1)?.left ?? 0) + (tracks.at(-1)?.width ?? 0));
  });

  it("have room for the whole number of a scan", () => {
    const scan = (scanLength?: number) =>
      tracksOf([], [], { ...PLAIN, ...(scanLength ? { scanLength } : {}) })[1]?.width;
    expect(scan("9,999".length)).toBe(scan());
    expect(scan("1,450,432,069".length)).toBeGreaterThanOrEqual(18 + 13 * 7.3);
  });

  it("keep the visible part in place when columns are inserted before it", () => {
    const of = (count: number) =>
      tracksOf(
        unitsOf([...[...Array(count)].map((_, at) => column(`out${at}`, true, false)), column("in", false, true)]),
        [],
        PLAIN,
      );
    const [before, now] = [of(3), of(9)];
    const place = (tracks: typeof before, key: string) => tracks.find((track) => track.key === key)?.left ?? Number.NaN;
    const scrolled = place(before, "input:in") - 154;
    expect(place(now, "input:in") - heldAcross(before, now, scrolled)).toBe(154);
    expect(place(now, "input:in") - heldAcross(before, now, scrolled + 10)).toBe(144);
    expect(heldAcross(before, now, 0)).toBe(0);
    expect(heldAcross(before, tracksOf([], [], PLAIN), 40)).toBe(40);
  });

  it("are drawn only within the window, plus those that stay visible", () => {
    const many = unitsOf([...Array(300)].map((_, at) => column(`v${at}`, true, false)));
    const tracks = tracksOf(many, [], PLAIN);
    const drawn = tracksInSight(tracks, 20_000, 800, 0);
    expect(drawn.length).toBeLessThan(20);
    expect(keys(drawn).slice(0, 3)).toEqual(["mark", "scan", "call"]);
    for (const { left, width, sticky } of drawn) {
      if (!sticky) expect(left + width >= 20_000 && left <= 20_800).toBe(true);
    }
  });
});
