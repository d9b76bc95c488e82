import { expect, test } from '../fixtures/test';

test('a forbidden write is refused in its row, with the reason', { tag: '@nightly' }, async ({ openAs }) => {
  const mika = await openAs('Mika');
  await mika.runs();

  await test.step('an error flag belongs to the CPU', async () => {
    await mika.watch.write('A402.12', 'TRUE');
    await expect(mika.watch.refusal).toContainText('Not written.');
    await expect(mika.watch.refusal).toContainText('A402');
    await expect(mika.watch.refusal).toContainText(/read|error simulator/);
    await mika.watch.shows('A402.12', 'FALSE');
    await mika.page.keyboard.press('Escape');
    await expect(mika.watch.refusal).toHaveCount(0);
  });

  await test.step('letters are not an INT; the entry stays so that it can be corrected', async () => {
    await mika.watch.write('Main.parts.total', 'abc');
    await expect(mika.watch.refusal).toContainText('abc');
    await expect(mika.watch.refusal).toContainText('INT');
    await expect(mika.watch.entry('Main.parts.total')).toHaveValue('abc');
    await mika.watch.write('Main.parts.total', '70000');
    await expect(mika.watch.refusal).toContainText('32767');
    await mika.watch.set('bufferLevel', '12');
    await mika.page.keyboard.press('Escape');
  });

  await test.step('an unknown path offers similar paths', async () => {
    await mika.watch.add('motr');
    const unknown = mika.watch.refusal.filter({ hasText: 'Not known.' });
    await expect(unknown).toContainText('motr');
    await mika.watch.table.getByRole('button', { name: 'motor', exact: true }).click();
    await expect(unknown).toHaveCount(0);
  });
});
