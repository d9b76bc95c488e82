import { expect, test } from '../fixtures/test';

test('the tour: the sample is tried step by step, each step done at the real control', { tag: '@nightly' }, async ({
  openAs,
}) => {
  const mika = await openAs('Mika');
  const { page } = mika;
  await mika.runs();
  const tour = page.getByRole('region', { name: 'Tour' });
  const next = () => tour.getByRole('button', { name: 'Next', exact: true }).click();

  await test.step('it begins from an empty state, and says what to do', async () => {
    await page.getByRole('button', { name: 'Tour of the sample' }).first().click();
    await expect(tour).toContainText('Step 1 of');
    await expect(tour).toContainText('a belt, a counter of parts');
    await next();
  });

  await test.step('a write', async () => {
    await expect(tour).toContainText('type TRUE');
    await mika.watch.set('start', 'TRUE');
    await expect(tour).toContainText('motor becomes TRUE');
    await next();
  });

  await test.step('an error is raised and recovered, and the history has it', async () => {
    await mika.simulator.generate('Basic I/O Unit error');
    await expect(tour).toContainText('the program reacted');
    await next();
    await mika.simulator.recover('Basic I/O Unit error');
    await expect(tour).toContainText('The error is gone');
    await next();
    await mika.showPanel('History');
    await expect(tour).toContainText('listed as tested');
    await next();
  });

  await test.step('a reload keeps the step; a step can be skipped', async () => {
    await page.reload();
    await expect(tour).toContainText('Run all');
    await tour.getByRole('button', { name: 'Skip' }).click();
  });

  await test.step('halted, a step in and back, and on', async () => {
    await mika.debug.clickGutter('Main.st', 'belt(run := motor);');
    await expect(tour).toContainText('The PLC halts before this line');
    await next();
    await page.keyboard.press('F11');
    await expect(tour).toContainText('The program is in Belt now');
    await next();
    await page.keyboard.press('Shift+F10');
    await expect(tour).toContainText('The step was taken back');
    await next();
    await mika.debug.clickGutter('Main.st', 'belt(run := motor);');
    await page.keyboard.press('F5');
    await expect(mika.debug.frames).toHaveCount(2);
    await page.keyboard.press('F5');
    await expect(tour).toContainText('The program runs on');
    await next();
    await expect(tour).toContainText('That was the tour');
    await tour.getByRole('button', { name: 'Close the tour' }).click();
    await expect(tour).toBeHidden();
  });
});
