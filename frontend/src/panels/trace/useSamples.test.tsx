import { act, renderHook } from "@testing-library/react";
import { expect, onTestFinished, test, vi } from "vitest";
import { shownOf, useTraces } from "../../store/trace/traces";
import { openPage } from "../../testing/page";
import { Status } from "../../testing/routes";
import { InSight } from "../../ui/inSight";
import type { TraceInfo } from "../../wire/types";
import { useSamples } from "./useSamples";

const TRACE: TraceInfo = {
  id: 1,
  by: "Mika",
  bytes: 1000,
  definition: { name: "Trace 1", signals: ["Main.n"], every: 1, scans: 1000, trigger: null, repeat: false },
  first: 1,
  end: 100,
  generation: 1,
  hits: 0,
  interval_ns: 10_000_000,
  note: "",
  rows: 99,
  signals: [],
  state: "recording",
  triggered: null,
};

test("no samples are asked for while nobody can see them", async () => {
  const { server } = await openPage((server) => {
    server.on("GET", "/instances/*/traces", () => [TRACE]);
    server.on("GET", "/instances/*/traces/*/samples", () => new Status(503, { message: "later", near: [] }));
  });
  act(() => useTraces.setState({ traces: [TRACE], source: { kind: "trace", id: 1 } }));
  const samples = () => server.asked.filter(({ path }) => path.includes("/samples")).length;
  vi.useFakeTimers();
  onTestFinished(() => void vi.useRealTimers());
  let inSight = false;
  const { rerender, unmount } = renderHook(() => useSamples(shownOf(useTraces.getState())), {
    wrapper: ({ children }) => <InSight value={inSight}>{children}</InSight>,
  });
  await act(() => vi.advanceTimersByTimeAsync(10_000));
  expect(samples()).toBe(0);
  inSight = true;
  rerender();
  await act(() => vi.advanceTimersByTimeAsync(1000));
  expect(samples()).toBeGreaterThan(2);
  unmount();
});
