/**
 * Measures the drawing of a large ladder: 500 rungs of 12 elements, at 1440 x 900. Prints the main thread's own time (other work on the
 * machine does not count) until it is drawn for the first time, of a second of live power, of an edit and of a second of scrolling, and
 * frames a second, which depend on the machine. Nothing here is a test. `make bench-ui`, or `node bench/drawing.mjs`.
 */
import { cpus, loadavg } from 'node:os';
import { chromium } from '@playwright/test';
import { withServer } from './server.mjs';

const [RUNGS, CONTACTS, SECONDS, EDITS, TURNS] = [500, 11, 5, 20, 3];
/** Of scrolling, in pixels a second. */
const SPEED = 3000;
const NAMES = Array.from({ length: 300 }, (_, index) => `x${index}`);

/** The same numbers each time. */
let seed = 18;
const chance = (below) => {
  seed = (seed * 1103515245 + 12345) % 2147483648;
  return seed % below;
};
const contact = () => `[${chance(10) < 3 ? '/' : ''}${NAMES[chance(NAMES.length)]}]`;
const contacts = (count) => Array.from({ length: count }, contact).join(' ');
const rung = (index) =>
  `RUNG "Rung ${index}"\n    < ${contacts(3)}\n    | ${contacts(3)}\n    > ${contacts(CONTACTS - 6)} (q${index})\nEND_RUNG\n`;
const coils = Array.from({ length: RUNGS }, (_, index) => `q${index}`);
const FILES = {
  'Ladder.st':
    `FUNCTION_BLOCK Ladder\nVAR_INPUT n : UDINT; END_VAR\nVAR ${NAMES.join(', ')} : BOOL; ${coils.join(', ')} : BOOL; END_VAR\n` +
    // A tenth of the contacts changes from scan to scan.
    `RUNG "Changes"\n    [n MOD 2 = 0] ${NAMES.slice(0, 30)
      .map((name) => `(${name})`)
      .join(' ')}\nEND_RUNG\n` +
    `${Array.from({ length: RUNGS - 1 }, (_, index) => rung(index)).join('')}END_FUNCTION_BLOCK\n`,
  'Main.st': `PROGRAM Main
VAR ladder : Ladder; n : UDINT; END_VAR
n := n + 1;
ladder(n := n);
END_PROGRAM
CONFIGURATION Plc RESOURCE Cpu ON CJ1M
TASK Cyclic(INTERVAL := T#50ms, PRIORITY := 1); PROGRAM Main WITH Cyclic : Main;
END_RESOURCE END_CONFIGURATION
`,
};

async function main(address) {
  const instance = await begin(new URL(address));
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium' });
  const page = await browser.newPage({ viewport: { width: 1440, height: 900 } });
  await page.addInitScript((id) => localStorage.setItem('scanbench.instance', JSON.stringify(id)), instance);
  await page.goto(address);
  const cdp = await page.context().newCDPSession(page);
  const spent = await spentBy(cdp);
  const item = page.getByRole('treeitem', { name: /^Ladder/ }).first();
  await item.waitFor();
  // Without the drawing the page is busy, too: that is taken off.
  await page.waitForTimeout(3000);
  const sheet = page.getByRole('listbox', { name: 'Drawing of Ladder.st' });
  const idle = await perSecond(page, spent);
  const first = await spent(async () => {
    await item.dblclick();
    await sheet.getByRole('group').nth(1).waitFor();
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  });
  await page.locator('.el.on').first().waitFor();
  await page.waitForTimeout(3000);
  await page.getByRole('radio', { name: 'Text' }).click();
  await page.waitForTimeout(2000);
  const again = await spent(async () => {
    await page.getByRole('radio', { name: 'Ladder' }).click();
    await sheet.getByRole('group').nth(1).waitFor();
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  });
  await page.waitForTimeout(2000);
  const live = await perSecond(page, spent);
  const scrolled = await scroll(page, cdp, sheet, spent);
  const edit = await edits(page, sheet, browser);
  const plain = await plainScroll(browser);
  const say = (what, value, unit, most = '') =>
    console.log(`${what.padEnd(50)}${value.toFixed(1).padStart(8)} ${unit.padEnd(5)}${most}`);
  console.log(`load of the machine ${loadavg()[0]?.toFixed(1)}, of ${cpus().length} processors`);
  say('first drawing, with all that it loads', first, 'ms');
  say('drawn once more, from text to ladder', again, 'ms', 'at most 150');
  say('a second of the page without a drawing', idle / 10, '%');
  say('a second live, above that', (live - idle) / 10, '%', 'at most 10');
  say('a second of scrolling, live', scrolled.busy / 10, '%');
  say('frames while scrolling', scrolled.rate, '/s', '60 on a quiet machine');
  say('frames while plain text is scrolled', plain.rate, '/s');
  say('of those frames the drawing has', (100 * scrolled.rate) / plain.rate, '%');
  say('a name changed: its network drawn again', edit.network, 'ms', 'at most 5');
  say('the whole way of a key, until the frame with it', edit.drawn, 'ms');
  say('in the quarter of a second after it', edit.after, 'ms');
  await browser.close();
}

