import { afterEach, expect, it } from "vitest";
import type { InstanceState } from "../../wire/types";
import { isAway } from "./members";
import { resetPlc, usePlc } from "./plc";

afterEach(resetPlc);

it("asks no PLC that waits for disk space without a process, but asks one that has a process", () => {
  const waiting = { state: "no_space", pid: null } as InstanceState;
  usePlc.setState({ state: waiting });
  expect(isAway()).toBe(true);
  usePlc.setState({ state: { ...waiting, pid: 7 } });
  expect(isAway()).toBe(false);
});
