import { afterEach, expect, it, vi } from "vitest";
import { rest } from "../../wire/rest";
import type { InstanceState, PlcSymbol } from "../../wire/types";
import { isAway, loadMembers, resetMembers, useMembers } from "./members";
import { resetPlc, usePlc } from "./plc";

afterEach(resetPlc);

it("asks no PLC that waits for disk space without a process, but asks one that has a process", () => {
  const waiting = { state: "no_space", pid: null } as InstanceState;
  usePlc.setState({ state: waiting });
  expect(isAway()).toBe(true);
  usePlc.setState({ state: { ...waiting, pid: 7 } });
  expect(isAway()).toBe(false);
});

it("drops the answer about a program that was replaced meanwhile, and asks for the members of the new one", async () => {
  const inProgram = (version: number) =>
    usePlc.setState({ state: { state: "running", program_version: version } as InstanceState });
  const answers: ((symbols: PlcSymbol[]) => void)[] = [];
  vi.spyOn(rest, "symbols").mockImplementation(() => new Promise((answer) => answers.push(answer)));
  resetMembers(1);
  inProgram(1);
  const old = loadMembers("Main");
  inProgram(2);
  answers[0]?.([{ name: "old" } as PlcSymbol]);
  await old;
  expect(useMembers.getState().of.has("Main")).toBe(false);
  const now = loadMembers("Main");
  answers[1]?.([{ name: "err" } as PlcSymbol]);
  await now;
  expect(useMembers.getState().of.get("Main")?.[0]?.name).toBe("err");
});
