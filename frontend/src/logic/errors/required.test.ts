import { expect, test } from "vitest";
import { isSplit, lineOf, requiredOf, withRequired } from "./required";

const FILE = `// what must happen
all: at least decided

battery-error:
  lamp within 3 scans // at once
  after recovery: motor stays FALSE until reset

// the next one
basic-io-error: motor = FALSE
battery-error in Running:
  lamp
`;

test("the lines of an error are those below its name, and what comes after it", () => {
  expect(requiredOf(FILE, "battery-error")).toBe(
    "lamp within 3 scans // at once\nafter recovery: motor stays FALSE until reset",
  );
  expect(requiredOf(FILE, "basic-io-error")).toBe("motor = FALSE");
  expect(requiredOf(FILE, "basic-io")).toBe("");
  expect(lineOf(FILE, "battery-error")).toBe(4);
});

test("new lines take the place of the old ones, and nothing else changes", () => {
  const changed = withRequired(FILE, "battery-error", "lamp\nnever motor\n");
  expect(changed).toBe(FILE.replace(/ {2}lamp within[\s\S]*?until reset/, "  lamp\n  never motor"));
  expect(requiredOf(changed, "battery-error")).toBe("lamp\nnever motor");
});

test("an error without lines is put at the end, one whose lines were deleted goes", () => {
  expect(withRequired("", "battery-error", "lamp")).toBe("battery-error:\n  lamp\n");
  expect(withRequired("all: lamp\n", "battery-error", "lamp")).toBe("all: lamp\n\nbattery-error:\n  lamp\n");
  expect(withRequired("all: lamp\n\nbattery-error:\n  lamp\n", "battery-error", " ")).toBe("all: lamp\n\n");
  expect(withRequired("all: lamp\n", "battery-error", "")).toBe("all: lamp\n");
});

test("a comment in the first column ends no block, and what is below it stays with its error", () => {
  const text =
    "basic-io-error:\n  always lamp\nbattery-error:\n  lamp\n// see the manual\n  motor = FALSE\n// the end\n(* all:\n  lamp *)\nall: lamp\n";
  expect(requiredOf(text, "battery-error")).toBe("lamp\n// see the manual\nmotor = FALSE");
  expect(withRequired(text, "battery-error", "")).toBe(
    "basic-io-error:\n  always lamp\n// the end\n(* all:\n  lamp *)\nall: lamp\n",
  );
});

test("an error with several blocks is known as such", () => {
  expect(isSplit(FILE, "battery-error")).toBe(false);
  expect(isSplit(`${FILE}battery-error:\n  motor\n`, "battery-error")).toBe(true);
  expect(isSplit(`${FILE}// battery-error: motor\n`, "battery-error")).toBe(false);
});
