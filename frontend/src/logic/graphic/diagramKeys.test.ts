import { describe, expect, it, test } from "vitest";
import { reordered } from "./diagramEdit";
import { connected, diagramEdit } from "./diagramKeys";
import { layOutDiagram } from "./diagramLayout";
import { readDiagram } from "./diagramRead";
import { type Around, type Box, type Edit, instancesIn, namesIn } from "./edit";
import type { Place } from "./ladderLayout";
import { networksIn } from "./networks";

const box = (name: string, more: Partial<Box>): Box => ({
  ...{ name, kind: "function", type: "", inputs: ["IN1", "IN2"], outputs: [], types: [] },
  ...{ by_position: true, more: true, comment: "" },
  ...more,
});
const BOXES: readonly Box[] = [
  box("AND", {}),
  box("OR", {}),
  box("SUB", { more: false }),
  box("LIMIT", { inputs: ["MN", "IN", "MX"], more: false }),
  box("Twice", { inputs: ["value"], by_position: false, more: false }),
  box("TON", { kind: "block", inputs: ["IN", "PT"], outputs: ["Q", "ET"], by_position: false, more: false }),
];

const network = (...lines: string[]) => `NETWORK\n${lines.map((line) => `    ${line}\n`).join("")}END_NETWORK`;
const linesOf = (text: string) =>
  text
    .split("\n")
    .slice(1, -1)
    .map((line) => line.trim());

function around(text: string, declared = ""): Around {
  return { boxes: [...instancesIn(declared, BOXES), ...BOXES], names: namesIn(text + declared) };
}

/** A key at a place, and what is typed into the fields that open. */
function edited(text: string, key: string, place: Place, typed: readonly string[] = [], declared = ""): Edit {
  const known = around(text, declared);
  let made = diagramEdit(text, key, place, known);
  for (const each of typed) {
    if (!made || !("naming" in made) || !made.naming) throw new Error(`no field for ${each}`);
    made = made.naming.taken(each, known);
  }
  if (!made || "refused" in made) throw new Error(JSON.stringify(made));
  return made;
}

