import { expect, test } from '../fixtures/test';

test('the list of instances: load, clone, power off and on, export and import', { tag: '@nightly' }, async ({
  openAs,
}) => {
  const ann = await openAs('Ann');
  await ann.runs();
  await ann.watch.set('start', 'TRUE');
  await expect.poll(() => ann.watch.number('Main.parts.total')).toBeGreaterThan(0);
  await ann.top.showInstances();
  const list = ann.instances;

  await test.step('each instance has its state and its load', async () => {
    await expect(list.row('line-1')).toContainText('Running');
    await expect(list.row('line-1')).toContainText(/\d MiB/);
    await expect(list.row('line-1')).toContainText('CJ1M-CPU63');
  });

  await test.step('a clone is a separate PLC', async () => {
    await list.choose('line-1');
    await list.pressAndName('Clone…', 'copy');
    await expect(list.row('copy')).toContainText('Running');
    await list.dialog.getByRole('searchbox').fill('copy');
    await expect(list.row('line-1')).toHaveCount(0);
    await list.dialog.getByRole('searchbox').fill('');
  });

  await test.step('switched off it has no load; switched on it continues where it was', async () => {
    await list.choose('copy');
    await list.press('Switch off');
    await expect(list.row('copy')).toContainText('Off');
    await list.open('copy');
    await expect(ann.banner).toContainText('copy is switched off');
    await ann.banner.getByRole('button', { name: 'Switch on' }).click();
    await ann.runs();
    expect(await ann.watch.number('Main.parts.total')).toBeGreaterThan(0);
  });

  await test.step('after export and import it is the same run', async () => {
    await ann.top.showInstances();
    await list.choose('copy');
    const file = await list.export();
    await list.import(file, 'back');
    await expect(list.row('back')).toBeVisible();
    await list.open('back');
    await expect(ann.top.state).toContainText('Paused');
    await ann.watch.add('Main.parts.total');
    await expect.poll(() => ann.watch.number('Main.parts.total')).toBeGreaterThan(0);
    await ann.top.press('Continue');
    await ann.runs();
  });

  await test.step('a file that is not a run is refused in the dialog, which stays open', async () => {
    await ann.top.showInstances();
    await list.press('Import…');
    const asking = ann.page.getByRole('dialog', { name: 'Import a run' });
    await asking
      .getByLabel('Run file')
      .setInputFiles({ name: 'letter.scanrun', mimeType: 'text/plain', buffer: Buffer.from('Dear Ann') });
    await expect(asking.getByRole('textbox', { name: 'Name' })).toHaveValue('letter');
    await asking.getByRole('button', { name: 'Import', exact: true }).click();
    await expect(asking.getByRole('alert')).toContainText(/run file/);
    await expect(asking.getByRole('textbox', { name: 'Name' })).toHaveValue('letter');
    await asking.getByRole('button', { name: 'Cancel' }).click();
    await expect(asking).toBeHidden();
  });

  await test.step('the menu of a row has the same actions, including limits', async () => {
    await list.row('back').click({ button: 'right' });
    await ann.page.getByRole('menuitem', { name: 'Limits…' }).click();
    const limits = ann.page.getByRole('dialog', { name: 'Limits of back' });
    await expect(limits.getByRole('textbox', { name: 'Run file in MiB' })).toHaveAttribute(
      'placeholder',
      '64 (default)',
    );
    await limits.getByRole('button', { name: 'Cancel' }).click();
    await ann.page.keyboard.press('Escape');
  });

  await test.step('a deleted instance is gone', async () => {
    await ann.top.showInstances();
    await list.delete('back');
    await expect(list.row('copy')).toBeVisible();
  });
});
