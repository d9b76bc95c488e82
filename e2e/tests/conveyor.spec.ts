import { expect, test } from '../fixtures/test';

const ERROR = 'Basic I/O Unit error';

test('the sample runs, reacts to an input and to an error, and two people see the same', async ({ openAs }) => {
  const mika = await openAs('Mika');

  await test.step('the sample runs when the address is opened', async () => {
    await mika.runs();
    await expect(mika.top.picker).toContainText('Conveyor / line-1');
    await expect(mika.editor('Main.st').line('PROGRAM Main').first()).toBeVisible();
  });

  await test.step('a watched value changes by itself', async () => {
    await mika.watch.add('Main.heartbeat');
    await mika.watch.shows('Main.heartbeat', 'TRUE');
    await mika.watch.shows('Main.heartbeat', 'FALSE');
    await mika.watch.shows('Main.heartbeat', 'TRUE');
  });

  await test.step('start is written, the motor follows', async () => {
    await mika.watch.shows('motor', 'FALSE');
    await mika.watch.set('start', 'TRUE');
    await mika.watch.shows('motor', 'TRUE');
    await expect.poll(() => mika.watch.number('Main.parts.total')).toBeGreaterThan(0);
  });

  await test.step('the error appears in flag, code and program, and in the history', async () => {
    await mika.simulator.generate(ERROR);
    await expect(mika.simulator.outcome).toContainText(`Generated ${ERROR} (Rack`);
    await expect(mika.simulator.outcome).toContainText('code 009A');
    await mika.watch.shows('A402.12', 'TRUE');
    await mika.watch.shows('A400', /009A$/);
    await expect(mika.simulator.word('A400')).toHaveText('009A');
    await mika.watch.shows('lamp', 'TRUE');
    await mika.watch.shows('motor', 'FALSE');
    await mika.showPanel('History');
    await expect(mika.history(ERROR)).toContainText(['Generated']);
    await expect(mika.history(ERROR)).toContainText(['Mika']);
  });

  const jo = await openAs('Jo');
  await test.step('a second person sees the same values and the same history', async () => {
    await jo.runs();
    await jo.watch.shows('A402.12', 'TRUE');
    await jo.watch.shows('A400', /009A$/);
    await jo.watch.shows('lamp', 'TRUE');
    await jo.watch.shows('motor', 'FALSE');
    await jo.showPanel('History');
    await expect(jo.history(ERROR)).toContainText(['Generated']);
    await expect(jo.history(ERROR)).toContainText(['Mika']);
    await expect(mika.top.here.getByTitle('Jo', { exact: true })).toBeVisible();
    await expect(jo.top.here.getByTitle('Mika', { exact: true })).toBeVisible();
  });

  await test.step('recovering clears the error; the lamp stays on until somebody acknowledges it', async () => {
    await mika.showPanel('Watch');
    await mika.simulator.recover(ERROR);
    await expect(mika.simulator.outcome).toHaveText(`Recovered ${ERROR}`);
    await mika.watch.shows('A402.12', 'FALSE');
    await expect(mika.simulator.word('A400')).toHaveText('0000');
    await expect(jo.history(ERROR)).toContainText(['Recovered']);
    await jo.showPanel('Watch');
    const before = await mika.top.scan();
    await mika.top.scansGoOn(before);
    await mika.watch.shows('lamp', 'TRUE');
    await mika.watch.set('reset', 'TRUE');
    await mika.watch.shows('lamp', 'FALSE');
    await jo.watch.shows('lamp', 'FALSE');
  });

  await test.step('the other person sees who wrote', async () => {
    await jo.watch.set('reset', 'FALSE');
    await mika.watch.shows('reset', 'FALSE');
    await expect(mika.watch.writtenBy('reset', 'Jo')).toBeVisible();
    await mika.showPanel('Events');
    await expect(mika.page.getByRole('table', { name: 'Events' })).toContainText('Jo');
  });

  await test.step('reloading keeps project, watch list and history', async () => {
    await mika.page.reload();
    await mika.runs();
    await expect(mika.top.picker).toContainText('Conveyor / line-1');
    await mika.showPanel('Watch');
    await expect(mika.watch.row('Main.heartbeat')).toBeVisible();
    await mika.watch.shows('lamp', 'FALSE');
    await mika.showPanel('History');
    await expect(mika.history(ERROR)).toContainText(['Recovered']);
    await expect(mika.history(ERROR)).toContainText(['Mika']);
  });
});