describe("a function block diagram is edited", () => {
  it("from nothing to a motor that holds itself", () => {
    let made = edited(network(), "f", [], ["or"]);
    expect(linesOf(made.text)).toEqual(["#w1 = OR(???, ???);"]);
    expect(made.place).toEqual([0, 0]);
    made = edited(made.text, "F2", made.place, ["start"]);
    made = edited(made.text, "Enter", [0, 1], ["motor"]);
    made = edited(made.text, "f", [0], ["AND"]);
    expect(linesOf(made.text)).toEqual(["#w1 = OR(start, motor);", "#w2 = AND(#w1, ???);"]);
    expect(made.place).toEqual([1, 1]);
    made = edited(made.text, "Enter", made.place, ["stop"]);
    made = edited(made.text, "!", made.place);
    made = edited(made.text, "a", [1], ["motor"]);
    expect(linesOf(made.text)).toEqual(["#w1 = OR(start, motor);", "#w2 = AND(#w1, NOT stop);", "motor := #w2;"]);
  });

  it("by a block, whose instance is declared with it", () => {
    const made = edited(network("late := start;"), "f", [0], ["ton", "wait"]);
    expect(linesOf(made.text)).toEqual(["wait(IN := start, PT := ???, Q => #w1);", "late := #w1;"]);
    expect(made.declares).toEqual([{ name: "wait", type: "TON" }]);
    expect(made.place).toEqual([0, 1]);
    const known = edited(network(), "f", [], ["wait"], "VAR wait : TON; END_VAR");
    expect(linesOf(known.text)).toEqual(["wait(IN := ???, PT := ???);"]);
    expect(edited(network(), "f", [], ["ton"]).naming?.value).toBe("ton1");
  });

  it("by boxes in a wire: at an input, at an output, and after an item", () => {
    const text = network("#a = SUB(x, y); // kept", "z := LIMIT(MN := #a, IN := 5, MX := NOT b);");
    expect(linesOf(edited(text, "f", [1, 0], ["Twice"]).text)).toEqual([
      "#a = SUB(x, y); // kept",
      "#w1 = Twice(value := #a);",
      "z := LIMIT(MN := #w1, IN := 5, MX := NOT b);",
    ]);
    expect(linesOf(edited(text, "f", [1, 2], ["AND"]).text).slice(1)).toEqual([
      "#w1 = AND(b, ???);",
      "z := LIMIT(MN := #a, IN := 5, MX := NOT #w1);",
    ]);
    expect(linesOf(edited(text, "f", [0, 2], ["Twice"]).text)).toEqual([
      "#w1 = SUB(x, y); // kept",
      "#a = Twice(value := #w1);",
      "z := LIMIT(MN := #a, IN := 5, MX := NOT b);",
    ]);
    expect(linesOf(edited(network("z S= AND(a, b);"), "f", [0, 2], ["TON", "t"]).text)).toEqual([
      "#w1 = AND(a, b);",
      "t(IN := #w1, PT := ???, Q => #w2);",
      "z S= #w2;",
    ]);
    expect(linesOf(edited(text, "Shift+F", [0], ["AND"]).text)[1]).toBe("#w1 = AND(EN := ???, IN1 := #a, IN2 := ???);");
  });

  it.each<[string, string, Place, readonly string[], readonly string[]]>([
    ["+", "#a = AND(x, y);", [0], ["z"], ["#a = AND(x, y, z);"]],
    ["+", "#a = AND(IN1 := x, IN2 := y);", [0], ["z"], ["#a = AND(IN1 := x, IN2 := y, IN3 := z);"]],
    ["+", "wait(IN := x);", [0], ["T#1s"], ["wait(IN := x, PT := T#1s);"]],
    ["a", "wait(IN := x);", [0], ["late"], ["wait(IN := x, Q => late);"]],
    ["a", "AND(x, y);", [0], ["late"], ["late := AND(x, y);"]],
    ["a", "#a = AND(x, y);", [0, 1], ["other"], ["#a = AND(x, y);", "other := y;"]],
    ["!", "#a = AND(x, y > 3);", [0, 1], [], ["#a = AND(x, NOT (y > 3));"]],
    ["!", "#a = AND(x, NOT (y > 3));", [0, 1], [], ["#a = AND(x, y > 3);"]],
    ["!", "wait(IN := x, Q => late);", [0, 1], [], ["wait(IN := x, NOT Q => late);"]],
    ["!", "a := b;", [0], [], ["a := NOT b;"]],
    ["e", "#a = AND(x, NOT y);", [0, 1], [], ["#a = AND(x, NOT R_EDGE y);"]],
    ["e", "#a = AND(F_EDGE x, y);", [0, 0], [], ["#a = AND(x, y);"]],
    ["j", "a := b;", [0], ["done"], ["a := b;", "JMP done IF ???;"]],
    ["Shift+J", "a := b;", [0], ["stop"], ["a := b;", "RETURN IF stop;"]],
    ["+", "JMP done;", [0], ["stop"], ["JMP done IF stop;"]],
    ["Delete", "#a = AND(x, y, z);", [0, 1], [], ["#a = AND(x, ???, z);"]],
    ["Delete", "#a = AND(x, ???, z);", [0, 1], [], ["#a = AND(x, z);"]],
    ["Delete", "wait(IN := x, Q => late);", [0, 1], [], ["wait(IN := x);"]],
    ["Delete", "JMP done IF ???;", [0, 0], [], ["JMP done;"]],
    ["Delete", "a := b; // gone with it", [0], [], []],
    ["Enter", "#a = AND(x, y);", [0], ["OR"], ["#a = OR(x, y);"]],
    ["Enter", "a := b;", [0, 1], ["c"], ["c := b;"]],
  ])("%s makes %s at %j", (key, line, place, typed, wanted) => {
    expect(linesOf(edited(network(line), key, place, typed, "VAR wait : TON; END_VAR").text)).toEqual(wanted);
  });

  it("keeps comments, and lines that are written beside each other", () => {
    const text = network("// first", "a := b; c := d; // two", "e := f;");
    expect(linesOf(edited(text, "Delete", [1]).text)).toEqual(["// first", "a := b; // two", "e := f;"]);
    expect(linesOf(edited(text, "Delete", [0]).text)).toEqual(["// first", "c := d; // two", "e := f;"]);
    expect(linesOf(edited(text, "Alt+ArrowDown", [1]).text)).toEqual(["// first", "a := b; e := f; // two", "c := d;"]);
    expect(linesOf(edited(text, "a", [0], ["x : INT"]).text)).toEqual([
      "// first",
      "a := b;",
      "x := a; c := d; // two",
      "e := f;",
    ]);
  });

  it("and declares a variable with its name", () => {
    expect(edited(network("a := ???;"), "Enter", [0], ["speed : INT"])).toMatchObject({
      declares: [{ name: "speed", type: "INT" }],
      text: network("a := speed;"),
    });
  });

  it("but takes nothing that is not one thing in its place", () => {
    const text = network("#a = AND(x, y);");
    for (const typed of ["", "x, z", "x); b := (c", "x;", "(", "// x"]) {
      const made = diagramEdit(text, "Enter", [0, 0], around(text));
      if (!made || !("naming" in made)) throw new Error();
      expect(made.naming?.taken(typed, around(text)), typed).toBeNull();
    }
    const made = diagramEdit(text, "f", [0], around(text));
    if (!made || !("naming" in made)) throw new Error();
    for (const typed of ["Unknown", "", "a b"]) expect(made.naming?.taken(typed, around(text)), typed).toBeNull();
    expect(diagramEdit(text, "!", [0], around(text))).toEqual({ refused: "graphic.refused.pin" });
    expect(diagramEdit(network("#a = SUB(x, y);"), "+", [0], around(""))).toEqual({ refused: "graphic.refused.input" });
    expect(diagramEdit("NETWORK\n  a := ;\nEND_NETWORK", "f", [0], around(""))).toEqual({
      refused: "graphic.refused.unread",
    });
    expect(diagramEdit(text, "z", [0], around(text))).toBeNull();
  });

  it("connects an output to an input", () => {
    const text = network("#a = AND(x, y);", "wait(IN := NOT z, PT := T#1s);", "b := ???;");
    const known = around(text, "VAR wait : TON; END_VAR");
    const one = connected(text, [0, 2], [1, 0], known);
    expect(one && "text" in one && linesOf(one.text)[1]).toBe("wait(IN := NOT #a, PT := T#1s);");
    const other = connected(text, [1], [2, 0], known);
    expect(other && "text" in other && linesOf(other.text).slice(1)).toEqual([
      "wait(IN := NOT z, PT := T#1s, Q => #w1);",
      "b := #w1;",
    ]);
  });
});

