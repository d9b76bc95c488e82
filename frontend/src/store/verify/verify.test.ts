import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { NoConnection } from "../../wire/rest";
import type { VerificationInfo } from "../../wire/types";
import { verify as wire } from "../../wire/verify";
import { drive, fail, onVerifications, resetVerify, setCell, useVerify } from "./verify";

const info = (memory: VerificationInfo["memory"], compared: number): VerificationInfo => ({
  id: 1,
  by: "Ada",
  title: "Belt",
  range: { pou: "Belt", file: "", first: 0, last: 0, instance: "" },
  source: "live",
  trace: "",
  pace: "free",
  auto: false,
  memory,
  state: "verifying",
  message: "",
  instances: [],
  limit: 4096,
  first: 100,
  last: null,
  scan: null,
  compared,
  skipped: 0,
  coverage: null,
  not_run: 0,
  not_reached: 0,
  verdict: "same",
  stretches: [],
  differing: 0,
  first_difference: null,
  first_scan: null,
  rows: 0,
  forgotten: 0,
  used: 0,
  generation: 0,
});

/** An answer that arrives when the test says so. */
function slow(on: "drive" | "setCells"): (answer: VerificationInfo) => void {
  let come: (answer: VerificationInfo) => void = () => {};
  vi.spyOn(wire, on).mockReturnValue(
    new Promise((resolve) => {
      come = resolve;
    }),
  );
  return (answer) => come(answer);
}

beforeEach(() => {
  // The visible rows are not part of this test.
  vi.spyOn(wire, "rows").mockResolvedValue({ columns: [], rows: [], first: 0, count: 0, differing: [] });
  resetVerify();
  onVerifications([info("recorded", 1)]);
});
afterEach(() => vi.restoreAllMocks());

const known = () => useVerify.getState().verifications.map(({ memory, compared }) => [memory, compared]);

it("uses an answer if nothing newer was reported", async () => {
  const answer = slow("drive");
  const driven = drive({ memory: "set" });
  answer(info("set", 1));
  expect(await driven).toBe(true);
  expect(known()).toEqual([["set", 1]]);
});

it("ignores an answer if the socket reported something meanwhile", async () => {
  const answer = slow("drive");
  const driven = drive({ memory: "set" });
  onVerifications([info("set", 7)]);
  answer(info("recorded", 1));
  await driven;
  expect(known()).toEqual([["set", 7]]);
});

it("does the same for edited inputs", async () => {
  onVerifications([info("set", 2)]);
  const answer = slow("setCells");
  const edited = setCell(100, 1, "position", "7");
  onVerifications([info("set", 9)]);
  answer(info("set", 2));
  expect(await edited).toBeNull();
  expect(known()).toEqual([["set", 9]]);
});

it("does not bring back by an answer what was ended meanwhile", async () => {
  const answer = slow("drive");
  const driven = drive({ action: "stop" });
  onVerifications([]);
  answer(info("set", 1));
  await driven;
  expect(known()).toEqual([]);
});

it("says that the connection is lost until the server tells something again, and a refusal until it is put away", () => {
  fail(new NoConnection(true));
  expect(useVerify.getState().trouble?.message).toContain("No connection");
  onVerifications([info("recorded", 2)]);
  expect(useVerify.getState().trouble).toBeNull();
  fail(new Error("There is no scan 7."));
  onVerifications([info("recorded", 3)]);
  expect(useVerify.getState().trouble?.message).toBe("There is no scan 7.");
});
