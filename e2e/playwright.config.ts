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

/** Pages of Chromium's own that it loads beside each window, and that no story sees: a fifth of what opening a window takes. The last
 * list counts, so that of Playwright is here, too, as far as it concerns a page of one server. */
const WITHOUT = [
  'WebUIOmniboxPopup',
  'WebUIOmniboxAimPopup',
  'DestroyProfileOnBrowserClose',
  'HttpsUpgrades',
  'MediaRouter',
  'NetworkTimeServiceQuerying',
  'OptimizationHints',
  'PaintHolding',
  'PreconnectToSearch',
  'ThirdPartyStoragePartitioning',
];

export default defineConfig({
  outputDir: 'test-results',
  // Only what hangs takes so long, also on a machine with a load of 10: no story asserts on time.
  timeout: 600_000,
  expect: { timeout: 60_000 },
  // Every worker starts a server of its own; two are what a small machine carries. No story needs another one: both end together.
  workers: 2,
  fullyParallel: true,
  retries: 0,
  forbidOnly: true,
  reporter: [['list'], ['./failures.ts']],
  use: {
    browserName: 'chromium',
    headless: true,
    viewport: { width: 1440, height: 900 },
    locale: 'en-GB',
    // A trace of every story costs as much as the stories: `npx playwright test --trace on tests/NAME.spec.ts` has one.
    trace: 'off',
    screenshot: 'only-on-failure',
    // Nothing asserts on motion, and drawing it takes a third of what a browser without a graphics card computes.
    contextOptions: { reducedMotion: 'reduce' },
    launchOptions: { executablePath: chromium(), args: ['--disable-gpu', `--disable-features=${WITHOUT}`] },
  },
  projects: [
    { name: 'stories', testDir: 'tests' },
    { name: 'shots', testDir: 'shots' },
  ],
});
