import { expect, test } from '../fixtures/test';

test('a run continues until a condition holds, or for a number of scans', { tag: '@nightly' }, async ({ openAs }) => {
  const ann = await openAs('Ann');
  await ann.runs();

  await test.step('for an unknown name a similar one is offered', async () => {
    const dialog = await ann.top.askUntil('Main.parts.totl >= 3');
    await expect(dialog.getByRole('alert')).toContainText('totl');
    await dialog.getByRole('button', { name: 'Main.parts.total', exact: true }).click();
    await expect(dialog.getByRole('textbox', { name: 'Condition' })).toHaveValue('Main.parts.total >= 3');
    await dialog.getByRole('button', { name: 'Run', exact: true }).click();
    await expect(dialog).toBeHidden();
  });

  await test.step('the condition is shown during the run, and the run pauses when it holds', async () => {
    await expect(ann.top.state).toContainText('until Main.parts.total >= 3');
    await ann.watch.set('start', 'TRUE');
    await expect(ann.top.state).toContainText('Paused');
    await ann.watch.shows('Main.parts.total', '3');
  });

  await test.step('the condition did not hold one scan earlier', async () => {
    await ann.top.press('Back one scan');
    await ann.watch.shows('Main.parts.total', '2');
    await ann.timeline.returnToLive();
  });

  await test.step('a run of a hundred scans has exactly a hundred scans', async () => {
    const before = await ann.top.scan();
    await ann.top.runScans(100);
    await expect.poll(() => ann.top.scan()).toBe(before + 100);
    await expect(ann.top.state).toContainText('Paused');
  });

  await test.step('a run whose condition may never hold can be stopped', async () => {
    await ann.top.askUntil('Main.parts.total > 30000');
    await ann.timeline.region.getByRole('button', { name: 'Stop' }).click();
    await expect(ann.top.state).toContainText('Paused');
  });
});
