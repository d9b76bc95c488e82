import { readFile, writeFile } from 'node:fs/promises';
import { expect, test } from '../fixtures/test';

test('a watch list is shared, and two people change it at once', { tag: '@nightly' }, async ({ openAs, server }) => {
  const mika = await openAs('Mika');
  await mika.runs();

  await test.step('Mika’s entries are stored in his own list', async () => {
    await mika.watch.add('Main.heartbeat');
    await mika.watch.list('Share with everybody');
    await expect(mika.watch.picker).toContainText('shared');
    await mika.watch.renameList('Belt 3');
    const lists = () => server.get<{ name: string }[]>(`/projects/${server.project}/watch-lists`);
    await expect.poll(async () => (await lists()).map(({ name }) => name)).toEqual(['Belt 3']); // the list is saved a moment later
  });

  const jo = await openAs('Jo');
  await test.step('Jo, who has no list yet, sees the shared one', async () => {
    await expect(jo.watch.picker).toContainText('Belt 3');
    await expect(jo.watch.row('Main.heartbeat')).toBeVisible();
  });

  await test.step('each sees the other’s additions after a moment', async () => {
    await jo.watch.add('D100');
    await expect(mika.watch.row('D100')).toBeVisible();
    await mika.watch.remove('Main.uptime');
    await expect(jo.watch.row('Main.uptime')).toBeHidden();
    await Promise.all([mika.watch.add('W1'), jo.watch.add('W2')]);
    for (const ide of [mika, jo]) {
      await expect(ide.watch.row('W1')).toBeVisible();
      await expect(ide.watch.row('W2')).toBeVisible();
    }
  });

  await test.step('Jo’s own list is private; deleting the shared one can be undone', async () => {
    await jo.watch.list('Duplicate as my own');
    await expect(jo.watch.picker).toContainText('private');
    await mika.watch.picker.click();
    await expect(mika.page.getByRole('menuitemradio')).toHaveText([/Belt 3/]);
    await mika.page.keyboard.press('Escape');
    await jo.watch.chooseShared('Belt 3');
    await mika.watch.list('Delete list');
    await expect(jo.watch.pane.getByRole('alert')).toContainText('Mika deleted the list Belt 3');
    await mika.page.getByRole('button', { name: 'Undo' }).click();
    await expect(mika.watch.picker).toContainText('Belt 3');
    await expect(mika.watch.row('W2')).toBeVisible();
    await jo.watch.chooseShared('Belt 3');
    await expect(jo.watch.row('W1')).toBeVisible();
  });

  await test.step('a reload shows the same list', async () => {
    await mika.page.reload();
    await expect(mika.watch.picker).toContainText('Belt 3');
    await expect(mika.watch.row('W1')).toBeVisible();
  });
});

test('addresses, ranges, parts, formats and refusals', { tag: '@nightly' }, async ({ openAs }) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const { watch } = mika;
  await watch.newList();
  await expect(mika.page.getByText('Nothing watched yet')).toBeVisible();

  await test.step('a range shows its words, each of which can be written', async () => {
    await watch.add('W10:3');
    for (const word of ['W10', 'W11', 'W12']) await watch.shows(word, '16#0000');
    await watch.set('W11', '4660');
    await watch.shows('W11', '16#1234');
  });

  await test.step('a bit of a word is a row of its own', async () => {
    await watch.add('W11.3');
    await watch.shows('W11.3', 'FALSE');
    await watch.set('W11.3', 'TRUE');
    await watch.shows('W11', '16#123C');
    await watch.add('Main.parts.total.%B1');
    await watch.shows('Main.parts.total.%B1', '16#00');
  });

  await test.step('the format of a range applies to its words, and to entries there', async () => {
    await watch.fromMenu('W10:3', 'BCD', 'menuitemradio');
    await watch.shows('W10', '0000');
    await watch.set('W10', '1234');
    await watch.shows('W10', '1234');
    await watch.fromMenu('W10', 'Decimal', 'menuitemradio');
    await watch.shows('W10', String(0x1234));
    await watch.fromMenu('W10', 'ASCII', 'menuitemradio');
    await watch.set('W10', 'AB');
    await watch.shows('W10', "'AB'");
  });

  await test.step('an entry out of range stays, with the reason, and one click corrects it', async () => {
    await watch.add('Main.belt.position');
    await watch.write('Main.belt.position', '99999');
    await expect(watch.refusal).toContainText('99999 is outside of INT');
    await expect(watch.entry('Main.belt.position')).toHaveValue('99999');
    await mika.page.getByRole('button', { name: 'Write 32767' }).click();
    await watch.shows('Main.belt.position', '32767');
    await expect(watch.refusal).toBeHidden();
  });

  await test.step('for an unknown name similar ones are offered', async () => {
    await watch.add('Main.belt.positoin');
    await mika.page.getByRole('button', { name: 'Main.belt.position', exact: true }).click();
    await expect(watch.row('Main.belt.positoin')).toBeHidden();
  });
});

