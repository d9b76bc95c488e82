import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { spaced } from "./debounce";

describe("a debounced call", () => {
  beforeEach(() => void vi.useFakeTimers());
  afterEach(() => void vi.useRealTimers());

  it("runs once for several requests in a short time", () => {
    const deed = vi.fn();
    const call = spaced(deed, 150);
    call();
    vi.advanceTimersByTime(100);
    call();
    vi.advanceTimersByTime(1000);
    expect(deed).toHaveBeenCalledTimes(1);
  });

  it("runs although requests never stop", () => {
    const deed = vi.fn();
    const call = spaced(deed, 150);
    for (let ms = 0; ms < 1500; ms += 50) {
      call();
      vi.advanceTimersByTime(50);
    }
    expect(deed.mock.calls.length).toBeGreaterThan(5);
  });

  it("does not run after it was cancelled", () => {
    const deed = vi.fn();
    const call = spaced(deed, 150);
    call();
    call.cancel();
    vi.advanceTimersByTime(1000);
    expect(deed).not.toHaveBeenCalled();
  });
});
