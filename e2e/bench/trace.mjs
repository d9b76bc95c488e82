/**
 * Measures the frames a second of the trace: 16 signals of a 1 ms task, a window of 10 s (10,000 rows of each), while the view follows and
 * while the wheel moves it. Prints figures; nothing here is a test. `node bench/trace.mjs ADDRESS`, with the address that the server printed.
 */
import { chromium } from '@playwright/test';

const [address] = process.argv.slice(2);
if (!address) {
  console.error('node bench/trace.mjs http://127.0.0.1:8700/?token=...');
  process.exit(2);
}
const { origin, searchParams } = new URL(address);
const SIGNALS = 16;
const SECONDS = 5;
const SOURCE = `PROGRAM Main
VAR n : DINT; x : ARRAY [0..15] OF LREAL; END_VAR
n := n + 1;
${Array.from({ length: SIGNALS }, (_, k) => `x[${k}] := SIN(DINT_TO_LREAL(n) / ${100 + 37 * k}.0) * ${k + 1}.0;`).join('\n')}
END_PROGRAM
CONFIGURATION Plc RESOURCE Cpu ON CJ1M
TASK Fast(INTERVAL := T#1ms, PRIORITY := 1); PROGRAM Main WITH Fast : Main;
END_RESOURCE END_CONFIGURATION
`;

async function ask(method, path, body) {
  const answer = await fetch(`${origin}/api${path}`, {
    method,
    headers: { Authorization: `Bearer ${searchParams.get('token')}`, 'Content-Type': 'application/json' },
    ...(body === undefined ? {} : { body: JSON.stringify(body) }),
  });
  if (!answer.ok) throw new Error(`${method} ${path}: ${answer.status} ${await answer.text()}`);
  return answer.json();
}

const name = `trace bench ${Date.now()}`;
const project = await ask('POST', '/projects', { name, model: 'CJ1M-CPU63' });
await ask('PUT', `/projects/${project.id}/files/Main.st`, { text: SOURCE, version: 0 });
const built = await ask('POST', `/projects/${project.id}/build`, { agreed: true });
if (!built.ok) throw new Error(JSON.stringify(built.problems));
const instance = await ask('POST', '/instances', { project: project.id, name });
await ask('POST', `/instances/${instance.id}/traces`, {
  name: 'bench',
  signals: Array.from({ length: SIGNALS }, (_, k) => `Main.x[${k}]`),
  scans: 60_000,
});

const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium' });
const page = await browser.newPage({ viewport: { width: 1440, height: 900 } });
await page.addInitScript((id) => localStorage.setItem('scanbench.instance', JSON.stringify(id)), instance.id);
await page.goto(address);
await page.getByRole('tab', { name: 'Trace', exact: true }).click();
await page.waitForSelector('.truplot canvas');
await page.waitForTimeout(11_000);

const cdp = await page.context().newCDPSession(page);
// processor time, not wall time: other work on this machine does not count
await cdp.send('Performance.setTimeDomain', { timeDomain: 'threadTicks' }).catch(() => undefined);
await cdp.send('Performance.enable');
const spent = async () => {
  const { metrics } = await cdp.send('Performance.getMetrics');
  return Object.fromEntries(metrics.map(({ name, value }) => [name, value]));
};

/** Frames a second and the longest gap between two frames, while `work` runs. */
async function frames(what, during) {
  const measured = page.evaluate(
    (seconds) =>
      new Promise((resolve) => {
        const gaps = [];
        const begin = performance.now();
        let last = begin;
        const tick = (now) => {
          gaps.push(now - last);
          last = now;
          if (now - begin < seconds * 1000) requestAnimationFrame(tick);
          else {
            gaps.sort((one, other) => one - other);
            resolve({
              rate: (1000 * gaps.length) / (now - begin),
              p99: gaps[Math.floor(gaps.length * 0.99)],
              worst: gaps.at(-1),
            });
          }
        };
        requestAnimationFrame(tick);
      }),
    SECONDS,
  );
  const before = await spent();
  await during();
  const { rate, p99, worst } = await measured;
  const after = await spent();
  const each = (name) => (((after[name] - before[name]) * 1000) / (rate * SECONDS)).toFixed(2);
  console.log(
    `${what}: ${rate.toFixed(1)} frames/s, 99 % of gaps within ${p99.toFixed(1)} ms, the longest ${worst.toFixed(1)} ms;`,
  );
  console.log(`  ${each('TaskDuration')} ms of the main thread a frame, ${each('ScriptDuration')} of it scripts`);
}

const box = await page.locator('.trstack').boundingBox();
const follow = page.getByRole('button', { name: 'Follow' });
// ten seconds: 1,000 scans wide at first, then ten times as wide
for (let width = 1; width < 10; width *= 2)
  await page.getByRole('button', { name: 'Zoom out', exact: true }).first().click();
if ((await follow.getAttribute('aria-pressed')) !== 'true') await follow.click();
await page.waitForTimeout(1500);
await frames('idle page, followed live, 10 s window of 16 signals', async () => undefined);
await page.getByRole('button', { name: 'Stop' }).last().click();
await page.mouse.move(box.x + box.width / 2, box.y + 60);
await frames('moved by the wheel, a redraw in every frame', async () => {
  const end = Date.now() + SECONDS * 1000;
  let turn = 0;
  await page.keyboard.down('Shift');
  while (Date.now() < end) {
    turn += 1;
    await page.mouse.wheel(0, turn % 120 < 60 ? -8 : 8);
  }
  await page.keyboard.up('Shift');
});
await browser.close();