/** What measures the ms of processor time of the main thread: what else runs on the machine does not count, as it would in `TaskDuration`. */
async function spentBy(cdp) {
  await cdp.send('Performance.enable');
  const busy = async () => {
    const { metrics } = await cdp.send('Performance.getMetrics');
    return 1000 * (metrics.find(({ name }) => name === 'ThreadTime')?.value ?? Number.NaN);
  };
  return async (work) => {
    const before = await busy();
    await work();
    return (await busy()) - before;
  };
}

/** ms of the main thread in a second. */
async function perSecond(page, spent) {
  return (await spent(() => page.waitForTimeout(SECONDS * 1000))) / SECONDS;
}

/** Scrolls for some seconds, the wheel turned by the browser itself: a round trip for each turn would be measured, too. */
async function scroll(page, cdp, sheet, spent) {
  const box = await sheet.boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  let rate = 0;
  const all = await spent(async () => {
    const frames = page.evaluate(
      (seconds) =>
        new Promise((done) => {
          let count = 0;
          const begin = performance.now();
          const tick = (now) => {
            count += 1;
            if (now - begin < seconds * 1000) requestAnimationFrame(tick);
            else done((1000 * count) / (now - begin));
          };
          requestAnimationFrame(tick);
        }),
      SECONDS,
    );
    const turned = cdp.send('Input.synthesizeScrollGesture', {
      x: box.x + box.width / 2,
      y: box.y + box.height / 2,
      yDistance: -SPEED * SECONDS,
      speed: SPEED,
      gestureSourceType: 'mouse',
    });
    rate = await frames;
    await turned;
  });
  return { busy: all / SECONDS, rate };
}

/** The same over rows of nothing but text, in a window of its own: what this browser on this machine reaches meanwhile. */
async function plainScroll(browser) {
  const page = await browser.newPage({ viewport: { width: 1440, height: 900 } });
  const rows = Array.from({ length: RUNGS }, (_, index) => `<p style="height:120px">Rung ${index}</p>`).join('');
  await page.setContent(`<div id="sheet" style="height:760px;overflow:auto">${rows}</div>`);
  const cdp = await page.context().newCDPSession(page);
  const found = await scroll(page, cdp, page.locator('#sheet'), await spentBy(cdp));
  await page.close();
  return found;
}

/**
 * ms of the main thread for an edit of a rung of 12 elements, live.
 *
 * `key`: the whole way of a key that negates a contact, until the frame with it: the text, what is shared and kept of it, all that looks
 * at it, the drawing, style, layout and paint. `after`: the quarter of a second that follows.
 * `network`: one name changed and its network drawn again, without the text: what taking that name back and forth costs in sight, less
 * what it costs out of sight, where all is done but the drawing.
 */
