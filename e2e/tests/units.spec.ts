import type { Page } from '@playwright/test';
import { expect, test } from '../fixtures/test';

const SPECIAL = 'Special I/O Unit error';
const INPUTS = `${SPECIAL}, Analog inputs, Unit number 3`;
const OUTPUTS = `${SPECIAL}, Analog outputs, Unit number 20`;

/** Adds one of a kind on the page Hardware, as the row after those that are there. */
async function addUnit(page: Page, kind: string, number: number, name: string): Promise<void> {
  const section = page.locator('[data-pane=hardware]').getByRole('region', { name: kind, exact: true });
  const before = await section.locator('[data-fitted]').count();
  await section.getByRole('button', { name: `Add: ${kind}` }).click();
  const row = section.locator('[data-fitted]').nth(before);
  await row.getByRole('spinbutton').first().fill(`${number}`);
  await row.getByRole('textbox', { name: /: (Name|Text)$/ }).fill(name);
}

test('two units are fitted: both are raised, with a row each; one is recovered, the other stays', {
  tag: '@nightly',
}, async ({ openAs }) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const { simulator, page } = mika;
  await expect(simulator.error(SPECIAL)).toContainText('Never');
  await expect(simulator.box(INPUTS)).toHaveCount(0);

  await test.step('they are fitted on the page Hardware, and the next build has the units below their kind', async () => {
    await page.getByRole('button', { name: 'Error simulator: actions' }).click();
    await page.getByRole('menuitem', { name: 'Hardware' }).click();
    await page.getByRole('button', { name: 'Say what is fitted' }).click();
    await addUnit(page, 'Special I/O Units', 3, 'Analog inputs');
    await addUnit(page, 'Special I/O Units', 20, 'Analog outputs');
    await addUnit(page, 'FAL numbers', 42, 'pump overpressure');
    const hardware = page.locator('[data-pane=hardware]');
    await hardware.getByRole('button', { name: 'Save', exact: true }).click();
    await expect(hardware.getByRole('button', { name: 'Save', exact: true })).toBeDisabled();
    const main = mika.editor('Main.st');
    await main.open();
    await main.build();
    await expect(simulator.error(INPUTS)).toContainText('Never');
    await expect(simulator.error(OUTPUTS)).toContainText('Never');
    await expect(simulator.error('CPU Bus Unit error')).toContainText('not fitted');
    await expect(simulator.error('FAL error, pump overpressure, FAL number 42')).toBeVisible();
  });

  await test.step('both are raised at once', async () => {
    await simulator.box(INPUTS).check();
    await simulator.box(OUTPUTS).check();
    await simulator.generateButton.click();
    await expect(simulator.error(INPUTS)).toContainText('Generated');
    await expect(simulator.error(OUTPUTS)).toContainText('Generated');
    await expect(simulator.error(INPUTS)).toContainText('0303');
    await expect(simulator.error(OUTPUTS)).toContainText('0314');
  });

  await test.step('one is recovered, the other stays', async () => {
    await simulator.box(OUTPUTS).uncheck();
    await page.getByRole('button', { name: 'Recover', exact: true }).click();
    await expect(simulator.error(INPUTS)).toContainText('Cleared');
    await expect(simulator.error(OUTPUTS)).toContainText('Generated');
    await expect(simulator.error(SPECIAL)).toContainText('Generated');
  });
});
