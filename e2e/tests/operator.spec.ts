import AxeBuilder from '@axe-core/playwright';
import { expect, test } from '../fixtures/test';
import { Ide } from '../pages/ide';

test('an operator panel is built by mouse and by keyboard, and operated by a colleague', { tag: '@nightly' }, async ({
  openAs,
  server,
}) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const { page } = mika;
  const panel = page.getByRole('region', { name: 'Operator panel Line' });
  const element = (name: RegExp) => panel.getByRole('option', { name });

  await test.step('a new panel is a file of the project, without a build', async () => {
    await page.getByRole('button', { name: 'New operator panel' }).click();
    await page.getByLabel('Name of the panel').fill('Line');
    await page.getByRole('button', { name: 'Create' }).click();
    await expect(panel.getByRole('heading', { name: 'This panel has no elements' })).toBeVisible();
    await panel.getByRole('button', { name: 'Edit panel' }).last().click();
  });

  await test.step('by mouse: a variable of the explorer is dropped, moved, and made larger', async () => {
    const grid = panel.getByLabel('Elements');
    const motor = mika.explorer.tree.getByRole('treeitem', { name: 'motor' });
    await motor.dragTo(grid, { targetPosition: { x: 40, y: 40 } });
    const lamp = element(/^Lamp motor/);
    await expect(lamp).toHaveAccessibleName('Lamp motor, column 2, row 2, 4 by 2');
    await drag(lamp, { x: 20, y: 10 }, { x: 20 + 3 * 36, y: 10 + 36 });
    await expect(lamp).toHaveAccessibleName('Lamp motor, column 5, row 3, 4 by 2');
    const { width = 0, height = 0 } = (await lamp.boundingBox()) ?? {};
    await drag(lamp, { x: width - 4, y: height - 4 }, { x: width - 4 + 36, y: height - 4 });
    await expect(lamp).toHaveAccessibleName('Lamp motor, column 5, row 3, 5 by 2');
  });

  await test.step('by keyboard: a switch is added, named, moved and sized; undone', async () => {
    await panel.getByRole('button', { name: 'Add element' }).focus();
    await page.keyboard.press('Enter');
    await page.getByRole('menuitem', { name: 'Switch' }).focus();
    await page.keyboard.press('Enter');
    await panel.getByLabel('Variable or address').fill('stop');
    await page.keyboard.press('Tab');
    await panel.getByLabel('Label', { exact: true }).fill('Halt the line');
    await page.keyboard.press('Enter');
    const halt = element(/^Switch Halt the line/);
    await halt.focus();
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('Shift+ArrowRight');
    await expect(halt).toHaveAccessibleName('Switch Halt the line, column 1, row 2, 5 by 2');
    await page.keyboard.press('Delete');
    await expect(halt).toHaveCount(0);
    await page.keyboard.press('Control+z');
    await expect(halt).toHaveCount(1);
    await panel.getByRole('button', { name: 'Add element' }).click();
    await page.getByRole('menuitem', { name: 'Field' }).click();
    await panel.getByLabel('Variable or address').fill('D200');
    await page.keyboard.press('Enter');
    await expect(element(/^Field D200/)).toHaveCount(1);
    await panel.getByRole('button', { name: 'Add element' }).click();
    await page.getByRole('menuitem', { name: 'Push button' }).click();
    await panel.getByLabel('Variable or address').fill('start');
    await page.keyboard.press('Enter');
    await expect(element(/^Push button start/)).toHaveCount(1);
    expect((await new AxeBuilder({ page }).include('.operator').analyze()).violations).toEqual([]);
    await panel.getByRole('button', { name: 'Done' }).click();
    expect((await new AxeBuilder({ page }).include('.operator').analyze()).violations).toEqual([]);
  });

  const jo = await openAs('Jo', `/i/${server.instance}?operate=Line.panel.json`);
  const window = jo.page.getByRole('region', { name: 'Operator panel Line' });
  const level = window.getByLabel('D200', { exact: true }).getByRole('textbox');

  await test.step('a colleague operates it in a window of its own', async () => {
    const halt = window.getByRole('switch', { name: 'Halt the line' });
    await halt.click();
    await expect(halt).toBeChecked();
    await mika.watch.shows('stop', 'TRUE');
    await expect(jo.page).toHaveURL(/operate=Line/);
    await level.click();
    for (const value of ['35', '40']) {
      await jo.page.keyboard.type(value);
      await jo.page.keyboard.press('Enter');
    }
    await level.blur();
    await expect(level).toHaveValue('16#0028');
  });

  await test.step('a push button is TRUE while it is held, also when the window is closed meanwhile', async () => {
    const start = window.getByRole('button', { name: 'start' });
    await start.dispatchEvent('keydown', { key: ' ' });
    await mika.watch.shows('start', 'TRUE');
    await start.dispatchEvent('keyup', { key: ' ' });
    await mika.watch.shows('start', 'FALSE');
    await start.hover();
    await jo.page.mouse.down();
    await mika.watch.shows('start', 'TRUE');
    await jo.page.reload();
    await mika.watch.shows('start', 'FALSE');
  });

  await test.step('a value that the PLC refuses is explained, and the old one stays', async () => {
    await level.fill('many');
    await level.press('Enter');
    await expect(window.getByRole('alert')).toContainText('many');
    await level.blur();
    await expect(level).toHaveValue('16#0028');
  });

  await test.step('a force is marked, and a change of the panel arrives by itself', async () => {
    await server.post(`/instances/${server.instance}/commands`, { type: 'force', path: 'motor', value: 'TRUE' });
    await expect(window.getByRole('group', { name: 'motor' }).getByRole('img', { name: 'Forced' })).toBeVisible();
    await expect(window.getByRole('img', { name: 'motor: TRUE' })).toBeVisible();
    await panel.getByRole('button', { name: 'Edit panel' }).click();
    await element(/^Lamp motor/).click();
    await panel.getByLabel('Label', { exact: true }).fill('Belt drive');
    await page.keyboard.press('Enter');
    await expect(window.getByRole('group', { name: 'Belt drive' })).toBeVisible();
  });

  await test.step('what has no panel is operated at the terminals', async () => {
    await mika.explorer.tree.getByRole('treeitem', { name: 'Inputs and outputs' }).dblclick();
    const reset = page.getByRole('switch', { name: 'reset, CIO0.02' });
    await reset.click();
    await expect(reset).toBeChecked();
    await expect(page.getByRole('img', { name: 'motor, CIO100.00: TRUE' })).toBeVisible();
    expect((await new AxeBuilder({ page }).include('.operator').analyze()).violations).toEqual([]);
    await page.getByTestId('close:rack').click();
  });

  await test.step('after a reload the panel is in its tab', async () => {
    await page.reload();
    await new Ide(page).runs();
    await expect(panel.getByRole('group', { name: 'Belt drive' })).toBeVisible();
  });
});

interface Point {
  x: number;
  y: number;
}

async function drag(of: ReturnType<Ide['page']['locator']>, from: Point, to: Point): Promise<void> {
  const { x = 0, y = 0 } = (await of.boundingBox()) ?? {};
  const { mouse } = of.page();
  await mouse.move(x + from.x, y + from.y);
  await mouse.down();
  await mouse.move(x + to.x, y + to.y, { steps: 4 });
  await mouse.up();
}
