/**
 * Measures what opening the page costs: bytes on the wire and time until the first live value, bytes in all once the editor is there,
 * the same at the second visit, and frames and long tasks while values change. Prints figures; nothing here is a test.
 * `make bench-ui`: a server of its own, with the sample.
 */
import { chromium } from '@playwright/test';
import { withServer } from './server.mjs';

const SECONDS = 5;

async function main(address) {
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium' });
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, locale: 'en-GB' });
  const first = await visit(context, address);
  const second = await visit(context, address);
  console.log('                             first visit   second visit   at most');
  line('before the first live value', (each) => kilobytes(each.early), '700 KB');
  line('in all, with the editor', (each) => kilobytes(each.all), '1,600 KB');
  line('time to the first value', (each) => `${Math.round(each.ms)} ms`, '');
  line('frames a second', (each) => each.frames.rate.toFixed(1), '');
  line('longest gap of 99 %', (each) => `${each.frames.p99.toFixed(0)} ms`, '');
  line(
    'tasks over 50 ms',
    (each) => `${each.frames.long.length} (${Math.round(Math.max(0, ...each.frames.long))} ms)`,
    '',
  );
  await browser.close();

  function line(what, of, most) {
    console.log(`${what.padEnd(29)}${of(first).padEnd(14)}${of(second).padEnd(15)}${most}`);
  }
}

const kilobytes = (bytes) => `${Math.round(bytes / 1000).toLocaleString('en')} KB`;

/** One visit in a new tab; the second one finds what the first one left in the browser's cache. */
async function visit(context, address) {
  const page = await context.newPage();
  await page.addInitScript(() => {
    window.longTasks = [];
    new PerformanceObserver((list) => {
      for (const { duration } of list.getEntries()) window.longTasks.push(duration);
    }).observe({ entryTypes: ['longtask'] });
  });
  const cdp = await context.newCDPSession(page);
  await cdp.send('Network.enable');
  let bytes = 0;
  cdp.on('Network.loadingFinished', ({ encodedDataLength }) => {
    bytes += encodedDataLength;
  });
  cdp.on('Network.webSocketFrameReceived', ({ response }) => {
    bytes += response.opcode === 2 ? Math.floor((response.payloadData.length * 3) / 4) : response.payloadData.length;
  });
  const began = performance.now();
  await page.goto(address, { waitUntil: 'commit' });
  await page.getByTestId('current:Main.uptime').filter({ hasText: 'T#' }).waitFor();
  const ms = performance.now() - began;
  const early = bytes;
  await page.locator('.monaco-editor .view-line').first().waitFor();
  await page.waitForLoadState('networkidle').catch(() => undefined);
  const all = bytes;
  const frames = await page.evaluate(
    (seconds) =>
      new Promise((resolve) => {
        window.longTasks.length = 0;
        const gaps = [];
        const begin = performance.now();
        let last = begin;
        const tick = (now) => {
          gaps.push(now - last);
          last = now;
          if (now - begin < seconds * 1000) return requestAnimationFrame(tick);
          gaps.sort((one, other) => one - other);
          const rate = (1000 * gaps.length) / (now - begin);
          resolve({ rate, p99: gaps[Math.floor(gaps.length * 0.99)], long: window.longTasks });
        };
        requestAnimationFrame(tick);
      }),
    SECONDS,
  );
  await page.close();
  return { early, all, ms, frames };
}

await withServer('load', main);