test('groups, order, filter, CSV and dragging', { tag: '@nightly' }, async ({ openAs }, info) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const { watch, page } = mika;
  await watch.newList();

  await test.step('many lines are pasted as many entries', async () => {
    await watch.paste('Main.parts.total\nbufferLevel\nMain.heartbeat\nmotor');
    await expect.poll(() => watch.paths()).toEqual(['Main.parts.total', 'bufferLevel', 'Main.heartbeat', 'motor']);
  });

  await test.step('rows are dragged into a group and out of it', async () => {
    await watch.newGroup('Belt');
    await watch.name('motor').dragTo(watch.group('Belt'));
    await expect(watch.group('Belt')).toContainText('1');
    await watch.name('Main.parts.total').dragTo(watch.name('motor'));
    await expect.poll(() => watch.paths()).toEqual(['bufferLevel', 'Main.heartbeat', 'Main.parts.total', 'motor']);
    await watch.group('Belt').getByRole('button', { name: 'Fold Belt' }).click();
    await expect(watch.row('motor')).toBeHidden();
    await watch.group('Belt').getByRole('button', { name: 'Unfold Belt' }).click();
    await watch.name('motor').dragTo(watch.name('bufferLevel'));
    await expect.poll(() => watch.paths()).toEqual(['motor', 'bufferLevel', 'Main.heartbeat', 'Main.parts.total']);
  });

  await test.step('a column sorts inside the groups, and restores the order', async () => {
    const head = watch.table.getByRole('columnheader', { name: 'Target variable' });
    await head.getByRole('button').click();
    await expect(head).toHaveAttribute('aria-sort', 'ascending');
    await expect.poll(() => watch.paths()).toEqual(['bufferLevel', 'Main.heartbeat', 'motor', 'Main.parts.total']);
    await head.getByRole('button').click();
    await head.getByRole('button').click();
    await expect.poll(() => watch.paths()).toEqual(['motor', 'bufferLevel', 'Main.heartbeat', 'Main.parts.total']);
  });

  await test.step('a filter shows only matching rows', async () => {
    await page.getByRole('button', { name: 'Filter', exact: true }).click();
    await page.getByRole('textbox', { name: 'Filter by name, type or address' }).fill('bool');
    await expect.poll(() => watch.paths()).toEqual(['motor', 'Main.heartbeat']);
    await page.getByRole('textbox', { name: 'Filter by name, type or address' }).fill('');
    await page.getByRole('button', { name: 'Show: All rows' }).click();
    await page.getByRole('menuitemradio', { name: 'Changed since the filter was set' }).click();
    await expect.poll(() => watch.paths()).toContain('Main.heartbeat');
    await expect.poll(() => watch.paths()).not.toContain('motor');
    await page.getByRole('button', { name: 'Close the filter' }).click();
  });

  await test.step('a name is dragged from the explorer, and a selection from the editor', async () => {
    const lamp = page.getByRole('tree').getByRole('treeitem', { name: 'lamp', exact: true });
    await lamp.dragTo(watch.table);
    await expect(watch.row('lamp')).toBeVisible();
    const word = mika.editor('Main.st').line('consume   : TON').getByText('consume', { exact: false }).first();
    await word.dblclick({ position: { x: 30, y: 8 } });
    await watch.dragSelection(word);
    await expect(watch.row('Main.consume')).toBeVisible();
  });

  await test.step('the list is exported as CSV and imported again; wrong lines are reported', async () => {
    const file = info.outputPath('list.csv');
    const download = page.waitForEvent('download');
    await watch.more('Export CSV');
    await (await download).saveAs(file);
    const text = await readFile(file, 'utf8');
    expect(text).toContain('Main.parts.total;default;Belt');
    await writeFile(file, `${text}D7;octal;\nD8;hex;New\n`);
    await watch.newList();
    await watch.importCsv(file);
    await expect(page.getByRole('dialog')).toContainText('there is no format octal');
    await page.getByRole('dialog').getByRole('button', { name: 'Close', exact: true }).last().click();
    await watch.shows('D8', '16#0000');
    await expect(watch.group('Belt')).toBeVisible();
    await expect(watch.row('Main.consume')).toBeVisible();
  });
});

test('the watch table by keyboard alone', { tag: '@nightly' }, async ({ openAs }) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const { watch, page } = mika;
  await mika.goToPane('watch');
  await page.keyboard.press('Home');
  await page.keyboard.press('ArrowDown');
  await expect(watch.row('start')).toHaveAttribute('aria-selected', 'true');

  await test.step('F2 or Enter starts an entry, Enter writes it, Escape returns to the table', async () => {
    await page.keyboard.press('F2');
    await page.keyboard.type('TRUE');
    await page.keyboard.press('Enter');
    await watch.shows('start', 'TRUE');
    await page.keyboard.press('Escape');
    await expect(watch.table).toBeFocused();
  });

  await test.step('F7 forces, Shift+F7 releases', async () => {
    await page.keyboard.press('F7');
    await expect(watch.releaseOf('start')).toBeVisible();
    await page.keyboard.press('Shift+F7');
    await expect(watch.releaseOf('start')).toBeHidden();
  });

  await test.step('Delete removes, Ctrl+Z undoes it', async () => {
    await page.keyboard.press('Delete');
    await expect(watch.row('start')).toBeHidden();
    await page.keyboard.press('Control+z');
    await expect(watch.row('start')).toBeVisible();
  });
});
