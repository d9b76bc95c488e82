import { expect, test } from '../fixtures/test';
import { toFront } from '../pages/tabs';

test('a forced output keeps its value until the force is released', async ({ openAs }) => {
  const mika = await openAs('Mika');
  await mika.runs();

  await test.step('a double click writes the other value of a BOOL, the menu writes either', async () => {
    await mika.watch.value('reset').dblclick();
    await mika.watch.shows('reset', 'TRUE');
    await mika.watch.fromMenu('reset', 'Write FALSE');
    await mika.watch.shows('reset', 'FALSE');
  });

  await test.step('forced to FALSE, it does not follow start', async () => {
    await mika.watch.shows('motor', 'FALSE');
    await mika.watch.fromMenu('motor', 'Force to FALSE');
    await expect(mika.watch.releaseOf('motor')).toBeVisible();
    await expect(mika.statusBar).toContainText('1 forced');
    await mika.watch.set('start', 'TRUE');
    await mika.watch.add('Main.station.run');
    await mika.watch.shows('Main.station.run', 'TRUE');
    await mika.watch.shows('motor', 'FALSE');
  });

  await test.step('a second person sees the force, also after a reload', async () => {
    const jo = await openAs('Jo');
    await expect(jo.statusBar).toContainText('1 forced');
    await expect(jo.watch.releaseOf('motor')).toBeVisible();
    await mika.page.reload();
    await expect(mika.watch.releaseOf('motor')).toBeVisible();
    await mika.watch.shows('motor', 'FALSE');
  });

  await test.step('the panel of the forces shows the program’s value, the author and the scan', async () => {
    const jo = await openAs('Ada');
    await jo.page.getByRole('button', { name: '1 forced' }).click();
    await expect(jo.forces.row('motor')).toContainText('Mika');
    await expect(jo.forces.row('motor').getByRole('gridcell').nth(1)).toHaveText('FALSE');
    await expect(jo.page.getByTestId('now:motor')).toHaveText('FALSE');
    await expect(jo.forces.cell('motor', 'After program')).toHaveText('TRUE');
    await expect(jo.forces.cell('motor', 'After force')).toHaveText('FALSE');
    await toFront(jo.page.getByRole('tab', { name: 'Watch', exact: true }));
    await expect(jo.watch.row('motor')).toContainText('program writes TRUE');
    await jo.watch.fromMenu('lamp', 'Force to FALSE');
    await mika.page.getByRole('button', { name: '2 forced' }).click();
    await expect(mika.forces.row('lamp')).toContainText('Ada');
    await mika.forces.release('lamp');
    await expect(jo.watch.releaseOf('lamp')).toBeHidden();
    await toFront(mika.page.getByRole('tab', { name: 'Watch', exact: true }));
  });

  await test.step('after the release it follows the program', async () => {
    await mika.watch.releaseOf('motor').click();
    await mika.watch.shows('motor', 'TRUE');
    await expect(mika.watch.releaseOf('motor')).toBeHidden();
    await expect(mika.statusBar).not.toContainText('forced');
  });
});
