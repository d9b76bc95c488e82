/** Every panel and page, in each language. */
import { expect, type Locator, type Page } from '@playwright/test';
import type { Ide } from './ide';
import { toFront } from './tabs';

export const LANGUAGES = ['en', 'ja'] as const;

/** Commands that open a page among the files, as the palette of each language calls them. */
export const PAGES = {
  en: [
    'Show all inputs and outputs',
    'Show memory',
    'Show the communication unit',
    'Variables the program never reads',
    'Edit user-defined errors',
    'Show error sweeps',
    'Versions of the program',
  ],
  ja: [
    'すべての入出力を表示',
    'メモリを表示',
    '通信ユニットを表示',
    'プログラムが読み出さない変数',
    'ユーザー定義異常を編集',
    '異常スイープを表示',
    'プログラムの版',
  ],
};

/** Pages of what the PLC itself consists of and reports. */
export const DEVICE_PAGES = {
  en: ['Edit what hardware is fitted', "Show the PLC's own errors"],
  ja: ['実装ハードウェアを編集', 'PLC自身の異常を表示'],
};

const HELP = { en: 'Contents of the help', ja: 'ヘルプの目次' };
const PICKER = {
  en: ['Project and instance', 'Compare runs…'],
  ja: ['プロジェクトとインスタンス', '実行を比較…'],
} as const;

const HISTORY = { en: ['Panel: History', 'Test record'], ja: ['パネル: 履歴', '試験成績書'] } as const;

/** All pages, each with what opens it. */
export function pagesOf(ide: Ide, language: (typeof LANGUAGES)[number]): { name: string; open: () => Promise<void> }[] {
  const { page } = ide;
  const [picker, compare] = PICKER[language];
  const [history, testRecord] = HISTORY[language];
  return [
    ...[...PAGES[language], ...DEVICE_PAGES[language], HELP[language]].map((name) => ({
      name,
      open: () => run(page, name),
    })),
    {
      name: compare,
      open: async () => {
        await page.getByRole('button', { name: picker }).click();
        await page.getByRole('menuitem', { name: compare }).click();
        await expect(page.locator('[data-pane=compare]')).toBeVisible();
      },
    },
    {
      name: testRecord,
      open: async () => {
        await run(page, history);
        await expect(page.locator('[data-pane=history]').getByRole('button', { name: testRecord })).toBeVisible();
        const [, instance] = /\/i\/(\d+)/.exec(page.url()) ?? [];
        const xml = await page.request.get(new URL(`/api/instances/${instance}/record?format=xml`, page.url()).href);
        await page
          .locator('[data-pane=history] input[type=file]')
          .setInputFiles({ name: 'record.xml', mimeType: 'text/xml', buffer: await xml.body() });
        await expect(page.locator('[data-pane=record]').getByRole('table')).toBeVisible();
      },
    },
    {
      name: 'Operation.panel.json',
      open: async () => {
        await page.keyboard.press('Control+P');
        await page.getByRole('dialog').getByRole('combobox').fill('Operation');
        await page
          .getByRole('option', { name: /^Operation/ })
          .first()
          .click();
        await expect(page.locator('[data-pane=operator]')).toBeVisible();
      },
    },
    {
      name: 'calls',
      open: async () => {
        await toFront(page.getByRole('tab', { name: /^Main[.]st/ }));
        await ide.goToPane('editor');
        await page.keyboard.press('Shift+Alt+H');
        await expect(page.locator('[data-pane=calls]')).toBeVisible();
      },
    },
  ];
}

/** As if it had been chosen in the menu, whose words are different ones in each language. */
export async function prefer({ page, top }: Ide, prefs: { language: string; theme: string }): Promise<void> {
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
export async function run(page: Page, command: string): Promise<void> {
  await page.keyboard.press('Control+Shift+P');
  const box = page.getByRole('dialog').getByRole('combobox');
  await box.pressSequentially(command);
  await page.keyboard.press('Enter');
  await expect(page.getByRole('dialog')).toBeHidden();
}

/** Each tab of the dock, one after the other. */
export async function eachPanel(page: Page, look: (panel: string, tab: Locator) => Promise<void>): Promise<void> {
  const tabs = page.getByRole('tab');
  await expect(tabs.first()).toBeVisible();
  for (const tab of await tabs.all()) {
    await tab.click();
    await look((await tab.textContent()) ?? '', tab);
  }
}
