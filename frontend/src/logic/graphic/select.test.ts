import { describe, expect, it } from "vitest";
import { dropsOf, nearestDrop } from "./drops";
import type { Around } from "./edit";
import type { Place } from "./ladderLayout";
import { between, branched, moved, textOf, without } from "./select";
import { type DrawnPart, type DrawnRung, Sheet } from "./sheet";

const AROUND: Around = { boxes: [], names: new Set() };

function parts(text: string): readonly DrawnPart[] {
  return new Sheet().of(text, 640);
}

function rung(body: string): DrawnRung {
  const [part] = parts(`RUNG\n    ${body}\nEND_RUNG\n`);
  if (part?.kind !== "rung") throw new Error("no rung");
  return part;
}

const bodyOf = (text: string) => text.replace(/\s+/g, " ").replace(/^RUNG | END_RUNG$/g, "");
const textIn = (made: ReturnType<typeof without>) => (made && "text" in made ? bodyOf(made.text) : made);

describe("what lies between two places of a rung", () => {
  const part = rung("[a] < [b] [c] | [d] > [e] (f)");

  it.each<[Place, Place, string]>([
    [[0], [2], "[a] < [b] [c] | [d] > [e]"],
    [[2], [0], "[a] < [b] [c] | [d] > [e]"],
    [[1, 0, 0], [1, 0, 1], "[b] [c]"],
    [[1, 0, 0], [1, 1, 0], "< [b] [c] | [d] >"],
    [[1, 0, 1], [2], "< [b] [c] | [d] > [e]"],
    [[1, 1, 0], [1, 1, 0], "[d]"],
  ])("%j to %j is %s", (from, to, text) => {
    expect(textOf(part, between(part, from, to)).replace(/\s+/g, " ")).toBe(text);
  });
});

describe("a rung without what is chosen", () => {
  it.each<[string, Place[], string]>([
    ["[a] [b] [c] (d)", [[0], [2]], "[b] (d)"],
    [
      "< [a] | [b] > (c)",
      [
        [0, 0, 0],
        [0, 1, 0],
      ],
      "(c)",
    ],
    ["< [a] | [b] > (c)", [[0, 0, 0]], "[b] (c)"],
    ["< [a] | > (c)", [[1]], "< [a] | >"],
    ["[a] < [b] | [c] > (d)", [[1]], "[a] (d)"],
    ["[a] < [b] | [c] > (d)", [[1], [1, 0, 0], [0]], "(d)"],
  ])("%s, %j", (body, places, left) => {
    expect(textIn(without(rung(body), places, AROUND))).toBe(left);
  });

  it("is refused where an edit would lose comments", () => {
    expect(without(rung("[a] // why\n (b)"), [[0]], AROUND)).toEqual({ refused: "graphic.comments" });
  });
});

it("a branch goes around elements beside each other, and only around those", () => {
  expect(textIn(branched(rung("[a] [b] [c] (d)"), [[1], [0]]))).toBe("< [a] [b] | > [c] (d)");
  expect(branched(rung("[a] [b] [c] (d)"), [[0], [2]])).toEqual({ refused: "graphic.refused.move" });
});

describe("elements that are moved", () => {
  const move = (body: string, places: Place[], to: Place) => {
    const part = rung(body);
    const made = moved(part, places, part, to);
    return "target" in made ? [bodyOf(made.target.text), made.target.place] : made;
  };

  it("come after their new place, in their order", () => {
    expect(move("[a] [b] [c] (d)", [[1], [0]], [2])).toEqual(["[c] [a] [b] (d)", [2]]);
    expect(move("[a] [b] [c] (d)", [[2]], [])).toEqual(["[c] [a] [b] (d)", [0]]);
    expect(move("[a] < [b] | [c] > (d)", [[0]], [1, 1, 0])).toEqual(["< [b] | [c] [a] > (d)", [0, 1, 1]]);
    expect(move("[a] < [b] | [c] > (d)", [[1, 1, 0]], [0])).toEqual(["[a] [c] [b] (d)", [1]]);
  });

  it("do not go into themselves, nor after what ends its path", () => {
    expect(move("[a] < [b] | [c] > (d)", [[1]], [1, 0, 0])).toEqual({ refused: "graphic.refused.move" });
    expect(move("[a] (b) JMP there", [[0]], [2])).toEqual({ refused: "graphic.refused.move" });
  });

  it("go to a different rung, too", () => {
    const [from, to] = [rung("[a] [b] (c)"), rung("(d)")];
    const made = moved(from, [[0], [1]], to, []);
    expect("target" in made && [bodyOf(made.target.text), bodyOf(made.source?.text ?? "")]).toEqual([
      "[a] [b] (d)",
      "(c)",
    ]);
  });
});

it("drop points are between all elements, and the nearest one is meant", () => {
  const { drawing } = rung("[a] < [b] | > (c)");
  if (!drawing) throw new Error("not drawn");
  const drops = dropsOf(drawing);
  const places = new Set(drops.map(({ place }) => place.join(".")));
  expect([...places].sort()).toEqual(["", "0", "1", "1.0", "1.0.0", "1.1", "2"]);
  for (const each of drops) expect(nearestDrop([each], each.x + 9, each.y - 9)).toBe(each);
  expect(nearestDrop(drops, -500, 0)).toBeNull();
});

describe("lines of a network and parts of a chart", () => {
  it("are copied and deleted together", () => {
    const [network] = parts("NETWORK\n    #a = AND(x, y);\n    b := #a;\n    c := x;\nEND_NETWORK\n");
    if (!network) throw new Error("no network");
    const all = between(network, [2, 0], [1]);
    expect(textOf(network, all)).toBe("b := #a;\nc := x;");
    const made = without(network, all, AROUND);
    expect(made && "text" in made && made.text).toBe("NETWORK\n    #a = AND(x, y);\nEND_NETWORK");
  });

  it("a step goes with its action, whichever is first", () => {
    const text =
      "INITIAL_STEP A:\nEND_STEP\nSTEP B:\n    x(N);\nEND_STEP\n" +
      "TRANSITION FROM A TO B := x; END_TRANSITION\nTRANSITION FROM B TO A := y; END_TRANSITION\n";
    const [chart] = parts(`PROGRAM Main\n${text}END_PROGRAM\n`);
    if (chart?.kind !== "chart") throw new Error("no chart");
    const place = (kind: string, name: string) =>
      chart.drawing?.elements.find(({ element }) => element.kind === kind && "name" in element && element.name === name)
        ?.place ?? [];
    const action = chart.drawing?.elements.find(({ element }) => element.kind === "action")?.place ?? [];
    const made = without(chart, [place("step", "B"), action], AROUND);
    expect(made && "text" in made && made.text).not.toContain("STEP B");
    expect(without(chart, [place("step", "A")], AROUND)).toEqual({ refused: "graphic.refused.initial" });
  });
});
