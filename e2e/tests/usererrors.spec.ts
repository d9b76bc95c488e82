import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import AxeBuilder from '@axe-core/playwright';
import { expect, test } from '../fixtures/test';
import { UserErrors } from '../pages/usererrors';

const BROKEN = resolve(import.meta.dirname, '../../backend/tests/plcmodel/broken_user_errors');

test('user-defined errors: edited in the browser, built, raised, recorded', { tag: '@nightly' }, async ({ openAs }) => {
  const jo = await openAs('Jo');
  await jo.runs();
  const own = new UserErrors(jo.page);

  await test.step('the first error starts from an example', async () => {
    await own.open();
    await expect(own.pane).toContainText('No user-defined errors yet');
    await own.pane.getByRole('button', { name: /Pump overheated/ }).click();
    await expect(own.error('Pump overheated')).toContainText('W10.00');
    await expect(own.field('Id')).toHaveValue('pump-overheated');
  });

  await test.step('problems are shown below their fields during typing', async () => {
    await own.field('Flag address').fill('W999.00');
    await expect(own.wrong('the last word is W511')).toBeVisible();
    await expect(own.error('Pump overheated')).toContainText('1 problem');
    await own.field('Flag address').fill('W10.03');
    await expect(own.wrong(/./)).toHaveCount(0);
  });

  await test.step('the id of a second error follows its name, and it gets details', async () => {
    await own.button('New error').click();
    await own.field('Name').fill('Guard open');
    await expect(own.field('Id')).toHaveValue('guard-open');
    await own.field('Flag address').fill('W10.04');
    await own.button('Add a detail').click();
    await own.field('Detail').fill('guard');
    await own.field('Address 1').fill('W11.00');
    await own.field('Value 1').fill('2');
    await own.pane.getByRole('checkbox', { name: 'Added to the code 1' }).check();
    await expect(own.wrong(/./)).toHaveCount(0);
  });

  await test.step('the page can be used with keyboard and screen reader', async () => {
    await own.list.focus();
    await jo.page.keyboard.press('ArrowUp');
    await expect(own.error('Pump overheated')).toHaveAttribute('aria-selected', 'true');
    await expect(own.field('Name')).toHaveValue('Pump overheated');
    await jo.page.keyboard.press('End');
    await expect(own.field('Name')).toHaveValue('Guard open');
    const { violations } = await new AxeBuilder({ page: jo.page }).include('[data-pane=usererrors]').analyze();
    expect(violations.map(({ id, nodes }) => `${id}: ${nodes[0]?.html}`)).toEqual([]);
  });

  await test.step('unsaved edits survive closing the tab and reloading the page', async () => {
    await jo.page.getByTestId('close:usererrors').click();
    await jo.page.getByRole('dialog').getByRole('button', { name: 'Keep in this browser' }).click();
    await expect(own.pane).toBeHidden();
    await jo.page.reload();
    await jo.runs();
    await own.open();
    await expect(own.error('Guard open')).toBeVisible();
    await expect(own.pane).toContainText('Not saved');
  });

  await test.step('saved and built, the errors are in the error simulator', async () => {
    await own.save();
    await own.button('Build').click();
    await expect(own.pane.getByText(/^Saved as version/)).toBeHidden();
    await jo.page.getByTestId('close:usererrors').click();
    await expect(jo.simulator.error('Guard open')).toContainText('Never');
  });

  await test.step('raised, its flag and code are in the memory, and the history lists it', async () => {
    await jo.watch.add('W10');
    await jo.simulator.generate('Guard open');
    await jo.watch.shows('W10', '16#0010');
    await expect(jo.simulator.word('A400')).toContainText('4F04');
    await jo.showPanel('History');
    await expect(jo.history('Guard open')).toContainText('Generated');
  });

  await test.step('while it is present, a program without it is refused with a message', async () => {
    await own.open();
    await own.error('Guard open').click();
    await own.button('Delete').click();
    await own.save();
    await own.button('Build').click();
    await expect(jo.page.getByText(/recover guard-open first/).first()).toBeVisible();
  });
});

test('a file is imported as a whole or not at all; of two people who save, the second decides', {
  tag: '@nightly',
}, async ({ openAs }) => {
  const jo = await openAs('Jo');
  await jo.runs();
  const own = new UserErrors(jo.page);
  await own.open();

  await test.step('a broken file is refused with its line', async () => {
    const dialog = await own.import('broken.xml', readFileSync(`${BROKEN}/flag-outside.xml`, 'utf-8'));
    await expect(dialog.getByRole('alert')).toContainText('line 5, column 54');
    await expect(dialog.getByRole('alert')).toContainText('the last word is W511');
    await dialog.getByRole('button', { name: 'Cancel' }).click();
    await expect(own.pane).toContainText('No user-defined errors yet');
  });

  await test.step('a valid file is imported', async () => {
    await own.import('good.xml', readFileSync(`${BROKEN}/GOOD.xml`, 'utf-8'));
    await expect(own.error('Pump hot')).toBeVisible();
    await expect(own.field('Name in Japanese')).toHaveValue('ポンプ過熱');
  });

  await test.step('the export is the file', async () => {
    const download = jo.page.waitForEvent('download');
    await own.button('Export').click();
    expect((await download).suggestedFilename()).toBe('errors.xml');
    expect(readFileSync(await (await download).path(), 'utf-8')).toContain('Id="pump-hot"');
  });

  await test.step('two people save: the second is told, and keeps their own version or takes the other', async () => {
    const ada = await openAs('Ada');
    const theirs = new UserErrors(ada.page);
    await theirs.open();
    await theirs.field('Name').fill('Pump too hot');
    await own.field('Priority').fill('7');
    await theirs.save();
    await expect(own.field('Priority')).toHaveValue('7');
    await own.button('Save').click();
    await expect(own.pane.getByRole('alert')).toContainText('Ada saved errors.xml first (version 2)');
    await own.button('Take theirs').click();
    await expect(own.error('Pump too hot')).toBeVisible();
    await expect(own.field('Priority')).toHaveValue('300');
    await own.field('Priority').fill('8');
    await own.save();
    await expect(theirs.field('Priority')).toHaveValue('8');
  });
});
