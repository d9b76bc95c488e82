import AxeBuilder from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import { expect, test } from '../fixtures/test';
import { eachPanel, LANGUAGES, pagesOf, prefer } from '../pages/everywhere';
import type { Ide } from '../pages/ide';

const THEMES = ['dark', 'light', 'contrast'];
for (const language of LANGUAGES) {
  test(`every panel and page in three themes: no finding of axe (${language})`, { tag: '@nightly' }, async ({
    openAs,
  }) => {
    const mika = await openAs('Mika');
    await atWork(mika);
    for (const theme of THEMES) {
      await test.step(theme, async () => {
        await prefer(mika, { language, theme });
        expect.soft(await findings(mika.page), 'the whole window').toEqual([]);
        const look = async (panel: string) => {
          // Of a theme only the colours are its own.
          expect.soft(await findings(mika.page, theme !== THEMES[0]), panel).toEqual([]);
        };
        await eachPanel(mika.page, look);
        for (const { name, open } of pagesOf(mika, language)) {
          await open();
          await look(name);
        }
      });
    }
  });
}

for (const language of LANGUAGES) {
  // A page of 1440 x 900 that is enlarged twice has so much room.
  test(`at 200 % nothing scrolls sideways, and F6 reaches every pane (${language})`, { tag: '@nightly' }, async ({
    openAs,
  }) => {
    const mika = await openAs('Mika');
    await mika.runs();
    await mika.page.setViewportSize({ width: 720, height: 450 });
    await prefer(mika, { language, theme: 'dark' });
    const sideways = () => mika.page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    await eachPanel(mika.page, async (panel) => {
      expect.soft(await sideways(), panel).toBeLessThanOrEqual(0);
      // What the window hides at its edge does not make it wider, and cannot be reached either.
      expect.soft(await cutButtons(mika.page), panel).toEqual([]);
    });
    const panes = await mika.page.locator('[data-pane]:visible').count();
    const reached = new Set<string>();
    for (let turn = 0; turn < 2 * panes; turn += 1) {
      await mika.page.keyboard.press('F6');
      reached.add(await mika.focusedPane());
    }
    expect(reached.size).toBe(panes);
    for (const { name, open } of pagesOf(mika, language)) {
      await open();
      expect.soft(await sideways(), name).toBeLessThanOrEqual(0);
    }
  });
}

/** The buttons of the error simulator, at the edge of the window, that are not whole. */
const cutButtons = (page: Page) =>
  page
    .locator('[data-pane=errors] button:visible')
    .evaluateAll((buttons) =>
      buttons.filter((button) => button.getBoundingClientRect().right > innerWidth).map((button) => button.textContent),
    );

async function atWork(mika: Ide): Promise<void> {
  await mika.runs();
  await expect(mika.editor('Main.st').line('PROGRAM Main').first()).toBeVisible();
  await mika.watch.set('start', 'TRUE');
  await mika.watch.fromMenu('lamp', 'Force to FALSE');
  await mika.watch.add('motr');
  await mika.simulator.generate('Basic I/O Unit error');
  await mika.goToPane('editor');
  await mika.page.keyboard.type('x');
  await expect(mika.statusBar).toContainText('Not saved');
}

/** What axe finds in the window, or only in the colours of its panels. */
async function findings(page: Page, colours = false): Promise<string[]> {
  const axe = new AxeBuilder({ page });
  const { violations } = await (colours ? axe.include('.dock').withRules('color-contrast') : axe).analyze();
  const grave = violations.filter(({ impact }) => impact === 'serious' || impact === 'critical');
  return grave.flatMap(({ id, impact, nodes }) =>
    nodes.map(
      (node) => `${impact} ${id}: ${node.target.join(' ')} ${node.any[0]?.message ?? node.all[0]?.message ?? ''}`,
    ),
  );
}
