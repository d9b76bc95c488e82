import { expect, test } from '../fixtures/test';

const BATTERY = 'Battery error';

test('a battery error outlives a power cycle, and nothing but recovering it ends it', { tag: '@nightly' }, async ({
  openAs,
}) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const { simulator } = mika;
  await simulator.generate(BATTERY);
  await mika.watch.add('A402.04');
  await mika.watch.shows('A402.04', 'TRUE');
  await mika.watch.add('W500');

  /** A word that is not retained says that the power was off. */
  async function powerCycle(): Promise<void> {
    await mika.watch.set('W500', '4711');
    await mika.watch.shows('W500', /4711|1267/);
    await mika.top.restart('Power cycle');
    await mika.watch.shows('W500', /^(16#0+|0)$/);
    await mika.runs();
  }

  await test.step('after the power cycle the flag is on again, and the error still there', async () => {
    await powerCycle();
    await mika.watch.shows('A402.04', 'TRUE');
    await expect(simulator.error(BATTERY)).toContainText('Generated');
  });

  await test.step('where its facts come from is said fact by fact', async () => {
    await simulator.select(BATTERY);
    await simulator.details.getByText(/Sources: \d+ of \d+ facts verified/).click();
    const facts = simulator.details.getByRole('table', { name: 'Sources of the facts' });
    await expect(facts.getByRole('row', { name: /Flag A402\.04/ })).toContainText('SYM');
  });

  await test.step('recovered, it stays away over the next power cycle', async () => {
    await simulator.recover(BATTERY);
    await powerCycle();
    await mika.watch.shows('A402.04', 'FALSE');
    await expect(simulator.error(BATTERY)).toContainText('Cleared');
  });
});
