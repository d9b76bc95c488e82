import { expect, it } from "vitest";
import { differences } from "./versions";

it("tells files that changed, came and went", () => {
  const before = { "a.st": "1", "b.st": "2", "c.st": "3" };
  expect(differences(before, { "b.st": "2", "c.st": "4", "d.st": "" })).toEqual([
    { path: "a.st", before: "1", after: null },
    { path: "c.st", before: "3", after: "4" },
    { path: "d.st", before: null, after: "" },
  ]);
  expect(differences(before, before)).toEqual([]);
});
