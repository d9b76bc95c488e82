import { expect, test } from '../fixtures/test';

test('everybody goes back in time, sees the old values, and returns to live', { tag: '@nightly' }, async ({
  openAs,
}) => {
  const ann = await openAs('Ann');
  const bob = await openAs('Bob');
  await ann.runs();
  await ann.watch.set('start', 'TRUE');
  await ann.watch.shows('motor', 'TRUE');
  await expect.poll(() => ann.watch.number('Main.parts.total')).toBeGreaterThan(1);

  await test.step('a click on the mark of the write leads to its scan, after a question as Bob goes along', async () => {
    await ann.timeline.mark(/Write: .*start/).click();
    await ann.page.getByRole('button', { name: 'Show everybody' }).click();
    await expect(ann.timeline.banner).toContainText(/Scan .* the past, shown by Ann/);
    await expect(ann.top.state).toContainText('In the past');
    await ann.watch.shows('start', 'TRUE');
    await ann.watch.shows('Main.parts.total', '0');
  });

  const written = await ann.timeline.position();

  await test.step('one scan earlier the variable was not written yet; the other browser shows the past, too', async () => {
    await ann.timeline.goTo(written - 1);
    await ann.watch.shows('start', 'FALSE');
    await ann.watch.shows('motor', 'FALSE');
    await expect(bob.timeline.banner).toContainText('shown by Ann');
    await bob.watch.shows('start', 'FALSE');
    await expect.poll(() => bob.timeline.position()).toBe(written - 1);
  });

  await test.step('keys and buttons go scan by scan, and from mark to mark', async () => {
    await ann.timeline.axis.focus();
    await ann.page.keyboard.press('ArrowRight');
    await ann.watch.shows('start', 'TRUE');
    await ann.top.press('Back one scan');
    await ann.watch.shows('start', 'FALSE');
    await ann.top.press('Forward one scan');
    await ann.watch.shows('start', 'TRUE');
  });

  await test.step('the past cannot be changed, and the page says so', async () => {
    await expect(ann.watch.entry('start')).not.toBeEditable();
    await expect(ann.watch.entry('start')).toHaveAccessibleDescription(/the past/);
    await expect(ann.top.mode('RUN')).toBeDisabled();
    await ann.simulator.select('Battery error');
    await expect(ann.page.getByRole('button', { name: 'Generate', exact: true })).toBeDisabled();
  });

  await test.step('the live PLC continues where it was', async () => {
    await bob.timeline.returnToLive();
    await expect(ann.timeline.banner).toBeHidden();
    await ann.runs();
    await expect.poll(() => ann.watch.number('Main.parts.total')).toBeGreaterThan(1);
  });
});

test('close marks can be enlarged, and the run shows where it was stopped', { tag: '@nightly' }, async ({ openAs }) => {
  const ann = await openAs('Ann');
  await ann.runs();
  for (const mode of ['PROGRAM', 'MONITOR', 'RUN', 'MONITOR'] as const) await ann.top.chooseMode(mode);
  await ann.top.scansGoOn(400);

  await test.step('a group of marks zooms in, then opens a list', async () => {
    const group = ann.timeline.mark(/^\d+ marks, .*Mode \d/);
    await expect(group).toHaveCount(1);
    const list = ann.page.getByRole('menu', { name: 'Marks' });
    await expect(async () => {
      await group.first().click({ timeout: 1000 });
      await expect(list).toBeVisible({ timeout: 500 });
    }).toPass();
    await list.getByRole('menuitem', { name: /mode PROGRAM/ }).click();
    await expect(ann.timeline.banner).toBeVisible();
  });

  await test.step('a message about a wrong scan stays until a different scan is shown', async () => {
    const box = ann.timeline.region.getByRole('textbox', { name: 'Go to scan' });
    await box.fill('1.5');
    await box.press('Enter');
    await expect(ann.timeline.region.getByRole('alert')).toContainText('Scan 0 to');
    await ann.top.press('Back one scan');
    await expect(ann.timeline.region.getByRole('alert')).toHaveCount(0);
    await box.fill('0:01');
    await box.press('Enter');
    await expect.poll(() => ann.timeline.position()).toBeGreaterThan(95);
    expect(await ann.timeline.position()).toBeLessThan(105);
  });
});

test('a branch begins with the state of a past scan, and runs on its own', { tag: '@nightly' }, async ({ openAs }) => {
  const ann = await openAs('Ann');
  await ann.runs();
  await ann.watch.set('start', 'TRUE');
  await expect.poll(() => ann.watch.number('Main.parts.total')).toBeGreaterThan(1);
  await ann.timeline.mark(/Write: .*start/).click();
  await expect(ann.timeline.banner).toBeVisible();
  const before = (await ann.timeline.position()) - 1;
  await ann.timeline.goTo(before);
  await ann.watch.shows('start', 'FALSE');

  await test.step('the branch is paused at its first scan, without later commands', async () => {
    await ann.timeline.branch('what-if');
    await expect(ann.top.picker).toContainText('what-if');
    await expect(ann.top.state).toContainText('Paused');
    await expect.poll(() => ann.top.scan()).toBe(before);
    await ann.watch.shows('start', 'FALSE');
    await expect(ann.timeline.mark(/Write: /)).toHaveCount(0);
  });

  await test.step('it runs on its own', async () => {
    await ann.top.press('Continue');
    await ann.top.scansGoOn(before);
    await ann.watch.shows('motor', 'FALSE');
  });

  await test.step('the original PLC still shows the past', async () => {
    await ann.top.goTo(/Conveyor \/ line-1/i);
    await expect(ann.timeline.banner).toContainText('shown by Ann');
    await ann.timeline.returnToLive();
    await ann.watch.shows('start', 'TRUE');
    await ann.runs();
  });
});
