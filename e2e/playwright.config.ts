import { existsSync } from 'node:fs';
import { defineConfig } from '@playwright/test';

/** Chromium comes from the system (apt), not from a download: the tests run offline and on any architecture. */
function chromium(): string {
  const candidates = [process.env.CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'];
  const found = candidates.find((path): path is string => path !== undefined && existsSync(path));
  if (found === undefined) {
    throw new Error('no Chromium found: apt-get install chromium, or set CHROMIUM to its path');
  }
  return found;
}

export default defineConfig({
  outputDir: 'test-results',
  // Long enough for a loaded machine with two cores; what is fast enough is asserted in the stories themselves.
  timeout: 240_000,
  expect: { timeout: 20_000 },
  // Every worker starts a server of its own; two are what a small machine carries.
  workers: 2,
  fullyParallel: false,
  // A browser that a loaded machine starved gets a second chance; the report says `flaky`, so that it is not forgotten.
  retries: 1,
  forbidOnly: true,
  reporter: [['list']],
  use: {
    browserName: 'chromium',
    headless: true,
    viewport: { width: 1440, height: 900 },
    locale: 'en-GB',
    // A trace of every story costs as much as the stories; one that failed is told by the trace of its second try.
    trace: 'on-first-retry',
    screenshot: 'only-on-failure',
    // Nothing asserts on motion, and drawing it takes a third of what a browser without a graphics card computes.
    contextOptions: { reducedMotion: 'reduce' },
    launchOptions: { executablePath: chromium(), args: ['--disable-gpu'] },
  },
  projects: [
    { name: 'stories', testDir: 'tests' },
    { name: 'shots', testDir: 'shots' },
  ],
});
