import { expect, test } from '../fixtures/test';

test('names lead to their declarations, are renamed in all files, and calls show what they expect', {
  tag: '@nightly',
}, async ({ openAs, server }) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const main = mika.editor('Main.st');
  const station = mika.editor('Station.st');
  const { keyboard } = mika.page;
  const { text: before } = await server.get<{ text: string }>(`/projects/${server.project}/files/Main.st`);

  await test.step('what is being typed is understood before it is built', async () => {
    await main.addBelow('uptime := TIME();', '  station.');
    await keyboard.press('Control+Space');
    await expect(main.suggestions).toContainText('hold');
    await keyboard.press('Escape');
    await main.type('hold := LIMIT(');
    await expect(mika.page.locator('.parameter-hints-widget')).toContainText('LIMIT(MN, IN, MX)');
    await keyboard.press('Escape');
    await main.replaceWith(before);
    await keyboard.press('Control+Home');
  });

  await test.step('Ctrl+P goes to a file or to what it declares', async () => {
    await keyboard.press('Control+P');
    const box = mika.page.getByRole('combobox', { name: 'Go to' });
    const offers = mika.page.getByRole('listbox', { name: 'Go to' }).getByRole('option');
    await box.fill('prtcnt');
    await expect(offers).toHaveText([/^PartCounter\.st/, /^PartCounter/]);
    await box.fill('nothing of this');
    await expect(mika.page.getByText('Nothing in this project')).toBeVisible();
    await box.fill('partst');
    await expect(mika.page.getByRole('option', { name: /partsTotal/ })).toBeVisible();
    await box.press('Enter');
    await expect(mika.editor('Globals.st').line('partsTotal').first()).toBeVisible();
    await keyboard.press('Control+P');
    await box.fill('prtcnt');
    await expect(offers).toHaveCount(2);
    await box.press('ArrowDown'); // the first one is chosen already
    await expect(mika.page.getByRole('listbox', { name: 'Go to' }).getByRole('option', { selected: true })).toHaveText(
      'PartCounterPartCounter.st',
    );
    await box.press('Enter');
    await expect(mika.statusBar).toContainText('Col 16');
    await main.open();
    await keyboard.press('Control+Home');
  });

  await test.step('F12 goes to a declaration in another file', async () => {
    await main.caretAfter('station : Station;');
    await keyboard.press('ArrowLeft');
    await keyboard.press('F12');
    await expect(station.line('FUNCTION_BLOCK Station')).toBeVisible();
    await expect(mika.statusBar).toContainText('Ln 2,');
  });

  await test.step('Ctrl+. changes a name to the one that was meant', async () => {
    await main.open();
    await main.replaceWith(before.replace('motor := station.run;', 'motor := station.runn;'));
    await keyboard.press('Control+Home');
    await main.caretAfter('motor := station.runn;');
    await expect(main.squiggles).toHaveCount(1);
    await keyboard.press('ArrowLeft');
    await keyboard.press('Control+.');
    await mika.page.getByText('Change to run').click();
    await expect(main.line('motor := station.run;')).toBeVisible();
  });

  await test.step('Shift+Alt+F formats', async () => {
    await main.replaceWith(before.replace('  motor := station.run;', 'motor:=station.run ;'));
    await keyboard.press('Control+Home');
    await main.caretAfter('motor:=station.run ;');
    await keyboard.press('Shift+Alt+F');
    await expect(main.line('motor := station.run;')).toBeVisible();
    await keyboard.press('Control+Home');
  });

  await test.step('F2 renames an output in both files, also in the one that is closed', async () => {
    await mika.page.getByTestId('close:Station.st').click();
    await expect(station.region).toBeHidden();
    await main.open();
    await main.caretAfter('motor := station.run;');
    await keyboard.press('ArrowLeft');
    await keyboard.press('F2');
    const box = mika.page.getByRole('textbox', { name: /Rename input/ });
    await expect(box).toHaveValue('run');
    await box.fill('turning');
    await keyboard.press('Enter');
    await expect(main.line('motor := station.turning;')).toBeVisible();
    await main.save();
    await station.open();
    await station.save();
    await main.open();
    await main.build();
    await expect(main.outcome).toContainText('Built');
  });

  await test.step('after a reload the same tab is in front', async () => {
    await expect(station.tab).toBeVisible();
    await mika.page.reload();
    await mika.runs();
    await expect(station.tab).toBeVisible();
    await expect(main.region).toBeVisible();
  });
});
