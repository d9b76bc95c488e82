import { readFile } from 'node:fs/promises';
import { expect, test } from '../fixtures/test';
import { History } from '../pages/history';

const ERROR = 'Battery error';

test('the test record is filtered, printed, saved and imported again', { tag: '@nightly' }, async ({ openAs }) => {
  const mika = await openAs('Mika');
  const history = new History(mika.page);
  await mika.runs();
  await mika.simulator.generate(ERROR);
  await mika.simulator.recover(ERROR);
  await mika.showPanel('History');
  const row = mika.history(ERROR);

  await test.step('the row shows when, who, how often, and what the program did', async () => {
    await expect(row).toContainText(['Recovered']);
    await expect(row).toContainText(['Mika']);
    await expect(row).toContainText([/Acted|No effect|Never read/]);
  });

  await test.step('filters reduce the rows, and a message says when none is left', async () => {
    const all = await history.rows().count();
    expect(all).toBeGreaterThan(20);
    await history.filter('State', 'Cleared');
    await expect(history.rows()).toHaveCount(1);
    await history.filter('State', 'Never');
    await expect(history.rows()).toHaveCount(all - 1);
    await history.filter('State', 'All states');
    await history.search('battery');
    await expect(history.rows()).toHaveCount(1);
    await history.search('no such error');
    await expect(mika.page.locator('[data-pane=history]')).toContainText('No row matches');
    await history.search('');
    await history.sortBy('Author');
    await expect(history.rows().first()).toContainText(ERROR);
    await history.sortBy('Author');
    await history.sortBy('Author');
  });

  await test.step('the printable record is a document with this row', async () => {
    const tab = await history.print();
    await expect(tab.getByRole('heading', { level: 1 })).toContainText('Test record');
    await expect(tab.getByRole('row').filter({ hasText: ERROR }).filter({ hasText: 'cleared' })).toContainText('Mika');
    await expect(tab.getByText('Approved by')).toBeVisible();
    await tab.close();
  });

  await test.step('CSV and XML are saved, and the XML is imported again', async () => {
    const csv = await history.save('Save as CSV');
    expect(await readFile(await csv.path(), 'utf8')).toMatch(/battery-error.*,cleared,/);
    const xml = await history.save('Save as XML');
    expect(xml.suggestedFilename()).toBe('line-1-version-1-record.xml');
    await history.importFile(await xml.path());
    await expect(history.record).toContainText('This imported test record is read-only');
    await expect(history.record).toContainText('Imported by Mika');
    const imported = history.rows('Errors of the imported record').filter({ hasText: ERROR });
    await expect(imported).toContainText(['Cleared']);
    await expect(imported).toContainText(['Mika']);
    await history.record.getByRole('button', { name: 'Delete', exact: true }).click();
    await mika.page.getByRole('dialog').getByRole('button', { name: 'Delete' }).click();
    await expect(history.record).toContainText('No test record was imported yet');
    await mika.page.getByRole('tab', { name: 'Test record' }).press('Delete');
  });

  await test.step('a broken file is refused with its line', async () => {
    await mika.showPanel('History');
    const buffer = Buffer.from('<TestRecord>\n  <Error>\n</TestRecord>\n');
    await history.importFile({ name: 'broken.xml', mimeType: 'application/xml', buffer });
    await expect(history.alert).toContainText('record.xml:3:');
    await expect(history.alert).toContainText('nothing was kept');
  });
});

test('every version of the program has its own history', { tag: '@nightly' }, async ({ openAs }) => {
  const mika = await openAs('Mika');
  const history = new History(mika.page);
  await mika.runs();
  await mika.simulator.generate(ERROR);
  await mika.simulator.recover(ERROR);
  const main = mika.editor('Main.st');
  await main.open();
  await main.addBelow('PROGRAM Main', '(* another version *)');
  await main.build();
  await mika.showPanel('History');

  await test.step('the new version begins without tested errors', async () => {
    await expect(mika.page.getByRole('button', { name: 'History of: Version 2, running' })).toBeVisible();
    await expect(mika.history(ERROR)).toContainText(['Never']);
  });

  await test.step('the old version is marked as no longer running', async () => {
    await history.showVersion(/^Version 1/);
    await expect(mika.page.locator('[data-pane=history]')).toContainText('Version 1 no longer runs');
    await expect(mika.history(ERROR)).toContainText(['Recovered']);
    await mika.page.getByRole('button', { name: 'Show the running version' }).click();
    await expect(mika.history(ERROR)).toContainText(['Never']);
  });
});
