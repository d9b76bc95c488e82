import { expect, test } from '../fixtures/test';
import { History } from '../pages/history';

for (const theme of ['dark', 'light', 'high contrast'])
  for (const [width, height] of [[1440, 900], [1024, 700]] as const)
    test(`${theme} ${width}`, async ({ openAs }) => {
      const mika = await openAs('Mika');
      await mika.page.setViewportSize({ width, height });
      await mika.page.reload();
      await mika.top.chooseTheme(theme);
      await mika.runs();
      const history = new History(mika.page);
      const take = (name: string) => mika.page.screenshot({ path: `/tmp/h/Rshots/${name}-${theme}-${width}.png` });
      await mika.showPanel('History');
      await take('empty');
      await mika.simulator.generate('Battery error');
      await mika.simulator.recover('Battery error');
      await mika.simulator.generate('Basic I/O Unit error');
      await mika.showPanel('History');
      await mika.page.waitForTimeout(6000);
      await history.sortBy('Generated');
      await take('full');
      await mika.page.locator('[data-pane=history]').getByRole('button', { name: 'Test record' }).click();
      await take('menu');
      await mika.page.keyboard.press('Escape');
      if (width === 1440) {
        const tab = await history.print();
        await tab.setViewportSize({ width: 1300, height: 900 });
        await tab.screenshot({ path: `/tmp/h/Rshots/html-${theme}.png`, fullPage: true });
        if (theme === 'dark') await tab.pdf({ path: '/tmp/h/Rshots/html.pdf', preferCSSPageSize: true, printBackground: true });
        await tab.close();
      }
      const xml = await history.save('Save as XML');
      await history.importFile(await xml.path());
      await expect(history.record).toContainText('An imported test record');
      await take('record');
    });
