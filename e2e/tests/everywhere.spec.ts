import AxeBuilder from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import { expect, test } from '../fixtures/test';
import type { Ide } from '../pages/ide';

const THEMES = ['dark', 'light', 'contrast'];
/** Commands that open a page among the files, as the palette of each language calls them. */
const PAGES = {
  en: [
    'Show all inputs and outputs',
    'Show memory',
    'Variables the program never reads',
    'Edit user-defined errors',
    'Show error sweeps',
    'Versions of the program',
  ],
  ja: [
    'すべての入出力を表示',
    'メモリを表示',
    'プログラムが読み出さない変数',
    'ユーザー定義異常を編集',
    '異常スイープを表示',
    'プログラムの版',
  ],
};

for (const language of ['en', 'ja'] as const) {
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
        for (const page of PAGES[language]) {
          await run(mika.page, page);
          await look(page);
        }
      });
    }
  });
}

for (const language of ['en', 'ja'] as const) {
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
    });
    const panes = await mika.page.locator('[data-pane]:visible').count();
    const reached = new Set<string>();
    for (let turn = 0; turn < 2 * panes; turn += 1) {
      await mika.page.keyboard.press('F6');
      reached.add(await mika.focusedPane());
    }
    expect(reached.size).toBe(panes);
  });
}

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

/** As if it had been chosen in the menu, whose words are different ones in each language. */
async function prefer({ page, top }: Ide, prefs: { language: string; theme: string }): Promise<void> {
  await page.evaluate((wanted) => {
    const kept = JSON.parse(localStorage.getItem('scanbench.prefs') ?? '{}');
    localStorage.setItem('scanbench.prefs', JSON.stringify({ ...kept, ...wanted }));
    for (const key of Object.keys(localStorage)) if (key.startsWith('scanbench.layout')) localStorage.removeItem(key);
  }, prefs);
  await page.reload();
  await expect(page.locator('html')).toHaveAttribute('lang', prefs.language);
  await expect(page.locator('html')).toHaveAttribute('data-theme', prefs.theme);
  await expect(page.getByTestId('scan')).toHaveText(/[0-9]/);
  await top.scansGoOn();
}

/** A command of the palette. */
async function run(page: Page, command: string): Promise<void> {
  await page.keyboard.press('F1');
  const box = page.getByRole('dialog').getByRole('combobox');
  await box.pressSequentially(command);
  await page.keyboard.press('Enter');
  await expect(page.getByRole('dialog')).toBeHidden();
}

/** Each tab of the dock, one after the other. */
async function eachPanel(page: Page, look: (panel: string) => Promise<void>): Promise<void> {
  const tabs = page.getByRole('tab');
  await expect(tabs.first()).toBeVisible();
  for (const tab of await tabs.all()) {
    await tab.click();
    await look((await tab.textContent()) ?? '');
  }
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
