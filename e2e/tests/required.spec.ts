import { expect, test } from '../fixtures/test';

const BATTERY = 'Battery error';

test('a required reaction is red, the program is corrected, then it is green', {
  tag: '@nightly',
}, async ({ openAs }) => {
  const ann = await openAs('Ann');
  await ann.runs();
  const { simulator } = ann;
  const required = simulator.reaction.getByRole('region', { name: 'Required by the project' });
  const lines = simulator.details.getByRole('textbox', { name: /^What must happen/ });
  const handler = ann.editor('ErrorHandler.st');

  await test.step('the requirement is written where the error is; a wrong name is told there', async () => {
    await simulator.select(BATTERY);
    await simulator.details.getByText('Required reactions', { exact: true }).click();
    await lines.fill('lmp = TRUE within 2 scans\nafter recovery: lamp stays TRUE until reset');
    await expect(simulator.details.getByRole('alert')).toContainText('Did you mean `lamp`?');
    await lines.fill('lamp = TRUE within 2 scans\nafter recovery: lamp stays TRUE until reset');
    await expect(simulator.details.getByRole('alert')).toHaveCount(0);
    await expect(simulator.details).toContainText('Not saved yet');
    await ann.explorer.item('ErrorHandler').click();
    await handler.build();
    await expect(handler.outcome).toContainText('Built for line-1');
  });

  await test.step('it is red, with the values that decided it', async () => {
    await simulator.generate(BATTERY);
    await expect(required.getByRole('listitem').first()).toContainText('Failed');
    await expect(required.getByRole('listitem').first()).toContainText('scan 2: lamp = FALSE');
    await required.getByRole('button', { name: 'lamp = TRUE within 2 scans' }).click();
    await expect(ann.editor('required.reactions').line('battery-error:')).toBeVisible();
    await simulator.recover(BATTERY);
  });

  await test.step('the program is corrected', async () => {
    await ann.explorer.item('Globals.st').click();
    await ann.editor('Globals.st').addBelow('cpuBusError', '  batteryError AT A402.04 : BOOL;');
    await handler.open();
    await handler.line('any := basicIoError').click();
    await ann.page.keyboard.press('End');
    await ann.page.keyboard.press('Shift+Home');
    await ann.page.keyboard.insertText('any := basicIoError OR cpuBusError OR specialIoError OR batteryError;');
    await handler.build();
    await expect(handler.outcome).toContainText('Built for line-1');
  });

  await test.step('and it is green, for the recovery too', async () => {
    await simulator.generate(BATTERY);
    await expect(required.getByRole('listitem')).toHaveCount(2);
    for (const line of await required.getByRole('listitem').all()) await expect(line).toContainText('Passed');
    await expect(required).toContainText('scan 1: lamp = TRUE');
  });
});
