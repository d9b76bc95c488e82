import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { Command } from "../../wire/types";
import { useBench } from "../plc/bench";
import { setClock } from "../plc/clock";

const wire = vi.hoisted(() => ({
  sent: [] as string[],
  answers: [] as ((ok: boolean, scan?: number) => void)[],
}));

vi.mock("../../wire/send", () => ({
  send: (command: Command) => {
    const { type, path, value, down } = command as Record<string, unknown>;
    wire.sent.push([type, path, value ?? down].join(" "));
    return new Promise((resolve) => {
      wire.answers.push((ok, scan = 0) => resolve({ ok, message: ok ? "" : "not now", scan, sent: true }));
    });
  },
}));

const { operate, press, release, useRefused } = await import("./operate");

const answer = async (ok = true, scan = 0) => {
  wire.answers.shift()?.(ok, scan);
  await vi.advanceTimersByTimeAsync(0);
};
const laterScan = async (scan: number) => {
  setClock(scan, 0);
  await vi.advanceTimersByTimeAsync(100);
};

beforeEach(() => {
  vi.useFakeTimers();
  vi.stubGlobal("requestAnimationFrame", () => 0);
  useBench.setState({ instance: { id: 1 } as never });
  wire.sent = [];
  wire.answers = [];
});

afterEach(() => vi.useRealTimers());

test("of the values that come while a write is under way the last one counts, for the variable that it was meant for", async () => {
  void operate("a", "speed", "1");
  void operate("a", "speed", "2");
  void operate("a", "level", "3");
  expect(wire.sent).toEqual(["write speed 1"]);
  await answer();
  expect(wire.sent).toEqual(["write speed 1", "write level 3"]);
  await answer(false);
  expect(useRefused.getState().of.get("a")).toBe("not now");
  void operate("a", "level", "4");
  await answer();
  expect(useRefused.getState().of.has("a")).toBe(false);
});

test("what waits for a PLC that was left is not written to the next one", async () => {
  void operate("b", "speed", "1");
  void operate("b", "speed", "2");
  useBench.setState({ instance: { id: 2 } as never });
  await answer(false);
  expect(wire.sent).toEqual(["write speed 1"]);
});

test("a short press is let go only after a scan has seen it", async () => {
  setClock(100, 0);
  void press("c", "start");
  release("start");
  await answer(true, 101);
  await laterScan(101);
  expect(wire.sent).toEqual(["press start true"]);
  await laterScan(102);
  expect(wire.sent).toEqual(["press start true", "press start false"]);
  await answer();
});

test("a press that was refused holds nothing", async () => {
  void press("d", "stop");
  await answer(false);
  release("stop");
  expect(wire.sent).toEqual(["press stop true"]);
  expect(useRefused.getState().of.get("d")).toBe("not now");
});
