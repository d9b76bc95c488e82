import { expect, it } from "vitest";
import { readDiagram } from "./diagramRead";
import { boolWires, variablesIn, wireValues } from "./diagramValues";
import { networksIn } from "./networks";

function itemsOf(body: string) {
  const [found] = networksIn(`NETWORK\n${body}\nEND_NETWORK\n`);
  const read = found && readDiagram(found);
  if (read?.kind !== "network") throw new Error(body);
  return read.items;
}

const VALUES: Record<string, string> = { a: "TRUE", b: "FALSE", n: "5", "jam.Q": "TRUE", "jam.ET": "T#20ms", x: "475" };

it.each<[string, string | null]>([
  ["#w = AND(a, NOT b);", "TRUE"],
  ["#w = AND(a, unknown);", null],
  ["#w = OR(a, unknown);", "TRUE"],
  ["#w = XOR(a, a, a);", "TRUE"],
  ["#w = GE(n, 5);", "TRUE"],
  ["#v = LT(n, 5); #w = NOT #v;", "TRUE"],
  ["jam(IN := a, Q => #w);", "TRUE"],
  ["jam(IN := a, NOT Q => #w);", "FALSE"],
  ["jam(IN := a, ET => #w);", "T#20ms"],
  ["#w = ADD(n, 1); x := #w;", "475"],
  // What arithmetic, edges and calls with EN make is computed by the PLC only.
  ["#w = ADD(n, 1);", null],
  ["#w = R_EDGE a;", null],
  ["#w = AND(EN := a, IN1 := a, IN2 := a);", null],
  ["#w = ADD(n, 1); x S= #w;", null],
  ["jam(EN := b, IN := a, Q => #w);", null],
  ["jam(EN := b, IN := a, Q => #w); x := #w;", "475"],
  // The loop has the value of the last evaluation, which is not among the values; where a variable takes it over, it is.
  ["#v = OR(b, #w); #w = AND(#v, a);", null],
  ["#v = OR(b, #w); #w = AND(#v, a); x := #w;", "475"],
  ["#w = n;", "5"],
])("%s gives %s", (body, wanted) => {
  expect(wireValues(itemsOf(body), (name) => VALUES[name] ?? null).get("#W")).toBe(wanted);
});

it("knows which variables it reads, and which wires are BOOL", () => {
  const items = itemsOf("#w = AND(a, n > 5); jam(IN := #w, PT := T#1s, Q => #q); y := ADD(s[1].x, 1); #e = F_EDGE a;");
  expect([...variablesIn(items)].sort()).toEqual(["a", "jam.Q", "s[1].x", "y"]);
  expect([...boolWires(items)]).toEqual(["#W", "#E"]);
});
