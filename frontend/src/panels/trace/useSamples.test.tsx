import { act, renderHook } from "@testing-library/react";
import { expect, onTestFinished, test, vi } from "vitest";
import { shownOf, useTraces } from "../../store/trace/traces";
import { openPage } from "../../testing/page";
import { Status } from "../../testing/routes";
import { TRACE } from "../../testing/samples";
import { InSight } from "../../ui/inSight";
import { useSamples } from "./useSamples";

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
