import { expect, test } from "vitest";
import { clear } from "./follow";

test("a drawing that is not followed any more shows nothing live", () => {
  document.body.innerHTML = `<svg><g class="el step on"><text data-live="time">T#1s</text><text class="nm">Fill</text></g>
    <g class="el forced closes"><text>a<tspan data-value="a"> TRUE</tspan></text></g><path class="wire on"/></svg>`;
  const svg = document.querySelector("svg");
  if (!svg) throw new Error("no drawing");
  clear(svg);
  expect([...svg.querySelectorAll("g, path")].map((each) => each.getAttribute("class"))).toEqual([
    "el step",
    "el",
    "wire",
  ]);
  expect(svg.textContent?.replace(/\s+/g, " ").trim()).toBe("Fill a");
});
