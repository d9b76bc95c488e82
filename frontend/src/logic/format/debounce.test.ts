import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { spaced } from "./debounce";

describe("a deed that many reasons call for", () => {
  beforeEach(() => void vi.useFakeTimers());
  afterEach(() => void vi.useRealTimers());

  it("is done once for all reasons of a moment", () => {
    const deed = vi.fn();
    const call = spaced(deed, 150);
    call();
    vi.advanceTimersByTime(100);
    call();
    vi.advanceTimersByTime(1000);
    expect(deed).toHaveBeenCalledTimes(1);
  });

  it("is done although the reasons never end", () => {
    const deed = vi.fn();
    const call = spaced(deed, 150);
    for (let ms = 0; ms < 1500; ms += 50) {
      call();
      vi.advanceTimersByTime(50);
    }
    expect(deed.mock.calls.length).toBeGreaterThan(5);
  });

  it("is not done when it was cancelled", () => {
    const deed = vi.fn();
    const call = spaced(deed, 150);
    call();
    call.cancel();
    vi.advanceTimersByTime(1000);
    expect(deed).not.toHaveBeenCalled();
  });
});
