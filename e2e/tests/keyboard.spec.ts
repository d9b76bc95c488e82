import { expect, type Locator, type Page } from '@playwright/test';
import { test } from '../fixtures/test';
import { run } from '../pages/everywhere';

const ERROR = 'Basic I/O Unit error';
const LINE = 'belt(run := motor);';

test('by keyboard alone: tour, editor, operator panel, error simulator, debugger', { tag: '@nightly' }, async ({
  openAs,
}) => {
  const mika = await openAs('Mika');
  const { page } = mika;
  const { keyboard } = page;
  await withoutMouse(page);
  await mika.runs();
  const tour = page.getByRole('region', { name: 'Tour' });
  const next = async () => {
    await tabTo(page, tour.getByRole('button', { name: 'Next', exact: true }));
    await keyboard.press('Enter');
  };
  const errors = mika.simulator;

  await test.step('the tour begins from the palette, and its next steps are reached by F6 and Tab', async () => {
    await run(page, 'Tour of the sample');
    await expect(tour).toContainText('Step 1 of');
    await mika.goToPane('tour');
    await next();
    await expect(tour).toContainText('type TRUE');
  });

  await test.step('a value is written in the watch table', async () => {
    await toRow(page, mika.watch.table, mika.watch.row('start'), 'watch');
    await keyboard.press('Enter');
    await keyboard.type('TRUE');
    await keyboard.press('Enter');
    await mika.watch.shows('motor', 'TRUE');
    await mika.goToPane('tour');
    await next();
  });

  await test.step('an error is found by its name, gets its details, is raised and recovered', async () => {
    await toRow(page, errors.tree, errors.error(ERROR), 'errors');
    const rack = errors.details.getByRole('spinbutton', { name: 'Rack' });
    await tabTo(page, rack);
    await keyboard.press('ControlOrMeta+A');
    await keyboard.type('1');
    await tabTo(page, errors.generateButton);
    await keyboard.press('Enter');
    await expect(errors.error(ERROR)).toContainText('Generated');
    await expect(errors.details).toContainText('Rack number 1');
    await mika.watch.shows('motor', 'FALSE');
    await mika.goToPane('tour');
    await next();
    await toRow(page, errors.tree, errors.error(ERROR), 'errors');
    await tabTo(page, page.getByRole('button', { name: 'Recover', exact: true }));
    await keyboard.press('Enter');
    await expect(errors.error(ERROR)).toContainText('Cleared');
    await mika.goToPane('tour');
    await next();
    await tabTo(page, tour.getByRole('button', { name: 'Leave the tour; it goes on here next time' }));
    await keyboard.press('Enter');
    await expect(tour).toBeHidden();
  });

  const main = mika.editor('Main.st');
  await test.step('the editor: a file by its name, a line by its number, typed, saved and built', async () => {
    await keyboard.press('Control+P');
    await page.getByRole('dialog').getByRole('combobox').pressSequentially('Main.st');
    await keyboard.press('Enter');
    await expect(page.getByRole('dialog')).toBeHidden();
    await expect(main.line('PROGRAM Main').first()).toBeVisible();
    await mika.goToPane('editor');
    await keyboard.press('Control+Home');
    await keyboard.press('ArrowDown');
    await keyboard.press('End');
    await keyboard.press('Enter');
    await keyboard.type('extra : INT;');
    await expect(mika.statusBar).toContainText('Not saved');
    await keyboard.press('Control+S');
    await expect(mika.statusBar).toContainText(/Saved \d\d:\d\d/);
    await run(page, 'Save all and build');
    await expect(mika.statusBar).toContainText('Program version 2');
  });

  await test.step('an operator panel: opened by its name, a push button is held down', async () => {
    await keyboard.press('Control+P');
    await page.getByRole('dialog').getByRole('combobox').pressSequentially('Operation');
    await keyboard.press('Enter');
    const panel = page.getByRole('region', { name: 'Operator panel Operation' });
    await expect(panel.getByRole('button', { name: 'Stop' })).toBeVisible();
    await mika.goToPane('operator');
    await tabTo(page, panel.getByRole('button', { name: 'Stop' }));
    await keyboard.down('Space');
    await mika.watch.shows('stop', 'TRUE');
    await keyboard.up('Space');
    await mika.watch.shows('stop', 'FALSE');
  });

  await test.step('the debugger: a breakpoint, halted, a step in and out, a watch, and on', async () => {
    await keyboard.press('Control+P');
    await page.getByRole('dialog').getByRole('combobox').pressSequentially('Main.st');
    await keyboard.press('Enter');
    await expect(page.getByRole('dialog')).toBeHidden();
    await mika.goToPane('editor');
    await keyboard.press('Control+F');
    await keyboard.type(LINE);
    await keyboard.press('Enter');
    await keyboard.press('Escape');
    await keyboard.press('F9');
    await expect(mika.debug.haltedLine('Main.st')).toBeVisible();
    await keyboard.press('F11');
    await expect(mika.debug.frames).toHaveCount(2);
    // The block's file opens, and takes the focus.
    await expect(mika.debug.haltedLine('Belt.st')).toBeVisible();
    await expect(mika.editor('Belt.st').text).toBeFocused();
    await toRow(page, mika.debug.section('Call stack').getByRole('tree'), mika.debug.frames.nth(1), 'debug');
    await keyboard.press('Enter');
    await keyboard.press('Shift+F11');
    await expect(mika.debug.frames).toHaveCount(1);
    await mika.goToPane('watch');
    await tabTo(page, page.getByRole('combobox', { name: 'Add to watch' }), 'Shift+Tab');
    await keyboard.type('Main.belt.position');
    await keyboard.press('Enter');
    await expect(mika.watch.row('Main.belt.position').first()).toBeVisible();
    await mika.goToPane('debug');
    await tabTo(page, mika.debug.section('Breakpoints').getByRole('button', { name: 'Remove all breakpoints' }));
    await keyboard.press('Enter');
    await expect(mika.debug.breakpoints).toHaveCount(0);
    await keyboard.press('F5');
    await mika.runs();
  });
});

