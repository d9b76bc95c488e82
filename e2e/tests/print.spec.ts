import { readFile } from 'node:fs/promises';
import { filling } from '../fixtures/filling';
import { expect, test } from '../fixtures/test';

test('a drawing is printed whole on pages, and nothing else of the page is @nightly', async ({
  openAs,
  server,
}, testInfo) => {
  const mika = await openAs('Mika', await filling(server));
  const { page } = mika;
  await mika.runs();
  for (const { pou, says, pages } of [
    { pou: 'Alarms', says: ['A blown fuse at an output', 'analogAlarm', 'basicIoError'], pages: 1 },
    { pou: 'Cycle', says: ['bottle'], pages: 1 },
    { pou: 'Main', says: ['interlocks', 'spindle', 'What may be'], pages: 1 },
  ]) {
    await mika.explorer.tree
      .getByRole('treeitem', { name: new RegExp(`^${pou}\\b`) })
      .first()
      .dblclick();
    await expect(
      page
        .getByRole('listbox', { name: `Drawing of ${pou}.st` })
        .getByRole('group')
        .first(),
    ).toBeVisible();
    await page.evaluate(() => {
      addEventListener(
        'beforeprint',
        () => {
          document.body.dataset.printed = document.querySelector('.printed')?.textContent ?? '';
        },
        { once: true },
      );
    });
    const path = testInfo.outputPath(`${pou}.pdf`);
    await page.pdf({ path, preferCSSPageSize: true, printBackground: true });
    const printed = (await page.locator('body').getAttribute('data-printed')) ?? '';
    for (const each of [`${pou}.st`, ...says]) expect.soft(printed).toContain(each);
    expect.soft(printed).not.toContain('Error simulator');
    const pdf = await readFile(path, 'latin1');
    expect.soft(pdf.match(/\/Type\s*\/Page\b/g)?.length ?? 0, pou).toBeGreaterThanOrEqual(pages);
    // What was put there for the printer is taken away again.
    await expect(page.locator('.printed')).toHaveCount(0);
  }
});
