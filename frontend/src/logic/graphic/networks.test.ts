import { describe, expect, it } from "vitest";
import { bodiesOf, networksAfter, networksIn } from "./networks";
import { stopIn } from "./places";
import { Sheet } from "./sheet";

const rung = "RUNG\n    [a] (b)\nEND_RUNG\n";
const block = (name: string, body: string) => `FUNCTION_BLOCK ${name}\n${body}END_FUNCTION_BLOCK\n`;

describe("the networks of a body", () => {
  it("are those beside each other, switched off or not, whatever other bodies have", () => {
    const action = `ACTION Fill:\n${rung}END_ACTION\n`;
    const text = block("One", rung) + block("Two", `${rung}{off} ${rung}// a note\n${rung}${action}`);
    expect(bodiesOf(text).map((body) => body.length)).toEqual([1, 3, 1]);
  });
});

describe("the networks after an edit", () => {
  const body = `${rung}{off} ${rung}// a note (* no comment\nNETWORK "N"\n    a := b;\nEND_NETWORK\n${rung}`;
  const whole = block("One", body) + block("Two", `${rung}{off}\n${rung}${rung}`);
  const pieces = [
    "",
    "\n",
    "(*",
    "*)",
    "//",
    "'",
    "END_RUNG",
    "RUNG\n",
    "END_RUNG\n",
    "{off} ",
    "[x]",
    ' "title"',
    "NETWORK\n",
  ];

  it("are those of a text that nobody knew before", () => {
    let seed = 7;
    const below = (most: number) => {
      seed = (seed * 1103515245 + 12345) % 2147483648;
      return seed % most;
    };
    let before = { text: whole, networks: networksIn(whole) };
    for (let round = 0; round < 3000; round += 1) {
      if (round % 40 === 0) before = { text: whole, networks: networksIn(whole) };
      const at = below(before.text.length + 1);
      const end = Math.min(before.text.length, at + (below(3) === 0 ? below(60) : 0));
      const text = before.text.slice(0, at) + (pieces[below(pieces.length)] ?? "") + before.text.slice(end);
      const networks = networksAfter(text, before);
      expect(networks, JSON.stringify([before.text, text])).toEqual(networksIn(text));
      before = { text, networks };
    }
  });
});

describe("a rung whose title has no end yet", () => {
  it("stays in the drawing as it was, with its text", () => {
    const text = 'PROGRAM Main\nRUNG "Half"\n    [go] (on)\nEND_RUNG\nRUNG\n    [on] (q)\nEND_RUNG\nEND_PROGRAM\n';
    const sheet = new Sheet();
    const [before] = sheet.of(text, 640);
    const [half, next, ...others] = sheet.of(text.replace('Half"', "Hal"), 640);
    expect(half).toMatchObject({ readable: false, drawing: before?.drawing, found: { head: { title: "Hal" } } });
    expect(next?.readable).toBe(true);
    expect(others).toEqual([]);
  });
});

describe("the stop at a place of the text", () => {
  const text = "NETWORK\n    #w = AND(a, gone);\n    b := NOT #w;\nEND_NETWORK\n";
  const [part] = new Sheet().of(text, 640);
  const at = (written: string) => {
    const before = text.slice(0, text.indexOf(written)).split("\n");
    return { line: before.length, column: (before.at(-1)?.length ?? 0) + 1 };
  };

  it.each([
    ["gone", [0, 1]],
    ["AND", [0]],
    ["b :=", [1, 1]],
    ["#w;", [1, 0]],
  ])("of %s is its pin, else its box", (written, place) => {
    expect(part && stopIn(part, at(written))).toEqual(place);
  });
});
