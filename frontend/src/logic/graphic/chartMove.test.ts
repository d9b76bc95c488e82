import { expect, test } from "vitest";
import { droppedInChart } from "./chartMove";
import { pasted } from "./clip";
import { namesIn } from "./edit";
import { textOf } from "./select";
import { Sheet } from "./sheet";

const T = (from: string, to: string, condition = "???") =>
  `TRANSITION FROM ${from} TO ${to} := ${condition}; END_TRANSITION`;
const S = (name: string, ...actions: string[]) =>
  [`STEP ${name}:`, ...actions.map((each) => `    ${each};`), "END_STEP"].join("\n");
const INIT = "INITIAL_STEP Init:\nEND_STEP";
const CHART = [
  ...[INIT, T("Init", "A", "p"), S("A", "x(N)", "y(S)"), T("A", "B", "q"), S("B"), T("B", "C", "r"), S("C", "z(N)")],
  T("C", "Init", "s"),
].join("\n");
/** Places: Init 0, its transition 1, A 2, x 3, y 4, 5, B 6, 7, C 8, z 9, 10. */

function part(body: string) {
  const [found] = new Sheet().of(`PROGRAM P\n${body}\nEND_PROGRAM\n`, 600);
  if (found?.kind !== "chart" || !found.readable) throw new Error(body);
  return found;
}

function dropped(from: number, to: number): string {
  const made = droppedInChart(part(CHART).found, [from], [to]);
  return made === null ? "" : "refused" in made ? made.refused : made.text;
}

function put(place: number, text: string): string {
  const made = pasted(part(CHART), [place], text, { boxes: [], names: namesIn(CHART) });
  return made === null ? "" : "refused" in made ? made.refused : made.text;
}

test("an action goes to the step it is dropped on", () => {
  const made = dropped(4, 8);
  expect(made).toContain(S("A", "x(N)"));
  expect(made).toContain(S("C", "z(N)", "y(S)"));
  expect(dropped(4, 2)).toBe("");
});

test("a step goes after the step or transition it is dropped on, and every condition stays", () => {
  const made = dropped(2, 6);
  expect(made).toBe(
    [
      INIT,
      T("Init", "B", "p"),
      T("A", "C", "q"),
      S("B"),
      S("A", "x(N)", "y(S)"),
      T("B", "A", "r"),
      S("C", "z(N)"),
      T("C", "Init", "s"),
    ].join("\n"),
  );
  expect(dropped(8, 1)).toContain(T("Init", "C", "p"));
  expect(dropped(8, 1)).toContain(T("C", "A", "s"));
  expect(dropped(8, 1)).toContain(T("B", "Init", "r"));
});

test("where a step cannot go it is told, and where it is already nothing changes", () => {
  expect(dropped(0, 6)).toBe("graphic.refused.move");
  expect(dropped(6, 2)).toBe("");
});

test("a transition leads to the step it is dropped on", () => {
  expect(dropped(10, 2)).toContain(T("C", "A", "s"));
});

test("several steps with the transitions between them are copied and put in under new names", () => {
  const copied = textOf(part(CHART), [[2], [3], [4], [5], [6]]);
  expect(copied).toBe([S("A", "x(N)", "y(S)"), T("A", "B", "q"), S("B")].join("\n"));
  const made = put(8, copied);
  expect(made).toContain([S("A1", "x(N)", "y(S)"), T("A1", "B1", "q"), S("B1"), T("C", "A1")].join("\n"));
  expect(made).toContain(T("B1", "Init", "s"));
  expect(part(made).readable).toBe(true);
});

test("steps without a transition between them get one, and several actions go into one step", () => {
  expect(put(10, `${INIT}\n${S("B")}`)).toContain(T("Init1", "B1"));
  expect(put(6, "x(N)\nz(R)")).toContain(S("B", "x(N)", "z(R)"));
  expect(put(6, `${S("K")}\n${T("K", "Elsewhere")}\n${S("L")}`)).toBe("graphic.refused.paste");
});
