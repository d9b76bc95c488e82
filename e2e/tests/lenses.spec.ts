import { expect, test } from '../fixtures/test';
import { run } from '../pages/everywhere';

test('numbers above declarations list what they count, and values stay beside their lines', {
  tag: '@nightly',
}, async ({ openAs }) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const main = mika.editor('Main.st');
  const station = mika.editor('Station.st');
  const numbers = (file: typeof main) => file.region.locator('.codelens-decoration');

  await main.open();
  await run(mika.page, 'Numbers of instances and references');
  await expect(numbers(main)).toHaveText('1 instance');
  await expect.poll(() => main.valuesAreBeside('uptime')).toBe(true);

  await mika.explorer.item('Station').dblclick();
  await expect(numbers(station)).toHaveText(/^1.instance.+1.reference$/);
  await numbers(station)
    .getByText(/^1.instance$/)
    .click();
  await expect(station.region.locator('.peekview-widget')).toContainText('station');
});
