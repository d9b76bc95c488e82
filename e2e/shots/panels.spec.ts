/** A picture of each panel and page for the docs, in both languages: `make shots` takes them again. */
import { resolve } from 'node:path';
import type { Locator } from '@playwright/test';
import { test } from '../fixtures/test';
import { eachPanel, LANGUAGES, PAGES, prefer, run } from '../pages/everywhere';

const FOLDER = resolve(import.meta.dirname, '../../docs/shots/panels');

for (const language of LANGUAGES)
  test(`each panel and page (${language})`, async ({ openAs }) => {
    const mika = await openAs('Mika Lind');
    const { page } = mika;
    await mika.runs();
    await mika.watch.set('start', 'TRUE');
    await mika.watch.fromMenu('lamp', 'Force to FALSE');
    await mika.simulator.generate('Basic I/O Unit error');
    await prefer(mika, { language, theme: 'light' });
    let number = 0;
    const take = async (around: Locator) => {
      number += 1;
      await page.mouse.move(0, 0);
      const path = resolve(FOLDER, `${String(number).padStart(2, '0')}-${language}.png`);
      await around.screenshot({ path, animations: 'disabled' });
    };
    const group = page.locator('.dv-groupview');
    await eachPanel(page, async (_, tab) =>
      take(tab.locator('xpath=ancestor::*[contains(@class, "dv-groupview")][1]')),
    );
    for (const command of PAGES[language]) {
      await run(page, command);
      await take(group.filter({ has: page.getByRole('tab', { selected: true }) }).first());
    }
  });
