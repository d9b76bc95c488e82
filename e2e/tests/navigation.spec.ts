import { expect, test } from '../fixtures/test';

test('everything is reached by keys: commands, places, problems, and a text in all files', { tag: '@nightly' }, async ({
  openAs,
  server,
}) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const { page } = mika;
  const { keyboard } = page;
  const main = mika.editor('Main.st');
  const globals = mika.editor('Globals.st');
  const { text: before } = await server.get<{ text: string }>(`/projects/${server.project}/files/Main.st`);

  await test.step('Ctrl+Shift+P lists the commands of the window and of the editor, and does one', async () => {
    await main.replaceWith(before.replace('  motor := station.run;', 'motor:=station.run ;'));
    await main.caretAfter('motor:=station.run ;');
    await keyboard.press('Control+Shift+P');
    const commands = page.getByRole('combobox', { name: 'Commands' });
    await expect(page.getByRole('option', { name: /^Save all and build/ })).toContainText('Ctrl+Shift+B');
    await commands.pressSequentially('format docum');
    await expect(page.getByRole('option', { name: 'Editor: Format Document' })).toBeVisible();
    await commands.press('Enter');
    await expect(main.line('motor := station.run;')).toBeVisible();
    await keyboard.press('Control+Shift+P');
    await commands.pressSequentially('panel search');
    await expect(page.getByRole('option', { name: 'Panel: Search' })).toBeVisible();
    await commands.press('Escape');
    await expect(commands).toBeHidden();
  });

  await test.step('the page of keys', async () => {
    await mika.explorer.tree.getByRole('treeitem', { name: 'Globals.st' }).focus();
    await keyboard.press('?');
    const keys = page.getByRole('dialog', { name: 'Keyboard shortcuts' });
    await expect(keys).toContainText('Search in all files');
    await keyboard.press('Escape');
    await expect(keys).toBeHidden();
  });

  await test.step('a double click on a tab gives its panel the whole window, the next one brings the others back', async () => {
    const watch = page.getByRole('tab', { name: 'Watch', exact: true });
    const errors = page.getByRole('tab', { name: 'Error simulator' });
    await watch.dblclick();
    await expect(errors).not.toBeInViewport();
    await expect(mika.watch.table).toBeVisible();
    await watch.dblclick();
    await expect(errors).toBeInViewport();
  });

  await test.step('who reads and who writes the name at the caret, over all files; a place leads to its line', async () => {
    await main.caretAfter('motor := station.run;');
    for (const key of ['ArrowLeft', 'ArrowLeft', 'Control+Alt+r']) await keyboard.press(key);
    const places = page.getByRole('table', { name: 'Cross references' });
    await expect(places.getByRole('row').filter({ hasText: 'Written' }).first()).toContainText('Station.st');
    await expect(places.getByRole('row').filter({ hasText: 'motor := station.run;' })).toContainText('Read');
    await places
      .getByRole('button', { name: /^Station\.st:/ })
      .first()
      .click();
    await expect(mika.editor('Station.st').region).toBeVisible();
    await page.getByTestId('close:cross').click();
    await main.open();
  });

  const search = page.getByRole('textbox', { name: 'Search', exact: true });
  const all = page.getByRole('button', { name: /^Replace all/ });
  await test.step('a search looks through texts that are not saved, and through files that are not open', async () => {
    await main.replaceWith(before.replace('motor := station.run;', 'motor := station.run; // partsTotal'));
    await keyboard.press('Control+Home');
    await keyboard.press('Control+Shift+F');
    await expect(search).toBeFocused();
    await keyboard.type('partstotal');
    await expect(page.getByRole('status').filter({ hasText: '3 found, files: 2' })).toBeVisible();
    await page.getByRole('button', { name: 'Match capital and small letters' }).click();
    await expect(page.getByRole('status').filter({ hasText: 'Nothing found' })).toBeVisible();
    await search.fill('partsTotal');
    await expect(all).toHaveText('Replace all 3');
  });

  await test.step('Alt+Left goes back to where somebody came from, Alt+Right forward again', async () => {
    await search.press('Enter');
    await expect(globals.line('partsTotal').first()).toBeVisible();
    await expect(mika.statusBar).not.toContainText('Ln 1,');
    await keyboard.press('Alt+ArrowLeft');
    await expect(main.region).toBeVisible();
    await expect(mika.statusBar).toContainText('Ln 1, Col 1');
    await keyboard.press('Alt+ArrowRight');
    await expect(globals.region).toBeVisible();
  });

  await test.step('what is replaced is shown before, in all files, and is not saved', async () => {
    await page.getByRole('textbox', { name: 'Replace with' }).fill('allParts');
    await expect(page.getByRole('region', { name: 'Search results' })).toContainText('partsTotalallParts');
    await all.click();
    await expect(page.getByRole('status').filter({ hasText: 'Nothing found' })).toBeVisible();
    await expect(page.getByRole('tab', { name: /^(Main|Globals)\.st, Not saved/ })).toHaveCount(2);
    await globals.open();
    await globals.caretAfter('allParts AT D100');
    await keyboard.press('Control+z');
    await expect(globals.line('partsTotal').first()).toBeVisible();
  });

  await test.step('Alt+F8 goes to the next problem', async () => {
    await expect(mika.problems.list).toBeHidden();
    await main.open();
    await keyboard.press('Control+Home');
    await expect(page.getByRole('tab', { name: 'Problems (1)' })).toBeVisible();
    await keyboard.press('Alt+F8');
    await expect(main.squiggles).toHaveCount(1);
    await expect(mika.statusBar).not.toContainText('Ln 1, Col 1');
  });

  await test.step('an expression that would take for ever is ended, and the next one is answered', async () => {
    await main.open();
    await main.replaceWith(before.replace('motor := station.run;', `motor := station.run; // ${'a'.repeat(60)}!`));
    await keyboard.press('Control+Shift+F');
    await page.getByRole('button', { name: 'Regular expression' }).click();
    await search.fill('(a+)+b');
    await expect(page.getByRole('status').filter({ hasText: 'takes too long' })).toBeVisible();
    await search.fill('a{60}!');
    await expect(page.getByRole('status').filter({ hasText: '1 found' })).toBeVisible();
    await page.getByRole('button', { name: 'Regular expression' }).click();
  });
});
