import { expect, it } from "vitest";
import { nameAt, placeOf, topicOf } from "./help";

it("finds the name at a caret, in it and at both of its ends", () => {
  const line = "  beat(IN := NOT beat.Q, PT := T#500ms);";
  expect(nameAt(line, 3)).toBe("beat");
  expect(nameAt(line, 5)).toBe("beat");
  expect(nameAt(line, 7)).toBe("beat");
  expect(nameAt(line, 15)).toBe("NOT");
  expect(nameAt(line, 1)).toBeNull();
  expect(nameAt("a := 12;", 7)).toBeNull();
});

it("knows the topic of panels, and of the files among them", () => {
  expect(topicOf("forces")).toBe("watch.md#forces");
  expect(topicOf("file:Belt.st")).toBe("window.md#editor");
  expect(topicOf("file:Belt.panel.json")).toBe("operator-panels.md");
});

it("follows links from the page that they are on", () => {
  expect(placeOf("watch.md", "README.md")).toBe("watch.md");
  expect(placeOf("D001.md", "problems/README.md")).toBe("problems/D001.md");
  expect(placeOf("../watch.md#forces", "problems/README.md")).toBe("watch.md#forces");
  expect(placeOf("#columns", "watch.md")).toBe("watch.md#columns");
  expect(placeOf("../models/FORMAT.md", "virtual-plc.md")).toBe("../models/FORMAT.md");
  expect(placeOf("https://example.com/a.md", "watch.md")).toBeNull();
});
