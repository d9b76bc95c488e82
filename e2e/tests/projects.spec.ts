import { expect, test } from '../fixtures/test';

test('versions are compared and taken back; a project goes out and comes in as one file', { tag: '@nightly' }, async ({
  openAs,
}) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const { page } = mika;
  const main = mika.editor('Main.st');
  const pane = page.locator('[data-pane=versions]');

  await test.step('what was changed since a build is shown file by file', async () => {
    await main.addBelow('motor := station.run;', '  lamp := NOT motor;');
    await main.build();
    await expect(main.outcome).toContainText('Built');
    await page.keyboard.press('Control+Shift+P');
    await page.getByRole('combobox', { name: 'Commands' }).pressSequentially('versions of');
    await page.getByRole('option', { name: 'Versions of the program' }).click();
    await expect(pane).toContainText('All files are the same in both.');
    await pane.getByRole('combobox', { name: 'Compare' }).selectOption('1');
    await expect(pane.getByRole('list', { name: 'Files that differ' })).toHaveText('Main.stchanged');
    await expect(pane.locator('.modified .view-line').filter({ hasText: 'lamp := NOT motor;' })).toBeVisible();
  });

  await test.step('an earlier version is taken into the editor', async () => {
    await pane.getByRole('button', { name: 'Take version 1 into the editor' }).click();
    await expect(pane).toContainText('All files are the same in both.');
    await page.getByTestId('close:versions').click();
    await expect(page.getByRole('tab', { name: 'Main.st, Not saved' })).toBeVisible();
    // The comparison is gone: what the editor itself shows does not depend on it.
    await main.caretAfter('motor := station.run;');
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('Shift+F12');
    await expect(page.locator('.peekview-widget').first()).toBeVisible();
    await page.keyboard.press('Escape');
    await main.build();
    await expect(main.outcome).toContainText('Built');
  });

  await test.step('a project that went out as a file comes in as a new one', async () => {
    await mika.top.picker.click();
    const download = page.waitForEvent('download');
    await page.getByRole('menuitem', { name: 'Export the project' }).click();
    const file = await download;
    expect(file.suggestedFilename()).toBe('Conveyor.zip');
    await mika.top.picker.click();
    await page.getByRole('menuitem', { name: 'New project…' }).click();
    const dialog = page.getByRole('dialog', { name: 'New project' });
    await dialog.getByLabel(/^Program files/).setInputFiles({
      name: 'Conveyor.zip',
      mimeType: 'application/zip',
      buffer: await buffer(await file.createReadStream()),
    });
    await expect(dialog).toContainText('9 files');
    await expect(dialog.getByRole('combobox', { name: 'PLC model' })).toHaveValue('CJ1M-CPU63');
    await dialog.getByRole('textbox', { name: 'Name' }).fill('Second line');
    await dialog.getByRole('button', { name: 'Create' }).click();
    await expect(mika.top.picker).toContainText('Second line');
    await mika.runs();
    await expect(mika.explorer.tree).toContainText('ErrorHandler');
    await expect(mika.explorer.tree.getByRole('treeitem', { name: 'Operation' })).toBeVisible();
  });
});

async function buffer(stream: AsyncIterable<Uint8Array>): Promise<Buffer> {
  const parts: Uint8Array[] = [];
  for await (const part of stream) parts.push(part);
  return Buffer.concat(parts);
}
