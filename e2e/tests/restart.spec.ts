import { expect, test } from '../fixtures/test';

test('a warm restart keeps the retained memory, a cold one clears it', { tag: '@nightly' }, async ({ openAs }) => {
  const ann = await openAs('Ann');
  await ann.runs();
  for (const address of ['D500', 'W500']) {
    await ann.watch.add(address);
    await ann.watch.set(address, '4711');
    await ann.watch.shows(address, /4711|1267/);
  }
  const scan = await ann.top.scan();

  await test.step('warm: D is kept, W is not, and the scan count continues', async () => {
    await ann.top.restart('Warm restart');
    await ann.watch.shows('W500', /^(16#0+|0)$/);
    await ann.watch.shows('D500', /4711|1267/);
    await ann.top.scansGoOn(scan);
  });

  await test.step('power cycle: D is kept, as in the device', async () => {
    await ann.top.restart('Power cycle');
    await expect(ann.timeline.mark(/[Pp]ower/).first()).toBeVisible();
    await ann.watch.shows('D500', /4711|1267/);
  });

  await test.step('cold: everything is initialized', async () => {
    await ann.top.restart('Cold restart');
    await ann.watch.shows('D500', /^(16#0+|0)$/);
    await ann.runs();
  });
});

test('a new run begins at scan 0 with an empty timeline, after confirmation', { tag: '@nightly' }, async ({
  openAs,
}) => {
  const ann = await openAs('Ann');
  await ann.runs();
  await ann.watch.set('start', 'TRUE');
  await expect(ann.timeline.mark(/Write: .*start/)).toBeVisible();

  await ann.top.restart('New run…');
  const dialog = ann.page.getByRole('dialog', { name: 'New run' });
  await expect(dialog).toContainText('scan 0');
  await dialog.getByRole('button', { name: 'Cancel' }).click();
  await ann.watch.shows('start', 'TRUE');

  await ann.top.scansGoOn(300);
  await ann.top.restart('New run…');
  await dialog.getByRole('button', { name: 'Begin a new run' }).click();
  await expect(dialog).toBeHidden();
  await expect(ann.timeline.mark(/Write: /)).toHaveCount(0);
  await ann.watch.shows('start', 'FALSE');
  await expect.poll(() => ann.top.scan()).toBeLessThan(300);
});

test('in RUN tools may only read, and the page says so', { tag: '@nightly' }, async ({ openAs }) => {
  const ann = await openAs('Ann');
  await ann.runs();
  await ann.top.chooseMode('RUN');
  await expect(ann.watch.entry('start')).not.toBeEditable();
  await expect(ann.watch.entry('start')).toHaveAccessibleDescription(/In mode RUN tools may only read/);
  await ann.watch.row('start').click({ button: 'right' });
  await expect(ann.page.getByRole('menuitem', { name: /^Force to TRUE/ })).toBeDisabled();
  await ann.page.keyboard.press('Escape');
  await ann.simulator.generate('Battery error');
  await ann.top.chooseMode('MONITOR');
  await ann.watch.set('start', 'TRUE');
  await ann.watch.shows('motor', 'TRUE');
});
