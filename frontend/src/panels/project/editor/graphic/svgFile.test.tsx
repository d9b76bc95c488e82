import { expect, test } from "vitest";
import { Sheet } from "../../../../logic/graphic/sheet";
import { svgFile } from "./svgFile";

const TEXT = `PROGRAM P
RUNG "A < B & C"
    // the motor
    [a] (b)
END_RUNG
NETWORK
    #w = AND(a, NOT b);
    x := #w;
END_NETWORK
RUNG "broken"
    [a
END_RUNG
END_PROGRAM
PROGRAM Q
INITIAL_STEP Wait: END_STEP
TRANSITION FROM Wait TO Wait := n > 3; END_TRANSITION
END_PROGRAM
`;

test("a file of a ladder, a network and a chart is one SVG, with the text of what cannot be read", () => {
  const parts = new Sheet().of(TEXT, 600);
  const written = svgFile(parts, ({ found, kind }) => found.head.title || kind);
  const read = new DOMParser().parseFromString(written, "image/svg+xml");
  expect(read.querySelector("parsererror")).toBeNull();
  const texts = [...read.querySelectorAll("text")].map(({ textContent }) => textContent);
  for (const each of ["A < B & C", "the motor", "a", "AND", "#w", "broken", "    [a", "chart", "Wait", "n > 3"])
    expect(texts).toContain(each);
  expect(read.querySelectorAll("svg svg")).toHaveLength(3);
  // Parts are one below the other.
  const tops = [...read.querySelectorAll("svg svg")].map((each) => [
    Number(each.getAttribute("y")),
    Number(each.getAttribute("height")),
  ]);
  for (const [index, [top = 0, height = 0]] of tops.entries()) {
    const [next] = tops[index + 1] ?? [Number(read.documentElement.getAttribute("height"))];
    expect(top + height).toBeLessThanOrEqual(next ?? 0);
  }
  expect(written).not.toContain("var(--");
  expect(read.querySelectorAll("[role], [id], .hit, [data-element]")).toHaveLength(0);
  expect(document.querySelectorAll("[data-theme=light]")).toHaveLength(0);
});
