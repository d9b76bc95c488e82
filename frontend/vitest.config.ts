import { defineConfig } from "vitest/config";
import { helpPages } from "./helpPages.ts";

/** In milliseconds; longer than what a test waits for one event (`testing/eventually.ts`), which says what did not happen. */
const LIMIT = 60_000;

export default defineConfig({
  test: {
    projects: [
      // Nothing in `logic/` remembers anything, so its tests need no process each: two thirds of the time of all of them.
      { test: { name: "logic", include: ["src/logic/**/*.test.ts"], environment: "node", isolate: false } },
      {
        plugins: [helpPages],
        test: {
          name: "units",
          include: ["src/**/*.test.ts"],
          exclude: ["src/logic/**"],
          environment: "node",
          testTimeout: LIMIT,
        },
      },
      {
        // Panels in a page: jsdom and React are loaded once. Each test is a project and a PLC of its own, so the page forgets the one before.
        plugins: [helpPages],
        test: {
          name: "panels",
          include: ["src/**/*.test.tsx"],
          environment: "jsdom",
          isolate: false,
          fileParallelism: false,
          setupFiles: ["src/testing/browser.ts", "src/testing/editor.tsx"],
          testTimeout: LIMIT,
        },
      },
    ],
  },
});
