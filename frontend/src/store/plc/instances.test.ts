import { beforeEach, expect, it, vi } from "vitest";
import { rest } from "../../wire/rest";
import { importRun } from "../../wire/transfer";
import type { AppInfo, ImportedInstance } from "../../wire/types";
import { importInstance, showInstances, useInstances } from "./instances";

vi.mock("../../wire/transfer");

const imports = (damage: string) =>
  vi.mocked(importRun).mockResolvedValue({ id: 4, name: "line", damage } as ImportedInstance);
const damaged = () => useInstances.getState().damaged?.damage;

beforeEach(() => {
  vi.spyOn(rest, "instances").mockResolvedValue([]);
  vi.spyOn(rest, "app").mockResolvedValue({ instances: [], projects: [] } as unknown as AppInfo);
});

it("reports the damage of an imported run file, until the next import or until the list is closed", async () => {
  imports("the file is damaged at byte 9");
  await importInstance("line", new File([], "line.scanrun"));
  expect(damaged()).toBe("the file is damaged at byte 9");
  imports("");
  await importInstance("line", new File([], "line.scanrun"));
  expect(damaged()).toBeUndefined();
  imports("the file is damaged at byte 9");
  await importInstance("line", new File([], "line.scanrun"));
  showInstances(false);
  expect(damaged()).toBeUndefined();
});
