import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    projects: [
      { test: { name: "units", include: ["src/**/*.test.ts"], environment: "node" } },
      {
        // Panels in a page: jsdom and React are loaded once. Each test is a project and a PLC of its own, so the page forgets the one before.
        test: { name: "panels", include: ["src/**/*.test.tsx"], environment: "jsdom", isolate: false },
      },
    ],
  },
});
