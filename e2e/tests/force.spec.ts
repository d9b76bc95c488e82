import { expect, test } from '../fixtures/test';

test('a forced output stays as it is until it is released', async ({ openAs }) => {
  const mika = await openAs('Mika');
  await mika.runs();

  await test.step('forced to FALSE, start does not move it', async () => {
    await mika.watch.shows('motor', 'FALSE');
    await mika.watch.fromMenu('motor', 'Force to FALSE');
    await expect(mika.watch.releaseOf('motor')).toBeVisible();
    await expect(mika.statusBar).toContainText('1 forced');
    await mika.watch.set('start', 'TRUE');
    await mika.watch.add('Main.station.run');
    await mika.watch.shows('Main.station.run', 'TRUE');
    await mika.watch.shows('motor', 'FALSE');
  });

  await test.step('somebody who comes later, and a reload, see what is forced', async () => {
    const jo = await openAs('Jo');
    await expect(jo.statusBar).toContainText('1 forced');
    await expect(jo.watch.releaseOf('motor')).toBeVisible();
    await mika.page.reload();
    await expect(mika.watch.releaseOf('motor')).toBeVisible();
    await mika.watch.shows('motor', 'FALSE');
  });

  await test.step('released, it follows the program', async () => {
    await mika.watch.releaseOf('motor').click();
    await mika.watch.shows('motor', 'TRUE');
    await expect(mika.watch.releaseOf('motor')).toBeHidden();
    await expect(mika.statusBar).not.toContainText('forced');
  });
});
