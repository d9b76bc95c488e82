import { filling } from '../fixtures/filling';
import { expect, test } from '../fixtures/test';

test('an I/O unit fails: the rungs of the filling machine show what stops it, the verdict is acted, and it goes on when it is acknowledged', {
  tag: '@nightly',
}, async ({ openAs, server }) => {
  const mika = await openAs('Mika', await filling(server));
  const { page, simulator, watch } = mika;
  await mika.runs();
  const rung = (file: string, title: string) =>
    page.getByRole('listbox', { name: `Drawing of ${file}` }).getByRole('group', { name: new RegExp(title) });

  await test.step('bottles are filled', async () => {
    await watch.set('start', 'TRUE');
    await watch.shows('valve', 'TRUE');
    await watch.set('start', 'FALSE');
    await mika.explorer.item('Interlocks').dblclick();
    await expect(page.getByText(/^As the code saw it in scan \d/)).toBeVisible();
    await expect(rung('Interlocks.st', 'Something may move').locator('.el.on')).toHaveCount(3);
  });

  await test.step('the output unit fails: nothing may move any more', async () => {
    await page.getByPlaceholder('Filter by name, code, flag').fill('009A');
    await simulator.box('Basic I/O Unit error, Outputs, Rack number 0, Slot number 1').check();
    await simulator.generateButton.click();
    await watch.shows('lampRed', 'TRUE');
    await expect(rung('Interlocks.st', 'Something may move').locator('.el.on')).toHaveCount(0);
    await expect(simulator.reaction).toContainText('Acted');
    await mika.explorer.item('Alarms').dblclick();
    await expect(rung('Alarms.st', 'positions and drives').locator('.el.on')).toHaveCount(2);
  });

  await test.step('it recovers: the alarm stays until somebody acknowledges it', async () => {
    await page.getByRole('button', { name: 'Recover', exact: true }).click();
    await expect(rung('Alarms.st', 'positions and drives').locator('.el.on')).toHaveCount(1); // the coil stays set
    await watch.shows('lampRed', 'TRUE');
    await watch.set('ack', 'TRUE');
    await watch.shows('lampRed', 'FALSE');
    await mika.explorer.item('Interlocks').dblclick();
    await expect(rung('Interlocks.st', 'Something may move').locator('.el.on')).toHaveCount(3);
  });
});
