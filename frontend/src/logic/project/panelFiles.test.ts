import { expect, test } from "vitest";
import { isPanelFile, panelName, panelPath } from "./panelFiles";

test("a name gives a path, unless it is taken or no name", () => {
  expect(panelPath(" Belt 1 ", [])).toBe("Belt 1.panel.json");
  expect(panelPath("belt", [{ path: "Belt.panel.json" }])).toBeNull();
  for (const name of ["", "a/b", "..", "a:b"]) expect(panelPath(name, [])).toBeNull();
  expect(panelName("line/Belt 1.panel.json")).toBe("Belt 1");
  expect(isPanelFile("Belt.PANEL.json")).toBe(true);
});
