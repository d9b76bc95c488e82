import { execFileSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect, test } from '../fixtures/test';
import { toFront } from '../pages/tabs';

test('a project is committed, and what another program committed in its folder is seen and taken', {
  tag: '@nightly',
}, async ({ openAs }) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const { page } = mika;
  const main = mika.editor('Main.st');
  const pane = page.locator('[data-pane=versions]');
  const history = pane.getByRole('list', { name: 'Versions', exact: true });
  const commit = async (message: string, button = 'Commit') => {
    await pane.getByRole('textbox', { name: 'What was changed, and why' }).fill(message);
    await pane.getByRole('button', { name: button, exact: true }).click();
  };
  let folder = '';
  const git = (...words: string[]) =>
    execFileSync('git', ['-c', 'user.name=Grace', '-c', 'user.email=grace@example.org', ...words], {
      cwd: folder,
      encoding: 'utf8',
    });

  await test.step('the project gets a folder, and its first commit has the name of who made it', async () => {
    await mika.top.picker.click();
    await page.getByRole('menuitem', { name: 'Versions of the program' }).click();
    await pane.getByRole('button', { name: 'Keep this project in git' }).click();
    await expect(pane).toContainText(/\d+ to commit/);
    await commit('The line as it was delivered');
    await expect(history).toContainText('The line as it was delivered');
    await expect(pane).toContainText('nothing to commit');
    folder = (await pane.getByText('main', { exact: true }).getAttribute('title'))?.replace(/^.*: /, '') ?? '';
    expect(git('log', '--format=%an: %s').trim()).toBe('Mika: The line as it was delivered');
  });

  await test.step('what is edited is compared with a commit', async () => {
    await toFront(page.getByRole('tab', { name: 'Main.st' }));
    await main.addBelow('motor := station.run;', '  lamp := NOT motor;');
    await toFront(page.getByRole('tab', { name: 'Versions' }));
    await history.getByRole('button', { name: /The line as it was delivered/ }).click();
    await expect(pane.getByRole('list', { name: 'Files that differ' })).toHaveText('Main.stchanged');
    await expect(pane.locator('.modified .view-line').filter({ hasText: 'lamp := NOT motor;' })).toBeVisible();
    await commit('The lamp shows that the motor stands still');
    await expect(history.getByRole('listitem').first()).toContainText('The lamp shows');
    expect(git('show', '--format=', '--numstat', 'HEAD').trim()).toBe('1\t0\tMain.st');
  });

  await test.step('what another program committed is named, and is taken into the editor', async () => {
    const theirs = git('show', 'HEAD:Main.st').replace('lamp := NOT motor;', 'lamp := motor;');
    writeFileSync(join(folder, 'Main.st'), theirs);
    git('commit', '-am', 'from elsewhere');
    await page.getByTestId('close:versions').click();
    await mika.top.picker.click();
    await page.getByRole('menuitem', { name: 'Versions of the program' }).click();
    await expect(pane.getByRole('status')).toContainText('Another program committed changes of Main.st');
    await history.getByRole('button', { name: /from elsewhere/ }).click();
    await pane.getByRole('button', { name: 'Take this file' }).click();
    await expect(pane).toContainText('All files are the same in both.');
    await expect(page.getByRole('tab', { name: 'Main.st, Not saved' })).toBeVisible();
    await toFront(page.getByRole('tab', { name: 'Main.st, Not saved' }));
    await main.save();
    await toFront(page.getByRole('tab', { name: 'Versions' }));
    await expect(pane.getByRole('status')).toHaveCount(0);
    await expect(pane).toContainText('nothing to commit');
  });
});