/** Nothing below may use it, not even by accident. */
async function withoutMouse(page: Page): Promise<void> {
  // Of this page only: the story after this one gets the same window, and uses the mouse.
  await page.evaluate(() => {
    for (const kind of ['pointerdown', 'mousedown'])
      addEventListener(kind, (event) => event.isTrusted && console.error(`the mouse was used: ${kind}`), true);
  });
}

/** Tab until this has the focus. */
async function tabTo(page: Page, target: Locator, key = 'Tab'): Promise<void> {
  await expect(target).toBeVisible();
  const there = () => target.evaluate((element) => element === document.activeElement);
  for (let turn = 0; turn < 80 && !(await there()); turn += 1) await page.keyboard.press(key);
  await expect(target).toBeFocused();
}

/** F6 to the pane, Tab to the table or tree, and down to the row. */
async function toRow(page: Page, table: Locator, row: Locator, pane: string): Promise<void> {
  const inside = () =>
    page.evaluate((name) => document.activeElement?.closest<HTMLElement>('[data-pane]')?.dataset.pane === name, pane);
  for (let turn = 0; turn < 20 && !(await inside()); turn += 1) await page.keyboard.press('F6');
  const within = () => table.evaluate((element) => element.contains(document.activeElement));
  for (let turn = 0; turn < 20 && !(await within()); turn += 1) await page.keyboard.press('Tab');
  await page.keyboard.press('Home');
  const chosen = () =>
    row.evaluateAll((rows) =>
      rows.some((one) => one.getAttribute('aria-selected') === 'true' || one === document.activeElement),
    );
  for (let turn = 0; turn < 80 && !(await chosen()); turn += 1) await page.keyboard.press('ArrowDown');
  expect(await chosen()).toBe(true);
}