async function edits(page, sheet, browser) {
  const up = async () => {
    await page.mouse.wheel(0, -1e6);
    await sheet.getByRole('group', { name: /^Rung 2 / }).waitFor();
  };
  await up();
  const contact = sheet
    .getByRole('group', { name: /^Rung 2 / })
    .getByRole('option', { name: /contact/i })
    .first();
  // The first edit of a file marks it as unsaved in the whole page; what follows does not.
  const other = sheet.getByRole('group', { name: /^Rung 3 / });
  await other
    .getByRole('option', { name: /contact/i })
    .first()
    .click();
  await page.keyboard.press('!');
  await contact.click();
  const key = await costs(page, sheet, browser, [{ key: '!' }], 250);
  await contact.click();
  await page.keyboard.press('F2');
  await page.keyboard.press('Control+a');
  await page.keyboard.type('x299');
  await page.keyboard.press('Enter');
  const back = ['z', 'y'].map((letter) => ({ key: letter, ctrlKey: true }));
  const network = [];
  for (let turn = 0; turn < TURNS; turn += 1) {
    await up();
    const inSight = await costs(page, sheet, browser, back, 50);
    await page.mouse.wheel(0, 2e4);
    await sheet.getByRole('group', { name: /^Rung 2 / }).waitFor({ state: 'detached' });
    network.push(inSight.drawn - (await costs(page, sheet, browser, back, 50)).drawn);
  }
  return { ...key, network: middle(network) };
}

/**
 * ms of the main thread until the frame after a key is drawn, and in the `quiet` ms after that, as the text goes to the server and
 * its problems come back. Without what the live page takes meanwhile: each round has a second one without a key. By the thread's own
 * clock, at marks of the page: `Performance.getMetrics` would come too late.
 */
async function costs(page, sheet, browser, keys, quiet) {
  await browser.startTracing(page, { categories: ['blink.user_timing'] });
  for (let round = 0; round < 2 * EDITS; round += 1)
    await sheet.evaluate(
      async (element, [key, quiet]) => {
        await new Promise((done) => requestAnimationFrame(() => setTimeout(done, 100)));
        performance.mark(key ? 'edit' : 'no edit');
        if (key) element.dispatchEvent(new KeyboardEvent('keydown', { ...key, bubbles: true, cancelable: true }));
        await new Promise((done) =>
          requestAnimationFrame(() => {
            // Its turn comes after the frame.
            const after = new MessageChannel();
            after.port1.onmessage = () => done(after.port1.close());
            after.port2.postMessage(null);
          }),
        );
        performance.mark('drawn');
        await new Promise((done) => setTimeout(done, quiet));
        performance.mark('quiet');
      },
      [round % 2 === 0 ? keys[(round / 2) % keys.length] : null, quiet],
    );
  const { traceEvents } = JSON.parse(String(await browser.stopTracing()));
  const marks = traceEvents
    .filter(({ cat, name }) => cat === 'blink.user_timing' && ['edit', 'no edit', 'drawn', 'quiet'].includes(name))
    .sort((a, b) => a.ts - b.ts);
  const between = (begin, from) =>
    middle(marks.flatMap(({ name }, at) => (name === begin ? [marks[at + from + 1].tts - marks[at + from].tts] : []))) /
    1000;
  return { drawn: between('edit', 0) - between('no edit', 0), after: between('edit', 1) - between('no edit', 1) };
}

const middle = (found) => found.sort((a, b) => a - b)[Math.floor(found.length / 2)];

/** A project with the ladder, and a PLC that runs it: its number. */
async function begin({ origin, searchParams }) {
  const ask = async (method, path, body) => {
    const headers = { Authorization: `Bearer ${searchParams.get('token')}`, 'Content-Type': 'application/json' };
    const answer = await fetch(`${origin}/api${path}`, { method, headers, body: body && JSON.stringify(body) });
    if (!answer.ok) throw new Error(`${method} ${path}: ${answer.status} ${await answer.text()}`);
    return answer.json();
  };
  const project = await ask('POST', '/projects', { name: 'Drawing', model: 'CJ1M-CPU63' });
  for (const [path, text] of Object.entries(FILES))
    await ask('PUT', `/projects/${project.id}/files/${path}`, { text, version: 0 });
  const built = await ask('POST', `/projects/${project.id}/build`, { agreed: true });
  if (!built.ok) throw new Error(JSON.stringify(built.problems));
  const { id } = await ask('POST', '/instances', { project: project.id, name: 'Drawing' });
  return id;
}

await withServer('drawing', main);
