import { act, render } from "@testing-library/react";
import { expect, onTestFinished, test, vi } from "vitest";
import { openPage } from "../../../testing/page";
import { Status } from "../../../testing/routes";
import { InSight } from "../../../ui/inSight";
import { CommunicationPage } from "./CommunicationPage";

test("who is connected is not asked for while nobody can see it", async () => {
  const { server } = await openPage((server) => {
    server.on("GET", "/instances/*/communication", () => new Status(503, { message: "later", near: [] }));
  });
  const asked = () => server.asked.filter(({ path }) => path.endsWith("/communication")).length;
  vi.useFakeTimers();
  onTestFinished(() => void vi.useRealTimers());
  const page = (inSight: boolean) => (
    <InSight value={inSight}>
      <CommunicationPage />
    </InSight>
  );
  const { rerender, unmount } = render(page(false));
  await act(() => vi.advanceTimersByTimeAsync(10_000));
  expect(asked()).toBe(1);
  rerender(page(true));
  await act(() => vi.advanceTimersByTimeAsync(3000));
  expect(asked()).toBeGreaterThan(2);
  unmount();
});
