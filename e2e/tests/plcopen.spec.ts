import { readFileSync } from 'node:fs';
import { expect, test } from '../fixtures/test';

const LINE = readFileSync(new URL('../../backend/tests/syntax/plcopen/line.xml', import.meta.url), 'utf8');
const DRAWN = '<condition><inline name=""><ST><xhtml:p>NOT go</xhtml:p></ST></inline></condition>';

test('a PLCopen file becomes a project that runs, drawn, and goes out again; what is not as it was is told', {
  tag: '@nightly',
}, async ({ openAs }) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const { page } = mika;
  const dialog = page.getByRole('dialog', { name: 'New project' });
  const choose = (name: string, text: string) =>
    dialog
      .getByLabel(/^Program files/)
      .setInputFiles({ name, mimeType: 'application/xml', buffer: Buffer.from(text, 'utf8') });

  await test.step('half a file is refused with words, and one with a drawn condition tells it', async () => {
    await mika.top.picker.click();
    await page.getByRole('menuitem', { name: 'New project…' }).click();
    await choose('half.xml', LINE.slice(0, 3000));
    await expect(dialog.getByRole('alert')).toContainText('this PLCopen file cannot be read: this is no XML');
    expect(LINE).toContain(DRAWN);
    await choose('drawn.xml', LINE.replace(DRAWN, '<condition><connectionPointIn/></condition>'));
    await expect(dialog.getByRole('list', { name: 'What is not as it was' })).toContainText(
      /Main: the condition of the transition of line \d+ is drawn; it is FALSE until it is written/,
    );
  });

  await test.step('the whole file is taken, built and runs', async () => {
    await choose('line.xml', LINE);
    await expect(dialog).toContainText('5 files');
    await expect(dialog.getByRole('list', { name: 'What is not as it was' })).toHaveCount(0);
    await dialog.getByRole('button', { name: 'Create' }).click();
    await expect(mika.top.picker).toContainText('Line');
    await mika.runs();
  });

  await test.step('its ladder is drawn, with power', async () => {
    await mika.explorer.item('Latch').first().dblclick();
    const sheet = page.getByRole('listbox', { name: 'Drawing of Latch.st' });
    await expect(sheet.getByRole('option', { name: 'Closed contact stop' })).toBeVisible();
    await expect(sheet.getByRole('option', { name: 'Coil late, set' })).toBeVisible();
    await mika.watch.add('main.go');
    await mika.watch.set('main.go', 'TRUE');
    await expect(sheet.locator('.el.on')).toHaveCount(6);
  });

  await test.step('it goes out: what the other form has no place for is told first; the file comes in again as it was', async () => {
    await mika.top.picker.click();
    await page.getByRole('menuitem', { name: 'Export as PLCopen XML…' }).click();
    const out = page.getByRole('dialog', { name: 'Export the program of Line' });
    await expect(out.getByRole('status')).toHaveText('All of the program is in the file.');
    await out.getByRole('radio', { name: 'IEC 61131-10' }).click();
    await expect(out.getByRole('list', { name: /^Left out/ })).toContainText('Main, the whole of it: a chart');
    await out.getByRole('radio', { name: 'PLCopen XML (TC6)' }).click();
    await expect(out.getByRole('status')).toHaveText('All of the program is in the file.');
    const [file] = await Promise.all([
      page.waitForEvent('download'),
      out.getByRole('button', { name: 'Save the file' }).click(),
    ]);
    expect(file.suggestedFilename()).toBe('Line.xml');
    await mika.top.picker.click();
    await page.getByRole('menuitem', { name: 'New project…' }).click();
    await choose('Line.xml', readFileSync(await file.path(), 'utf8'));
    await expect(dialog).toContainText('5 files');
    await expect(dialog.getByRole('list', { name: 'What is not as it was' })).toHaveCount(0);
  });
});

const L5X = readFileSync(new URL('../../backend/tests/syntax/l5x/line.L5X', import.meta.url), 'utf8');

test('a file of Studio 5000 becomes a project that runs; which routines were left out is told', {
  tag: '@nightly',
}, async ({ openAs }) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const { page } = mika;
  const dialog = page.getByRole('dialog', { name: 'New project' });
  await mika.top.picker.click();
  await page.getByRole('menuitem', { name: 'New project…' }).click();
  await dialog
    .getByLabel(/^Program files/)
    .setInputFiles({ name: 'line.L5X', mimeType: 'application/xml', buffer: Buffer.from(L5X, 'utf8') });
  await expect(dialog.getByRole('list', { name: 'What is not as it was' })).toContainText(
    'MainProgram.Drawn: the routine Drawn is written in FBD; it is left out',
  );
  await dialog.getByRole('button', { name: 'Create' }).click();
  await expect(mika.top.picker).toContainText('Line');
  await mika.runs();
  await mika.watch.add('MainProgram_1.Delay.DN');
  await mika.watch.shows('MainProgram_1.Delay.DN', 'TRUE');
});
