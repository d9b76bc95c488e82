import AxeBuilder from '@axe-core/playwright';
import { expect, test } from '../fixtures/test';

test('the memory of the PLC: looked at, written, searched, by keyboard; in the past it is that of the scan', {
  tag: '@nightly',
}, async ({ openAs }) => {
  const jo = await openAs('Jo');
  await jo.runs();
  const { page } = jo;
  const pane = page.locator('[data-pane=memory]');
  const word = (address: string) => pane.getByTestId(`memory:${address}`);

  await test.step('a variable leads to its word, which names it', async () => {
    await page.keyboard.press('Control+Shift+P');
    await page.getByRole('combobox', { name: 'Commands' }).pressSequentially('show memory');
    await page.getByRole('option', { name: 'Show memory' }).click();
    await pane.getByRole('combobox', { name: 'Go to address or variable' }).fill('bufferLevel');
    await page.keyboard.press('Enter');
    await expect(word('D110')).toHaveAttribute('aria-selected', 'true');
    await expect(pane.getByRole('region', { name: 'Word D110' })).toContainText('bufferLevel');
    await expect(word('D110').locator('.txt')).toHaveText(/^00[0-9A-F]{2}$/);
  });

  await test.step('a word is written in the format of the grid, and found by its value', async () => {
    await pane.getByRole('combobox', { name: 'Go to address or variable' }).fill('D20000');
    await page.keyboard.press('Enter');
    await expect(word('D20000')).toHaveAttribute('aria-selected', 'true');
    await pane.getByRole('grid').focus();
    await page.keyboard.type('beef');
    await page.keyboard.press('Enter');
    await expect(word('D20000').locator('.txt')).toHaveText('BEEF');
    await page.keyboard.press('Control+Home');
    await pane.getByRole('textbox', { name: 'Find a value' }).fill('beef');
    await page.keyboard.press('Enter');
    await expect(pane.getByRole('status')).toContainText('Found');
    await expect(word('D20000')).toHaveAttribute('aria-selected', 'true');
  });

  await test.step('what tools may not write is refused with the reason', async () => {
    await pane.getByRole('combobox', { name: 'Go to address or variable' }).fill('A400');
    await page.keyboard.press('Enter');
    await expect(word('A400')).toHaveAttribute('aria-selected', 'true');
    await pane.getByRole('grid').focus();
    await page.keyboard.type('1');
    await page.keyboard.press('Enter');
    await expect(pane.getByRole('alert')).toContainText('read-only');
    await page.keyboard.press('Escape');
    const { violations } = await new AxeBuilder({ page }).include('[data-pane=memory]').analyze();
    expect(violations.map(({ id, nodes }) => `${id}: ${nodes[0]?.html}`)).toEqual([]);
  });

  await test.step('in the past it is the memory before that scan', async () => {
    await pane.getByRole('combobox', { name: 'Go to address or variable' }).fill('D20000');
    await page.keyboard.press('Enter');
    await expect(word('D20000').locator('.txt')).toHaveText('BEEF');
    await jo.timeline.goTo(1);
    await expect(word('D20000').locator('.txt')).toHaveText('0000');
    await page.keyboard.press('Shift+Escape');
    await expect(word('D20000').locator('.txt')).toHaveText('BEEF');
  });
});
