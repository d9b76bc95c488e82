import { expect, it } from "vitest";
import type { CampaignTrial } from "../../wire/types";
import { FORM, shownOf, wantedOf } from "./campaign";

it("asks for what was typed, and for the end of the run where no scan was", () => {
  expect(wantedOf(FORM)).toMatchObject({ count: 100, seed: 1, first: null, last: null, window: 100, alarms: [] });
  const typed = { ...FORM, count: "1 000", first: "10", last: "2,500", alarms: " Main.alarm ; Main.state = 9;" };
  expect(wantedOf(typed)).toMatchObject({
    count: 1000,
    first: 10,
    last: 2500,
    alarms: ["Main.alarm", "Main.state = 9"],
  });
  for (const bad of [{ count: "" }, { seed: "-1" }, { last: "x" }, { kinds: [] }]) {
    expect(wantedOf({ ...FORM, ...bad })).toBeNull();
  }
});

it("lists those that ended in one way, or of which an output was wrong unnoticed", () => {
  const trial = (number: number, more: Partial<CampaignTrial>) =>
    ({ number, outcome: "verification", program: [], output_scan: null, ...more }) as CampaignTrial;
  const trials = [trial(1, {}), trial(2, { output_scan: 7 }), trial(3, { output_scan: 7, program: ["stopped"] })];
  const numbers = (shown: Parameters<typeof shownOf>[1]) => shownOf(trials, shown).map(({ number }) => number);
  expect(numbers(null)).toEqual([1, 2, 3]);
  expect(numbers("silent")).toEqual([2]);
  expect(numbers("nothing")).toEqual([]);
});
