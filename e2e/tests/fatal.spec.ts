import { expect, test } from '../fixtures/test';

const ERROR = 'Memory error';

test('a fatal error stops the program, the page says why and how to continue, and the error is recovered', async ({
  openAs,
}) => {
  const mika = await openAs('Mika');
  await mika.runs();
  await mika.watch.add('A401.15');
  await mika.watch.add('A403.05');
  await mika.watch.set('start', 'TRUE');
  await mika.watch.shows('motor', 'TRUE');

  await test.step('the chosen detail determines code and flags', async () => {
    await mika.simulator.select(ERROR);
    await mika.simulator.choose('Part of the memory', /I\/O table checksum/);
    await mika.simulator.generate(ERROR);
    await expect(mika.simulator.word('A400')).toHaveText('80F4');
    await mika.watch.shows('A400', /80F4$/);
    await mika.watch.shows('A401.15', 'TRUE');
    await mika.watch.shows('A403.05', 'TRUE');
  });

  await test.step('the banner names code, cause and the next step', async () => {
    await expect(mika.banner).toContainText('80F4');
    await expect(mika.banner).toContainText(ERROR);
    await expect(mika.banner).toContainText('I/O table checksum');
    await expect(mika.banner).toContainText('Recover and go on clears the error');
  });

  await test.step('the program is stopped, the outputs are off', async () => {
    await expect(mika.top.state).toContainText('Fatal error');
    await mika.watch.shows('motor', 'FALSE');
    await mika.watch.shows('lamp', 'FALSE');
    const position = await mika.watch.number('Main.belt.position');
    await mika.watch.set('stop', 'TRUE');
    await mika.watch.set('stop', 'FALSE');
    expect(await mika.watch.number('Main.belt.position')).toBe(position);
  });

  await test.step('while the error is present, no mode starts the program, and the page says so', async () => {
    await mika.top.mode('RUN').click();
    await expect(mika.statusBar.getByRole('alert')).toContainText('fatal error');
    await expect(mika.top.state).toContainText('Fatal error');
  });

  await test.step('after clearing it, PROGRAM and then MONITOR start the program', async () => {
    await mika.banner.getByRole('button', { name: 'Clear error' }).click();
    await expect(mika.banner).toBeHidden();
    await expect(mika.simulator.word('A400')).toHaveText('0000');
    await mika.watch.shows('A401.15', 'FALSE');
    await mika.watch.shows('A403.05', 'FALSE');
    await expect(mika.top.state).toContainText('Stopped');
    await mika.top.chooseMode('PROGRAM');
    await expect(mika.top.state).toContainText('Stopped');
    await mika.top.chooseMode('MONITOR');
    await mika.runs();
    await expect(mika.statusBar.getByRole('alert')).toHaveCount(0);
    await mika.watch.set('start', 'FALSE');
    await mika.watch.set('start', 'TRUE');
    await mika.watch.shows('motor', 'TRUE');
  });
});
