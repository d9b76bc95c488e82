import { expect, test } from '../fixtures/test';

test.use({ ownServer: true });

test('a sweep is everybody’s: a colleague sees it, one cancels, the other goes on; it outlives the server', {
  tag: '@all',
}, async ({ openAs, server }) => {
  const ann = await openAs('Ann');
  const ben = await openAs('Ben');
  await ann.runs();
  await ben.runs();

  await test.step('Ben sees in his list what Ann began', async () => {
    await ben.sweeps.showList();
    await expect(ben.sweeps.pane).toContainText('No sweep yet');
    await ann.sweeps.run({ errors: 'Non-fatal only', scans: 10_000 });
    await expect(ann.sweeps.pane).toContainText(/now: /);
    const line = ben.sweeps.list.locator('[data-sweep]').first();
    await expect(line).toContainText('Ann');
    await expect(line).toContainText(/Running, \d+ %/);
    await expect(ben.statusBar).toContainText(/Sweep \d+ %/);
  });

  await test.step('Ben cancels it; what was found stays', async () => {
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

  await test.step('resumed once more, it comes to its end for both', async () => {
    await ann.sweeps.press('Resume');
    await ann.sweeps.finishes();
    await ben.sweeps.finishes();
    await expect(await ben.sweeps.cell('Battery error', 'Now')).toContainText('Never read');
  });
});
