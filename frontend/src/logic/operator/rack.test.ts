import { expect, it } from "vitest";
import type { Channel } from "../../wire/types";
import { byUnit } from "./rack";

const channel = (address: string, rack: number | null, slot: number | null, number: number | null = null): Channel => ({
  address,
  side: "input",
  terminals: [],
  unit: { kind: "basic-io-unit", number, rack, slot, name: "" },
});
const free: Channel = { address: "CIO9", side: "output", terminals: [], unit: null };

it("words are in the order of racks and slots, and the words of a unit are together", () => {
  const found = byUnit([
    free,
    channel("CIO5", 1, 0),
    channel("CIO2", 0, 3),
    channel("CIO7", null, null, 4),
    channel("CIO6", 1, 0),
  ]);
  expect(found.map(({ channels }) => channels.map(({ address }) => address))).toEqual([
    ["CIO2"],
    ["CIO5", "CIO6"],
    ["CIO7"],
    ["CIO9"],
  ]);
  expect(found.at(-1)?.unit).toBeNull();
});
