/** The pictures of the README: `make shots` takes them again. */
import { resolve } from 'node:path';
import { filling } from '../fixtures/filling';
import { expect, test } from '../fixtures/test';
import type { Ide } from '../pages/ide';

const FOLDER = resolve(import.meta.dirname, '../../docs/shots');

test('main window, dark: an error is raised and the program has reacted', async ({ openAs }) => {
  const { mika } = await atWork(openAs);
  await raise(mika);
  await take(mika, 'main-dark');
});

test('main window, light', async ({ openAs }) => {
  const { mika } = await atWork(openAs);
  await mika.top.chooseTheme('light');
  await mika.showPanel('History');
  await mika.showPanel('Watch');
  await raise(mika);
  await take(mika, 'main-light');
});

test('halted at a breakpoint, after a step into the block', async ({ openAs }) => {
  const { mika } = await atWork(openAs);
  await mika.debug.clickGutter('Main.st', 'belt(run := motor);');
  await expect(mika.top.state).toContainText('Halted');
  await mika.debug.step('Step into');
  await expect(mika.debug.frames).toHaveCount(2);
  await take(mika, 'halted');
});

test('a fatal error', async ({ openAs }) => {
  const { mika } = await atWork(openAs);
  await mika.simulator.select('Memory error');
  await mika.simulator.choose('Part of the memory', /I\/O table checksum/);
  await mika.simulator.generate('Memory error');
  await expect(mika.banner).toContainText('80F4');
  await expect(mika.simulator.word('A400')).toHaveText('80F4');
  await take(mika, 'fatal');
});

test('the past: the state before the error', async ({ openAs }) => {
  const { mika } = await atWork(openAs);
  await raise(mika);
  await mika.watch.set('start', 'FALSE');
  const raised = mika.timeline.mark(/^Error: /);
  await raised.click();
  await mika.page.getByRole('button', { name: 'Show everybody' }).click();
  await expect(mika.timeline.banner).toBeVisible();
  await take(mika, 'past');
});

test('the list of instances', async ({ openAs }) => {
  const { mika } = await atWork(openAs);
  await mika.top.showInstances();
  await mika.instances.choose('line-1');
  for (const name of ['line-3', 'spare']) await mika.instances.pressAndName('Clone…', name);
  await mika.instances.choose('spare');
  await mika.instances.press('Switch off');
  await expect(mika.instances.row('spare')).toContainText('Off');
  await mika.instances.choose('line-1');
  await take(mika, 'instances');
});

test('ladder with live power: the filling machine, stopped by an I/O unit', async ({ openAs, server }) => {
  const mika = await openAs('Mika Lind', await filling(server));
  const { page, simulator, watch } = mika;
  await mika.top.chooseTheme('dark');
  await mika.runs();
  await watch.set('start', 'TRUE');
  await watch.shows('valve', 'TRUE');
  await mika.explorer.item('Alarms').dblclick();
  await page.getByPlaceholder('Filter by name, code, flag').fill('009A');
  await simulator.box('Basic I/O Unit error, Outputs, Rack number 0, Slot number 1').check();
  await simulator.generateButton.click();
  await watch.shows('lampRed', 'TRUE');
  await expect(simulator.reaction).toContainText('Acted');
  const sheet = page.getByRole('listbox', { name: 'Drawing of Alarms.st' });
  await expect(sheet.locator('.el.on').first()).toBeVisible();
  await take(mika, 'ladder');
});

test('a small window', async ({ openAs }) => {
  const mika = await openAs('Mika');
  await mika.page.setViewportSize({ width: 1024, height: 700 });
  await mika.page.reload();
  await mika.top.chooseTheme('dark');
  await mika.runs();
  await mika.watch.set('start', 'TRUE');
  await raise(mika);
  await take(mika, 'small');
});

/** The belt has run for a while, and two people have the page open. */
async function atWork(openAs: (name: string) => Promise<Ide>): Promise<{ mika: Ide; jo: Ide }> {
  const mika = await openAs('Mika Lind');
  await mika.top.chooseTheme('dark');
  await mika.runs();
  await expect(mika.editor('Main.st').line('PROGRAM Main').first()).toBeVisible();
  const jo = await openAs('Jo Aoki');
  await expect(mika.top.here.getByTitle('Jo Aoki', { exact: true })).toBeVisible();
  await mika.watch.set('start', 'TRUE');
  await expect.poll(() => mika.watch.number('Main.parts.total')).toBeGreaterThan(2);
  return { mika, jo };
}

async function raise(ide: Ide): Promise<void> {
  await ide.simulator.generate('Basic I/O Unit error');
  await ide.watch.shows('lamp', 'TRUE');
  await ide.watch.shows('motor', 'FALSE');
  await expect(ide.simulator.word('A400')).toHaveText('009A');
}

/** The pointer is moved away first, so that no element below it is highlighted. */
async function take(ide: Ide, name: string): Promise<void> {
  await ide.page.mouse.move(0, 0);
  await ide.page.screenshot({ path: resolve(FOLDER, `${name}.png`), animations: 'disabled' });
}
