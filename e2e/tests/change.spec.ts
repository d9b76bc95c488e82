import { expect, test } from '../fixtures/test';

test('an online change lists the reinitialized variables, waits for confirmation, and is rolled back', async ({
  openAs,
}) => {
  const ann = await openAs('Ann');
  await ann.runs();
  await ann.watch.set('start', 'TRUE');
  await expect.poll(() => ann.watch.number('Main.parts.total')).toBeGreaterThan(0);
  const main = ann.editor('Main.st');
  const dialog = ann.page.getByRole('dialog', { name: /^Online change/ });

  const change = async (from: string, to: string) => {
    await main.line(from).first().click();
    await ann.page.keyboard.press('End');
    await ann.page.keyboard.press('Shift+Home');
    await ann.page.keyboard.insertText(to);
    await main.build();
  };

  await test.step('one more variable: nothing is lost, so there is no question', async () => {
    await change('uptime : TIME;', 'uptime    : TIME; shift : INT := 3;');
    await expect(main.outcome).toContainText(/Built for line-1; variables: \d+ kept, 1 new/);
    await ann.watch.add('Main.shift');
    await ann.watch.set('Main.shift', '44');
    await ann.watch.shows('Main.shift', '44');
  });

  await test.step('a different type: the variable would be reinitialized, and nothing happens yet', async () => {
    await change('shift : INT := 3;', 'uptime    : TIME; shift : TIME := T#5s;');
    await expect(dialog.getByRole('row').filter({ hasText: 'Main.shift' })).toContainText('INT');
    await expect(dialog).toContainText(/\d+ kept/);
    await expect(dialog.getByRole('table', { name: 'line-1: Reinitialized' })).toContainText('Main.shift');
    await dialog.getByRole('button', { name: 'Cancel' }).click();
    await expect(dialog).toBeHidden();
    await ann.watch.shows('Main.shift', '44');
  });

  await test.step('confirmed: the new program runs, and the other variables keep their values', async () => {
    const parts = await ann.watch.number('Main.parts.total');
    await main.build();
    await dialog.getByRole('button', { name: 'Change line-1' }).click();
    await expect(main.outcome).toContainText(/Built for line-1; variables: \d+ kept, 1 reinitialized/);
    await ann.watch.shows('Main.shift', 'T#5s');
    expect(await ann.watch.number('Main.parts.total')).toBeGreaterThanOrEqual(parts);
    await ann.runs();
  });

  await test.step('rolled back: the previous program runs again', async () => {
    await main.region.getByRole('button', { name: 'Roll back' }).click();
    await ann.watch.shows('Main.shift', '3');
    await expect(main.region.getByRole('button', { name: 'Roll back' })).toBeHidden();
    await expect(main.outcome).toContainText(/Runs version 2; the text is version 3/);
    await ann.runs();
  });

  await test.step('in RUN it is refused, with the reason', async () => {
    await ann.top.chooseMode('RUN');
    await main.build();
    await expect(dialog).toContainText(/Not changed: .*RUN/);
    await expect(dialog.getByRole('button', { name: /^Change/ })).toHaveCount(0);
    await expect(dialog.getByRole('checkbox', { name: 'Change line-1' })).toBeDisabled();
    await dialog.getByRole('button', { name: 'Close' }).last().click();
    await expect(dialog).toBeHidden();
  });
});

test('with two PLCs the user chooses which to change, and sees which were changed', { tag: '@nightly' }, async ({
  openAs,
}) => {
  const ann = await openAs('Ann');
  await ann.runs();
  await ann.top.showInstances();
  await ann.instances.choose('line-1');
  await ann.instances.pressAndName('Clone…', 'What-If');
  await ann.page.keyboard.press('Escape');
  const main = ann.editor('Main.st');
  const dialog = ann.page.getByRole('dialog', { name: /^Online change/ });
  const box = (name: string) => dialog.getByRole('checkbox', { name: `Change ${name}` });

  await test.step('nothing is lost: no question, and the result names both PLCs', async () => {
    await main.addBelow('uptime : TIME;', 'shift : INT;');
    await main.build();
    await expect(main.outcome).toContainText(/Built for (line-1, What-If|What-If, line-1); variables: \d+ kept, 1 new/);
  });

  await test.step('each PLC can be left out', async () => {
    await main.line('shift : INT;').first().click();
    await ann.page.keyboard.press('End');
    await ann.page.keyboard.press('Shift+Home');
    await ann.page.keyboard.insertText('shift : TIME;');
    await main.build();
    await expect(dialog.getByRole('button', { name: 'Change all 2 PLCs' })).toBeEnabled();
    await box('line-1').uncheck();
    await box('What-If').uncheck();
    await expect(dialog.getByRole('button', { name: 'Change', exact: true })).toBeDisabled();
    await box('What-If').check();
    await dialog.getByRole('button', { name: 'Change What-If only' }).click();
    await expect(main.outcome).toContainText(/Built for What-If; variables: \d+ kept, 1 reinitialized/);
  });

  await test.step('one in RUN is not changed, the other is', async () => {
    await ann.top.chooseMode('RUN');
    await main.build();
    await expect(box('line-1')).toBeDisabled();
    await expect(box('What-If')).toBeChecked();
    await dialog.getByRole('button', { name: 'Change What-If only' }).click();
    await expect(main.outcome).toContainText(/Built for What-If; line-1 not changed: .*RUN/);
  });
});
