import { expect, it } from "vitest";
import type { TreeRow } from "../../../ui/Tree";
import { rowsWith } from "./found";

const row = (level: number, name: string): TreeRow => ({ key: name, level, label: name, name });

it("keeps what is found, with the rows that it is in and nothing else", () => {
  const rows = [
    row(0, "Programs"),
    row(1, "Main"),
    row(0, "Instances"),
    row(1, "Main.belt"),
    row(2, "Main.belt.speed"),
    row(2, "Main.belt.run"),
    row(1, "start"),
    row(0, "Memory"),
  ];
  const names = (text: string) => rowsWith(rows, text).map(({ name }) => name);
  expect(names("SPEED")).toEqual(["Instances", "Main.belt", "Main.belt.speed"]);
  expect(names("main")).toEqual(["Programs", "Main", "Instances", "Main.belt", "Main.belt.speed", "Main.belt.run"]);
  expect(names("start")).toEqual(["Instances", "start"]);
  expect(names("memory")).toEqual(["Memory"]);
  expect(names("nothing")).toEqual([]);
  expect(names("  ")).toHaveLength(rows.length);
});
