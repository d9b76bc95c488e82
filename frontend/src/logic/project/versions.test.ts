import { expect, it } from "vitest";
import { commitOf, differences, history, sideOf, sideOfCommit } from "./versions";

it("tells files that changed, came and went", () => {
  const before = { "a.st": "1", "b.st": "2", "c.st": "3" };
  expect(differences(before, { "b.st": "2", "c.st": "4", "d.st": "" })).toEqual([
    { path: "a.st", before: "1", after: null },
    { path: "c.st", before: "3", after: "4" },
    { path: "d.st", before: null, after: "" },
  ]);
  expect(differences(before, before)).toEqual([]);
});

it("puts versions and commits into one list, the last one first", () => {
  const at = (minute: number) => `2026-11-24T10:0${minute}:00+00:00`;
  const listed = history(
    [
      { version: 2, at: at(3) },
      { version: 1, at: at(1) },
    ],
    // of another time zone
    [{ commit: "abc", at: "2026-11-24T12:02:00+02:00" }],
  );
  expect(listed.map(({ side }) => side)).toEqual([2, "git:abc", 1]);
});

it("reads a side back as a list of choices gives it", () => {
  expect(["now", "3", sideOfCommit("12ab")].map(sideOf)).toEqual(["now", 3, "git:12ab"]);
  expect(commitOf(sideOfCommit("12ab"))).toBe("12ab");
});
