import { expect, test } from '../fixtures/test';
import { toFront } from '../pages/tabs';

test('a file that somebody deletes closes for the others, but their edited text stays', { tag: '@nightly' }, async ({
  openAs,
}) => {
  const mika = await openAs('Mika');
  const jo = await openAs('Jo');
  for (const name of ['FB_Lift', 'FB_Gate']) {
    await mika.explorer.newFile(name);
    await expect(jo.explorer.item(name)).toBeVisible();
  }
  const [lift, gate] = [jo.editor('FB_Lift.st'), jo.editor('FB_Gate.st')];

  await test.step('the tab of an unedited text closes', async () => {
    await jo.explorer.item('FB_Lift').click();
    await expect(lift.line('FUNCTION_BLOCK FB_Lift').first()).toBeVisible();
    await mika.explorer.deleteFile('FB_Lift', 'FB_Lift.st');
    await expect(mika.explorer.item('FB_Lift')).toBeHidden();
    await expect(jo.explorer.item('FB_Lift')).toBeHidden();
    await expect(lift.tab).toBeHidden();
  });

  await test.step('an edited text stays, with a note who deleted the file', async () => {
    await jo.explorer.item('FB_Gate').click();
    await gate.addBelow('FUNCTION_BLOCK FB_Gate', '(* mine *)');
    await mika.explorer.deleteFile('FB_Gate', 'FB_Gate.st');
    await expect(gate.note).toContainText('Mika deleted FB_Gate.st.');
    await expect(gate.line('(* mine *)')).toBeVisible();
    await expect(jo.statusBar).toContainText('Not saved');
  });

  await test.step('it also stays after a reload', async () => {
    await jo.page.reload();
    await toFront(gate.tab);
    await expect(gate.note).toContainText('FB_Gate.st was deleted in the meantime.');
    await expect(gate.line('(* mine *)')).toBeVisible();
  });

  await test.step('after saving it is a file for everybody again', async () => {
    await gate.save();
    await expect(gate.note).toBeHidden();
    await expect(jo.statusBar).toContainText(/Saved \d\d:\d\d/);
    await expect(mika.explorer.item('FB_Gate')).toBeVisible();
    await mika.explorer.item('FB_Gate').click();
    await expect(mika.editor('FB_Gate.st').line('(* mine *)')).toBeVisible();
  });
});
