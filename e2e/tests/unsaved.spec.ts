import type { Locator } from '@playwright/test';
import { expect, test } from '../fixtures/test';

/** Whether an element lies completely within a second one, so that it can be clicked. */
async function within(part: Locator, whole: Locator): Promise<boolean> {
  const [inner, outer] = [await part.boundingBox(), await whole.boundingBox()];
  if (!inner || !outer) return false;
  return inner.x >= outer.x && inner.x + inner.width <= outer.x + outer.width && inner.y >= outer.y;
}

test('no text is lost silently: closing asks, a failed build says why, Save and Build are in reach', async ({
  openAs,
}) => {
  const mika = await openAs('Mika');
  const { page } = mika;
  await mika.runs();
  const main = mika.editor('Main.st');
  const dialog = page.getByRole('dialog');
  const close = () => page.getByTestId('close:Main.st').click();

  await test.step('closing a tab with unsaved text asks; Escape changes nothing', async () => {
    await main.addBelow('uptime : TIME;', '  kept : INT;');
    await close();
    await expect(dialog).toContainText('Save the changes of Main.st?');
    await page.keyboard.press('Escape');
    await expect(main.line('kept : INT;')).toBeVisible();
  });

  await test.step('a text that is not saved comes back, a discarded one does not', async () => {
    await close();
    await dialog.getByRole('button', { name: 'Close, not saved' }).click();
    await expect(main.region).toBeHidden();
    await mika.explorer.tree.getByRole('treeitem', { name: 'Main', exact: true }).first().dblclick();
    await expect(main.line('kept : INT;')).toBeVisible();
    await close();
    await dialog.getByRole('button', { name: 'Discard' }).click();
    await expect(main.region).toBeHidden();
    await mika.explorer.tree.getByRole('treeitem', { name: 'Main', exact: true }).first().dblclick();
    await expect(main.line('uptime : TIME;')).toBeVisible();
    await expect(main.line('kept : INT;')).toHaveCount(0);
    await close();
    await expect(main.region).toBeHidden();
    await mika.explorer.tree.getByRole('treeitem', { name: 'Main', exact: true }).first().dblclick();
  });

  await test.step('a failed build opens the problems', async () => {
    await main.addBelow('uptime : TIME;', '  broken : NOTYPE;');
    await expect(mika.problems.list).toBeHidden();
    await page.keyboard.press('Control+Shift+b');
    await expect(main.outcome).toContainText('Build refused');
    await expect(mika.problems.list).toContainText('NOTYPE');
  });

  await test.step('Save in the question stores the text and closes the tab', async () => {
    await main.addBelow('broken : NOTYPE;', '  stored : INT;');
    await close();
    await dialog.getByRole('button', { name: 'Save', exact: true }).click();
    await expect(main.region).toBeHidden();
    await mika.explorer.tree.getByRole('treeitem', { name: 'Main', exact: true }).first().dblclick();
    await expect(main.line('stored : INT;')).toBeVisible();
    await expect(page.getByRole('tab', { name: 'Main.st, Not saved' })).toHaveCount(0);
  });

  await test.step('Save and Build are in reach beside all texts of the bar', async () => {
    await main.caretAfter('broken : NOTYPE;');
    for (let letter = 0; letter < ' broken : NOTYPE;'.length; letter += 1) await page.keyboard.press('Backspace');
    await page.keyboard.press('Control+Shift+b');
    await expect(main.region.getByRole('button', { name: 'Roll back' })).toBeVisible();
    await mika.explorer.tree.getByRole('treeitem', { name: 'Belt', exact: true }).first().dblclick();
    const belt = mika.editor('Belt.st');
    await expect(belt.region.getByRole('button', { name: /^Belt: values of/ })).toBeVisible();
    const inReach = async (where: string, names: readonly string[]) => {
      for (const name of names)
        await expect
          .poll(() => within(belt.region.getByRole('button', { name, exact: true }), belt.region), `${name}, ${where}`)
          .toBe(true);
    };
    await inReach('1440', ['Save', 'Build', 'Roll back']);
    await page.setViewportSize({ width: 1024, height: 700 });
    await inReach('1024', ['Save', 'Build', 'Roll back']);
    await belt.region.evaluate((pane) => {
      pane.style.width = '300px';
    });
    await inReach('half of a split', ['Save', 'Build', 'Actions']);
    await belt.region.getByRole('button', { name: 'Actions', exact: true }).click();
    await expect(page.getByRole('menuitem', { name: /^Roll back/ })).toBeVisible();
  });
});

test('a project needs its model; none of the page’s own requests is refused', { tag: '@nightly' }, async ({
  openAs,
  server,
}) => {
  const mika = await openAs('Mika');
  const { page } = mika;
  await mika.runs();
  const refused: string[] = [];
  page.on('response', (response) => {
    if (response.status() >= 400) refused.push(`${response.status()} ${response.url()}`);
  });
  await mika.explorer.tree.getByRole('treeitem', { name: 'Belt', exact: true }).first().dblclick();
  const belt = mika.editor('Belt.st');
  await belt.caretAfter('position := position + STEP;');
  let arrive = () => {};
  const models = new Promise<void>((resolve) => {
    arrive = resolve;
  });
  let tries = 0;
  await page.route('**/api/models', async (route) => {
    tries += 1;
    if (tries === 1) return route.abort('connectionrefused');
    await models;
    return route.continue();
  });
  await mika.top.picker.click();
  await page.getByRole('menuitem', { name: 'New project…' }).click();
  const dialog = page.getByRole('dialog', { name: 'New project' });
  await expect(dialog.getByRole('alert')).toContainText('No connection to the server.');
  await dialog.getByRole('textbox', { name: 'Name' }).fill('late');
  await dialog.getByRole('button', { name: 'Try now' }).click();
  await expect(dialog.getByRole('button', { name: 'Create' })).toBeDisabled();
  await expect(dialog.getByRole('combobox', { name: 'PLC model' })).toContainText('Loading the models');
  await page.keyboard.press('Enter');
  arrive();
  await expect(dialog.getByRole('button', { name: 'Create' })).toBeEnabled();
  await dialog.getByRole('button', { name: 'Create' }).click();
  await expect(dialog).toBeHidden();
  await expect(mika.top.picker).toContainText('late');
  await expect(page).not.toHaveURL(new RegExp(`/i/${server.instance}$`));
  const late = page.url();
  // Opened by its address, while the tabs are still those of the other project.
  const { origin } = new URL(server.address);
  await page.goto(`${origin}/i/${server.instance}`);
  await expect(belt.region).toBeVisible();
  await mika.runs();
  await page.goto(late);
  await mika.runs();
  await expect(mika.editor('Main.st').region).toBeVisible();
  await expect(belt.region).toBeHidden();
  expect(refused).toEqual([]);
});
