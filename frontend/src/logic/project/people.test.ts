import { expect, it } from "vitest";
import { isGuest } from "./people";

it("knows who gave no name", () => {
  expect(["Guest", "Guest 12"].filter(isGuest)).toHaveLength(2);
  expect(["Guesthouse", "Guest A", "Mika"].filter(isGuest)).toEqual([]);
});