describe("a box that is put in", () => {
  const LINES = ["#a = OR(x, y);", "#b = AND(#a, z);", "#c = SUB(#a, #b);", "out := LIMIT(#a, #b, #c);"];
  const order = (text: string) => {
    const [found] = networksIn(text);
    const read = found && readDiagram(found);
    if (read?.kind !== "network") throw new Error(text);
    return layOutDiagram(read.items).elements.map(({ element, x, y }) => ({
      name: element.item.outputs[0]?.target,
      x,
      y,
    }));
  };
  it.each([[[0]], [[1, 0]], [[2, 2]], [[3, 1]], [[3]]] as Place[][])("at %j moves no other past another", (place) => {
    const before = order(network(...LINES));
    const made = edited(network(...LINES), "f", place, ["AND"]);
    const after = order(made.text);
    const kept = after.filter(({ name }) => name !== "#w1");
    const names = (all: typeof before) =>
      all.map(({ name }) => name).filter((name) => before.some((each) => each.name === name));
    if (!(place[0] === 2 && place[1] === 2)) expect(names(kept)).toEqual(names(before));
    // In each pair what was above or left of the other is so still.
    for (const a of before)
      for (const b of before) {
        const [c, d] = [kept.find(({ name }) => name === a.name), kept.find(({ name }) => name === b.name)];
        if (!c || !d || place[1] === 2) continue;
        if (a.x === b.x && a.y < b.y && c.x === d.x) expect(c.y).toBeLessThan(d.y);
        if (a.x < b.x) expect(c.x).toBeLessThan(d.x);
      }
  });
});

test("a line that is dragged to a different place changes the order of those between, and no more", () => {
  const text = "NETWORK\n    a := 1; // one\n    b := 2;\n    c := 3;\n    d := 4;\nEND_NETWORK";
  expect(reordered(text, 0, 2)).toBe("NETWORK\n    b := 2; // one\n    c := 3;\n    a := 1;\n    d := 4;\nEND_NETWORK");
  expect(reordered(reordered(text, 0, 2), 2, 0)).toBe(text);
});
