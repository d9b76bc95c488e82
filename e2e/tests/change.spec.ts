import { expect, test } from '../fixtures/test';

test('an online change lists what begins anew, waits for a yes, and is rolled back', async ({ openAs }) => {
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

  await test.step('a variable more: nothing is lost, so nobody is asked', async () => {
    await change('uptime : TIME;', 'uptime    : TIME; shift : INT := 3;');
    await expect(main.outcome).toContainText('1 anew');
    await ann.watch.add('Main.shift');
    await ann.watch.set('Main.shift', '44');
    await ann.watch.shows('Main.shift', '44');
  });

  await test.step('another type: the variable would begin anew, and nothing happens yet', async () => {
    await change('shift : INT := 3;', 'uptime    : TIME; shift : TIME := T#5s;');
    await expect(dialog.getByRole('row').filter({ hasText: 'Main.shift' })).toContainText('INT');
    await expect(dialog).toContainText(/\d+ kept/);
    await dialog.getByRole('button', { name: 'Cancel' }).click();
    await expect(dialog).toBeHidden();
    await ann.watch.shows('Main.shift', '44');
  });

  await test.step('agreed: it runs, and what was kept goes on', async () => {
    const parts = await ann.watch.number('Main.parts.total');
    await main.build();
    await dialog.getByRole('button', { name: 'Change anyway' }).click();
    await ann.watch.shows('Main.shift', 'T#5s');
    expect(await ann.watch.number('Main.parts.total')).toBeGreaterThanOrEqual(parts);
    await ann.runs();
  });

  await test.step('rolled back: the program of before runs again', async () => {
    await main.region.getByRole('button', { name: 'Roll back' }).click();
    await ann.watch.shows('Main.shift', '3');
    await expect(main.region.getByRole('button', { name: 'Roll back' })).toBeHidden();
    await ann.runs();
  });

  await test.step('in RUN it is refused, with the reason', async () => {
    await ann.top.chooseMode('RUN');
    await main.build();
    await expect(main.outcome.or(dialog).first()).toContainText(/RUN|refused/);
  });
});
