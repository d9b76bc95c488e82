import { expect, test } from '../fixtures/test';
import { toFront } from '../pages/tabs';

const PANELS = {
  Watch: 'The watch table and the forces',
  Trace: 'Trace',
  Verification: 'Verification',
  Forces: 'The watch table and the forces',
  Problems: 'Problems',
  Search: 'Projects: files, versions, in and out',
  Diagnostics: 'Subranges',
  Events: 'The window',
  History: 'The error simulator',
  Console: 'The window',
  Disturbances: 'Verification',
  'Error simulator': 'The error simulator',
};

test('F1 explains every panel, and links and the search lead on', { tag: '@nightly' }, async ({ openAs }) => {
  const mika = await openAs('Mika');
  const { page } = mika;
  await mika.runs();
  const article = page.getByRole('article');
  for (const [panel, title] of Object.entries(PANELS)) {
    await test.step(panel, async () => {
      const tab = page.getByRole('tab', { name: panel, exact: true });
      await toFront(tab);
      await tab.focus();
      await page.keyboard.press('F1');
      await expect(article.getByRole('heading', { level: 1 })).toHaveText(title);
      // What is explained stays in sight.
      await expect(tab).toHaveAttribute('aria-selected', 'true');
    });
  }

  await test.step('the block at the caret', async () => {
    // It was covered: at the right, where the help is else, the error simulator is explained.
    await toFront(mika.editor('Main.st').tab);
    await mika.editor('Main.st').line('consume   : TON').first().click();
    await page.keyboard.press('Home');
    for (let step = 0; step < 12; step += 1) await page.keyboard.press('ArrowRight');
    await page.keyboard.press('F1');
    await expect(article.getByRole('row', { name: /^TON\(/ })).toBeInViewport();
  });

  await test.step('a search, and a window of its own', async () => {
    await page.getByRole('searchbox', { name: 'Search the help' }).fill('D001');
    await page.getByRole('list', { name: 'Found in the help' }).getByRole('button').first().click();
    await expect(article.getByRole('heading', { level: 1 })).toHaveText('D001: name declared twice');
    await article.focus();
    await page.keyboard.press('F6');
  });
});
