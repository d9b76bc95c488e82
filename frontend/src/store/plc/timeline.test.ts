import { afterEach, expect, test, vi } from "vitest";
import type { InstanceState } from "../../wire/types";
import { resetPlc, usePlc } from "./plc";
import { travel, useTimeline } from "./timeline";

const { send } = vi.hoisted(() => ({ send: vi.fn() }));
vi.mock("../../wire/send", () => ({ send }));

const past = (scan: number) => ({ state: "running", scan, past: { live_scan: 500 } }) as unknown as InstanceState;

afterEach(() => {
  resetPlc();
  useTimeline.setState({ aim: null, refused: null });
});

test("the playhead stays at the target until the state arrives, though the answer came first", async () => {
  usePlc.setState({ state: past(82) });
  send.mockResolvedValue({ ok: true, message: "" });
  await travel(81);
  expect(useTimeline.getState().aim).toBe(81);
  usePlc.setState({ state: past(81) });
  expect(useTimeline.getState().aim).toBeNull();
});

test("a state that came before the answer is enough, and a refusal leaves the playhead where it was", async () => {
  send.mockImplementation(() => {
    usePlc.setState({ state: past(81) });
    return Promise.resolve({ ok: true, message: "" });
  });
  await travel(81);
  expect(useTimeline.getState().aim).toBeNull();
  send.mockResolvedValue({ ok: false, message: "there is no scan 9999" });
  await travel(9999);
  expect(useTimeline.getState()).toMatchObject({ aim: null, refused: "there is no scan 9999" });
});
