import { expect, test } from '../fixtures/test';
import { toFront } from '../pages/tabs';

test('every error from two states: unhandled ones are found, inspected, accepted, corrected, and compared', {
  tag: '@nightly',
}, async ({ openAs }) => {
  const ann = await openAs('Ann');
  await ann.runs();
  const sweeps = ann.sweeps;

  await test.step('two states are kept: the current one, and one of the past', async () => {
    const before = await ann.top.scan();
    await ann.watch.set('start', 'TRUE');
    await expect.poll(() => ann.watch.number('Main.parts.total')).toBeGreaterThan(0);
    await sweeps.keepState('Running');
    await ann.timeline.goTo(before);
    await ann.timeline.banner.getByRole('button', { name: 'Keep this state…' }).click();
    await sweeps.nameState('Idle');
    await ann.timeline.returnToLive();
  });

  await test.step('the list explains what a sweep is, and has both states', async () => {
    await sweeps.showList();
    await expect(sweeps.pane).toContainText('No sweep yet');
    await expect(sweeps.states.getByRole('row')).toHaveCount(3);
    await expect(sweeps.states.getByRole('row').filter({ hasText: 'Idle' })).toContainText('line-1');
  });

  await test.step('the dialog says how many runs there will be', async () => {
    await sweeps.ask({ errors: 'Non-fatal only', states: [] });
    await expect(sweeps.dialog).toContainText('No state is selected.');
    await expect(sweeps.dialog.getByRole('button', { name: /^Run \d/ })).toBeDisabled();
    await sweeps.dialog.getByRole('checkbox', { name: 'Idle' }).check();
    await sweeps.dialog.getByRole('checkbox', { name: 'Running' }).check();
    await expect(sweeps.dialog.getByRole('status')).toHaveText(/^Errors: \d+, from 2 states\.$/);
    await sweeps.dialog.getByRole('button', { name: 'Cancel' }).click();
  });

  await test.step('the sweep runs, and the PLC keeps running', async () => {
    await sweeps.run({ errors: 'Non-fatal only', states: ['Running', 'Idle'] });
    await expect(sweeps.tab).toHaveAccessibleName(/^Error sweep \d\d:\d\d/);
    await ann.top.scansGoOn();
    await sweeps.finishes();
    const all = Number(await sweeps.progress.getAttribute('aria-valuemax'));
    expect(all % 2).toBe(0);
    await expect(sweeps.progress).toHaveAttribute('aria-valuenow', String(all));
  });

  await test.step('an error without a handler is named; for a handled one the delay is shown', async () => {
    for (const state of ['Running', 'Idle'])
      await expect(await sweeps.cell('Battery error', state)).toContainText('Never read');
    await expect(await sweeps.cell('Basic I/O Unit error', 'Running')).toContainText('1 scan');
    await expect(sweeps.counts.getByRole('button', { name: /^Never read/ })).toBeEnabled();
  });

  await test.step('a cell shows the readers, and leads to their lines', async () => {
    await sweeps.choose('Basic I/O Unit error', 'Running');
    await expect(sweeps.details).toContainText('Acted');
    await expect(sweeps.details.getByRole('listitem').filter({ hasText: /^motor/ })).toContainText('TRUE → FALSE');
    const reader = sweeps.details.getByRole('button', { name: /^ErrorHandler\.st:\d+$/ }).first();
    const line = (await reader.textContent())?.split(':')[1];
    await reader.click();
    await expect(ann.editor('ErrorHandler.st').line('any := basicIoError')).toBeVisible();
    await expect(ann.statusBar).toContainText(`Ln ${line},`);
    await toFront(sweeps.tab);
  });

  await test.step('by keyboard: to the cell, to its actions, and back', async () => {
    await sweeps.choose('Battery error', 'Running');
    await ann.page.keyboard.press('Home');
    await expect(sweeps.details).toContainText('Battery error, while Idle');
    await ann.page.keyboard.press('Enter');
    await expect(sweeps.details.getByRole('button', { name: 'Open this run' })).toBeFocused();
    await ann.page.keyboard.press('Escape');
    await expect(sweeps.matrix).toBeFocused();
  });

  await test.step('a finding is accepted with a reason, which can be withdrawn', async () => {
    await sweeps.choose('PLC Setup error', 'Idle');
    await sweeps.details.getByRole('button', { name: 'Accept…' }).click();
    const dialog = ann.page.getByRole('dialog', { name: /^Accept: PLC Setup error/ });
    await dialog.getByRole('button', { name: 'Accept', exact: true }).click();
    await expect(dialog.getByRole('alert')).toContainText('Enter a reason.');
    await dialog.getByRole('textbox', { name: 'Reason' }).fill('Set up once, at the factory');
    await dialog.getByRole('button', { name: 'Accept', exact: true }).click();
    await expect(sweeps.details).toContainText('Accepted by Ann: Set up once, at the factory');
    await expect(sweeps.counts.getByRole('button', { name: 'Accepted 1' })).toBeVisible();
    await sweeps.details.getByRole('button', { name: 'Withdraw' }).click();
    await expect(sweeps.details.getByRole('button', { name: 'Accept…' })).toBeVisible();
  });

  await test.step('only findings: handled errors are hidden', async () => {
    await sweeps.pane.getByRole('switch', { name: 'Only findings' }).check();
    await expect(sweeps.row('Basic I/O Unit error')).toHaveCount(0);
    await expect(sweeps.row('Battery error')).toBeVisible();
    await sweeps.pane.getByRole('switch', { name: 'Only findings' }).uncheck();
  });

  await test.step('the handler is corrected, the sweep is run again from the same states', async () => {
    await sweeps.narrow();
    await ann.explorer.item('Globals.st').click();
    await ann.editor('Globals.st').addBelow('cpuBusError', '  batteryError AT A402.04 : BOOL;');
    const handler = ann.editor('ErrorHandler.st');
    await handler.open();
    await handler.line('any := basicIoError').click();
    await ann.page.keyboard.press('End');
    await ann.page.keyboard.press('Shift+Home');
    await ann.page.keyboard.insertText('any := basicIoError OR cpuBusError OR specialIoError OR batteryError;');
    await handler.build();
    await expect(handler.outcome).toContainText('Built for line-1');
    await sweeps.run({ errors: 'Non-fatal only', states: ['Running', 'Idle'] });
    await sweeps.finishes();
    await expect(await sweeps.cell('Battery error', 'Running')).toContainText('1 scan');
  });

  await test.step('each sweep has the test record of its own version', async () => {
    await expect(sweeps.record).toHaveAttribute('href', /version=2$/);
    await sweeps.showList();
    await sweeps.open(1);
    const [record] = await Promise.all([ann.page.waitForEvent('popup'), sweeps.record.click()]);
    await expect(record.locator('body')).toContainText('Test record: reaction to PLC errors');
    await record.close();
    await sweeps.showList();
    await sweeps.open(0);
  });

  await test.step('the comparison says better for this error and the same elsewhere', async () => {
    await sweeps.compareWith(0);
    await expect(sweeps.change('Battery error', 'Idle')).toContainText(/Never read.*1 scan.*Better/);
    await expect(sweeps.changes.getByRole('row')).toHaveCount(3);
    await sweeps.pane.getByRole('switch', { name: 'Only changes' }).uncheck();
    await expect(sweeps.change('Basic I/O Unit error', 'Idle')).toContainText('Same');
  });

  await test.step('the run of a cell opens as a separate PLC, paused with the error', async () => {
    await sweeps.showList();
    await sweeps.open(0);
    await sweeps.choose('Basic I/O Unit error', 'Running');
    await sweeps.details.getByRole('button', { name: 'Open this run' }).click();
    await expect(ann.top.picker).toContainText('basic-io-error in Running');
    await expect(ann.top.state).toContainText('Paused');
    await expect(ann.simulator.error('Basic I/O Unit error')).toContainText('Generated');
  });
});
