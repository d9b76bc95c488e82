import { act, cleanup, render, screen } from "@testing-library/react";
import { afterEach, expect, test, vi } from "vitest";
import { textOf } from "../testing/find";
import { t } from "../text";
import { later } from "./later";

const Clock = ({ hour }: { hour: number }) => <p role="timer">{hour} h</p>;

const pass = (ms: number) => act(() => vi.advanceTimersByTimeAsync(ms));

afterEach(() => {
  cleanup();
  vi.useRealTimers();
});

test("code that cannot be loaded is asked for until it comes, and the page says so meanwhile", async () => {
  vi.useFakeTimers();
  let reachable = false;
  const load = vi.fn(async () => {
    if (!reachable) throw new TypeError("Failed to fetch dynamically imported module");
    return { default: Clock };
  });
  const Later = later(load);
  render(<Later hour={7} />);
  expect(textOf(screen.getByRole("status"))).toBe(t("later.loading"));
  await pass(0);
  expect(textOf(screen.getByRole("status"))).toBe(t("later.failed"));
  for (let attempt = 2; attempt < 6; attempt += 1) {
    await pass(8_000);
    expect(load).toHaveBeenCalledTimes(attempt);
  }
  reachable = true;
  await pass(8_000);
  expect(textOf(screen.getByRole("timer"))).toBe("7 h");
});

test("code that is there is not loaded once more", async () => {
  vi.useFakeTimers();
  const load = vi.fn(async () => ({ default: Clock }));
  const Later = later(load);
  render(<Later hour={7} />);
  await pass(0);
  cleanup();
  render(<Later hour={8} />);
  expect(textOf(screen.getByRole("timer"))).toBe("8 h");
  expect(load).toHaveBeenCalledTimes(1);
});
