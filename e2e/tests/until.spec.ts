import { expect, test } from '../fixtures/test';

test('a run goes on until a condition holds, or for so many scans', { tag: '@all' }, async ({ openAs }) => {
  const ann = await openAs('Ann');
  await ann.runs();

  await test.step('a name that is not known gets the one that comes near', async () => {
    const dialog = await ann.top.askUntil('Main.parts.totl >= 3');
    await expect(dialog.getByRole('alert')).toContainText('totl');
    await dialog.getByRole('button', { name: 'Main.parts.total', exact: true }).click();
    await expect(dialog.getByRole('textbox', { name: 'Condition' })).toHaveValue('Main.parts.total >= 3');
    await dialog.getByRole('button', { name: 'Run', exact: true }).click();
    await expect(dialog).toBeHidden();
  });

  await test.step('while it runs, what it waits for is shown; where it holds, it pauses', async () => {
    await expect(ann.top.state).toContainText('until Main.parts.total >= 3');
    await ann.watch.set('start', 'TRUE');
    await expect(ann.top.state).toContainText('Paused');
    await ann.watch.shows('Main.parts.total', '3');
  });

  await test.step('the scan before, it did not hold', async () => {
    await ann.top.press('Back one scan');
    await ann.watch.shows('Main.parts.total', '2');
    await ann.timeline.returnToLive();
  });

  await test.step('a hundred scans are a hundred scans', async () => {
    const before = await ann.top.scan();
    await ann.top.runScans(100);
    await expect.poll(() => ann.top.scan()).toBe(before + 100);
    await expect(ann.top.state).toContainText('Paused');
  });

  await test.step('what may never hold can be stopped', async () => {
    await ann.top.askUntil('Main.parts.total > 30000');
    await ann.timeline.region.getByRole('button', { name: 'Stop' }).click();
    await expect(ann.top.state).toContainText('Paused');
  });
});
