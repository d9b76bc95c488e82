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

test('two people save the same file: nothing is lost, and the second one chooses', async ({ openAs }) => {
  const mika = await openAs('Mika');
  const jo = await openAs('Jo');
  const [mine, theirs] = [mika.editor('Main.st'), jo.editor('Main.st')];

  await test.step('Mika saves first, Jo sees both texts', async () => {
    await mine.addBelow('uptime : TIME;', '  mikas     : INT;');
    await theirs.addBelow('uptime : TIME;', '  jos       : INT;');
    await mine.save();
    await expect(mika.statusBar).toContainText(/Saved \d\d:\d\d/);
    await theirs.save();
    await expect(theirs.conflict).toContainText('Mika saved Main.st first');
    await expect(theirs.conflict.getByText('mikas')).toBeVisible();
    await expect(theirs.conflict.getByText('jos')).toBeVisible();
  });

  await test.step('Jo keeps her own, and Mika sees it', async () => {
    await theirs.conflict.getByRole('button', { name: 'Keep mine' }).click();
    await expect(theirs.conflict).toBeHidden();
    await expect(jo.statusBar).toContainText(/Saved \d\d:\d\d/);
    await expect(mine.line('jos : INT;')).toBeVisible();
    await expect(mine.line('mikas : INT;')).toHaveCount(0);
  });

  await test.step('a second time Mika takes the other text', async () => {
    await theirs.addBelow('jos : INT;', '  josToo    : INT;');
    await mine.addBelow('uptime : TIME;', '  mikasToo  : INT;');
    await theirs.save();
    await expect(jo.statusBar).toContainText(/Saved \d\d:\d\d/);
    await mine.save();
    await mine.conflict.getByRole('button', { name: 'Take theirs' }).click();
    await expect(mine.conflict).toBeHidden();
    await expect(mine.line('josToo : INT;')).toBeVisible();
    await expect(mine.line('mikasToo : INT;')).toHaveCount(0);
    await expect(mika.statusBar).not.toContainText('Not saved');
  });
});
