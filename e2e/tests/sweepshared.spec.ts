import { expect, test } from '../fixtures/test';

test.use({ ownServer: true });

test('everybody shares a sweep: a colleague sees it, one cancels it, the other resumes it; it survives a killed server', {
  tag: '@nightly',
}, async ({ openAs, server }) => {
  const ann = await openAs('Ann');
  const ben = await openAs('Ben');
  await ann.runs();
  await ben.runs();

  await test.step('Ben sees Ann’s sweep in his list', async () => {
    await ben.sweeps.showList();
    await expect(ben.sweeps.pane).toContainText('No sweep yet');
    await ann.sweeps.run({ errors: 'Non-fatal only', scans: 10_000 });
    await expect(ann.sweeps.pane).toContainText(/now: /);
    const line = ben.sweeps.list.locator('[data-sweep]').first();
    await expect(line).toContainText('Ann');
    await expect(line).toContainText(/Running, \d+ %/);
    await expect(ben.statusBar).toContainText(/Sweep \d+ %/);
  });

  await test.step('Ben cancels it; its results stay', async () => {
    await ben.sweeps.open(0);
    await expect.poll(async () => Number(await ben.sweeps.progress.getAttribute('aria-valuenow'))).toBeGreaterThan(0);
    await ben.sweeps.press('Cancel');
    await expect(ben.sweeps.pane).toContainText('Cancelled');
    await expect(ann.sweeps.pane).toContainText('Cancelled');
    await expect(ann.sweeps.pane).toContainText('Not run');
  });

  await test.step('Ann resumes it, and the server is killed while it runs', async () => {
    await ann.sweeps.press('Resume');
    await expect(ann.sweeps.pane.getByRole('button', { name: 'Cancel', exact: true })).toBeVisible();
    await server.kill();
    await server.startAgain();
    await expect(ann.sweeps.pane).toContainText('Interrupted');
  });

  await test.step('resumed again, it is completed for both', async () => {
    await ann.sweeps.press('Resume');
    await ann.sweeps.finishes();
    await ben.sweeps.finishes();
    await expect(await ben.sweeps.cell('Battery error', 'At the start')).toContainText('Never read');
  });
});
