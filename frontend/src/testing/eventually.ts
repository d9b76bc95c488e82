import { vi } from "vitest";

/** How long tests wait for what has to happen, in milliseconds: a slow machine is no failure. */
export const LIMIT = 20_000;

/** Waits until what is expected holds; fails with the last failure. In a page, `waitFor` and `findBy…` wait as long. */
export const eventually = <T>(expected: () => T | Promise<T>) => vi.waitFor(expected, { timeout: LIMIT });
