import { describe, expect, it } from "vitest";
import { chartEdit } from "./chartKeys";
import { partsIn } from "./charts";
import { type Around, type Edit, namesIn } from "./edit";
import type { Place } from "./ladderLayout";

function edited(body: string, key: string, place: Place, typed?: string): Edit {
  const [found] = partsIn(`PROGRAM P\n${body}\nEND_PROGRAM\n`);
  if (!found) throw new Error(body);
  const around: Around = { boxes: [], names: namesIn(body) };
  let made = chartEdit(found, key, place, around);
  if (typed !== undefined) {
    if (!made || !("naming" in made) || !made.naming) throw new Error("no field");
    made = made.naming.taken(typed, around);
  }
  if (!made || "refused" in made) throw new Error(JSON.stringify(made));
  return made;
}

const INIT = "INITIAL_STEP Init:\nEND_STEP";
const T = (from: string, to: string, condition = "???") =>
  `TRANSITION FROM ${from} TO ${to} := ${condition}; END_TRANSITION`;
const S = (name: string) => `STEP ${name}:\nEND_STEP`;
const lines = (...all: string[]) => all.join("\n");

describe("a chart is edited", () => {
  it("with a jump that waits for all sequences that began together", () => {
    const steps = lines(INIT, T("Init", "(A, B)"), S("A"), S("B"));
    expect(edited(steps, "j", [2], "Init").text).toContain(T("(A, B)", "Init"));
    const longer = edited(steps, "s", [3], "C").text;
    expect(edited(longer, "j", [2], "Init").text).toContain(T("(A, C)", "Init"));
    expect(edited(lines(steps, T("B", "Init")), "j", [2], "Init").text).toContain(T("A", "Init"));
  });

  it("from its first step to a loop with a simultaneous branch", () => {
    let made = edited(INIT, "s", [0], "Fill");
    expect(made.text).toBe(lines(INIT, T("Init", "Fill"), S("Fill")));
    expect(made.place).toEqual([2]);
    made = edited(made.text, "F2", [1], "start");
    made = edited(made.text, "j", [2], "init");
    expect(made.text).toBe(lines(INIT, T("Init", "Fill", "start"), S("Fill"), T("Fill", "Init")));
    made = edited(made.text, "F2", made.place, "level >= 80");
    made = edited(made.text, "p", [2], "Heat");
    expect(made.text).toBe(
      lines(INIT, T("Init", "(Fill, Heat)", "start"), S("Fill"), S("Heat"), T("(Fill, Heat)", "Init", "level >= 80")),
    );
    made = edited(made.text, "a", [2], "inlet");
    made = edited(made.text, "a", [2], "lamp(D, T#1s)");
    expect(made.text).toContain("STEP Fill:\n    inlet(N);\n    lamp(D, T#1s);\nEND_STEP");
    made = edited(made.text, "Enter", [3], "inlet(S)");
    expect(made.text).toContain("    inlet(S);\n");
    made = edited(made.text, "s", [2], "Wait");
    expect(made.text).toContain(T("Fill", "Wait"));
    expect(made.text).toContain(T("(Wait, Heat)", "Init", "level >= 80"));
  });

  it("by steps and alternatives at a transition", () => {
    const text = lines(INIT, S("A"), T("Init", "A", "x"), T("A", "Init", "y"));
    expect(edited(text, "s", [2], "B").text).toBe(
      lines(INIT, S("A"), T("Init", "B", "x"), S("B"), T("B", "A"), T("A", "Init", "y")),
    );
    expect(edited(text, "v", [2], "z").text).toBe(
      lines(INIT, S("A"), T("Init", "A", "x"), T("Init", "A", "z"), T("A", "Init", "y")),
    );
    expect(edited(text, "j", [2], "Init").text).toContain(T("Init", "Init", "x"));
  });

  it("by the name of a step, which its references follow", () => {
    const text = lines(
      INIT,
      "STEP Fill:\n    Count(P1);\nEND_STEP",
      T("Init", "Fill", "x"),
      T("Fill", "Init", "fill.T > T#1s AND other.Fill"),
      "ACTION Count:\n    f(Fill := Fill.X); // Fill\nEND_ACTION",
    );
    expect(edited(text, "Enter", [1], "Full").text).toBe(
      lines(
        INIT,
        "STEP Full:\n    Count(P1);\nEND_STEP",
        T("Init", "Full", "x"),
        T("Full", "Init", "Full.T > T#1s AND other.Fill"),
        "ACTION Count:\n    f(Fill := Full.X); // Fill\nEND_ACTION",
      ),
    );
  });

  it.each<[string, string, Place, string]>([
    ["a step", lines(INIT, T("Init", "A", "x"), S("A"), T("A", "Init", "y")), [2], lines(INIT, T("Init", "Init", "x"))],
    ["the last step", lines(INIT, T("Init", "A", "x"), S("A")), [2], INIT],
    [
      "a simultaneous step",
      lines(INIT, T("Init", "(A, B)", "x"), S("A"), S("B"), T("(A, B)", "Init", "y")),
      [3],
      lines(INIT, T("Init", "A", "x"), S("A"), T("A", "Init", "y")),
    ],
    ["a transition", lines(INIT, T("Init", "Init", "x")), [1], INIT],
    ["an action", "INITIAL_STEP Init:\n    a(N);\n    b(S);\nEND_STEP", [1], "INITIAL_STEP Init:\n    b(S);\nEND_STEP"],
  ])("by deleting %s", (_, text, place, wanted) => {
    expect(edited(text, "Delete", place).text).toBe(wanted);
  });

  it("but takes nothing that would be something else", () => {
    const text = lines(INIT, T("Init", "Init", "x"));
    const [found] = partsIn(`PROGRAM P\n${text}\nEND_PROGRAM\n`);
    const around = { boxes: [], names: namesIn(text) };
    const naming = (key: string, place: Place) => {
      const made = found && chartEdit(found, key, place, around);
      return made && "naming" in made ? made.naming : null;
    };
    for (const typed of ["", "a b", "X", "1"]) expect(naming("s", [0])?.taken(typed, around), typed).toBeNull();
    for (const typed of ["", "a; END_TRANSITION", "x; y", "// x"])
      expect(naming("Enter", [1])?.taken(typed, around), typed).toBeNull();
    for (const typed of ["", "Nowhere", "Init,"]) expect(naming("j", [0])?.taken(typed, around), typed).toBeNull();
    for (const typed of ["a(N); b", "a b", "(N)"]) expect(naming("a", [0])?.taken(typed, around), typed).toBeNull();
    expect(found && chartEdit(found, "Delete", [0], around)).toEqual({ refused: "graphic.refused.initial" });
    const half = found && { ...found, text: `${text}\nSTEP` };
    expect(half && chartEdit(half, "s", [0], around)).toEqual({ refused: "graphic.refused.unread" });
  });
});
