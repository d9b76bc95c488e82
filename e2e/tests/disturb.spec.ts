import { expect, test } from '../fixtures/test';
import { Disturb } from '../pages/disturb';

test('inputs, memory and results are disturbed: everybody sees the disturbances, and can take them back', {
  tag: '@nightly',
}, async ({ openAs }) => {
  const mika = await openAs('Mika');
  const jo = await openAs('Jo');
  const disturb = new Disturb(mika.page);
  const others = new Disturb(jo.page);
  await mika.runs();
  await jo.runs();
  await others.show();
  await expect(others.pane).toContainText('No disturbance is active');

  await test.step('an incomplete form says what is missing, and the entries stay', async () => {
    await disturb.show();
    await disturb.button.click();
    await expect(disturb.refusal).toContainText('Enter a variable or an address.');
    await disturb.path.fill('Main.belt.positon');
    await disturb.button.click();
    await expect(disturb.refusal).toContainText('positon');
    await disturb.refusal.getByRole('button', { name: 'Main.belt.position' }).click();
    await expect(disturb.path).toHaveValue('Main.belt.position');
    await disturb.field('Bit').fill('64');
    await disturb.button.click();
    await expect(disturb.refusal).toContainText(/bit/i);
    await expect(disturb.path).toHaveValue('Main.belt.position');
    await disturb.field('Bit').fill('x');
    await expect(disturb.refusal).toContainText('Enter a bit');
  });

  await test.step('the program offers its variables', async () => {
    await disturb.path.fill('Main.belt.pos');
    await expect(mika.page.getByRole('option', { name: 'Main.belt.position' })).toBeVisible();
    await disturb.path.press('ArrowDown');
    await disturb.path.press('Enter');
    await expect(disturb.path).toHaveValue('Main.belt.position');
  });

  await test.step('a bit flips at once, and the timeline shows the scan', async () => {
    await disturb.field('Bit').fill('3');
    await disturb.button.click();
    await expect(disturb.told).toContainText('Memory Main.belt.position, bit 3');
    await expect(mika.page.getByRole('button', { name: /^(Disturbance: |\d+ marks)/ }).first()).toBeVisible();
    await jo.showPanel('Events');
    await expect(jo.page.locator('[data-pane="log"]')).toContainText('Memory Main.belt.position, bit 3');
  });

  await test.step('an input is stuck: set in the watch table, until somebody else takes it back', async () => {
    await mika.watch.fromMenu('start', 'Disturb…');
    await expect(disturb.path).toHaveValue('start');
    await disturb.kind('Stuck input');
    await mika.page.getByRole('checkbox', { name: 'until taken back' }).check();
    await disturb.button.click();
    await expect(disturb.line('start')).toContainText('Active');
    await expect(others.line('start')).toContainText('by Mika');
    await mika.watch.set('start', 'TRUE');
    await mika.watch.shows('start', 'FALSE');
    await others.takeBack('start');
    await expect(disturb.pane).toContainText('No disturbance is active');
    await mika.watch.shows('start', 'TRUE');
    await mika.watch.shows('motor', 'TRUE');
  });

  await test.step('the result of a statement is corrupted: set in the editor, at random, reproducibly', async () => {
    const editor = mika.editor('Main.st');
    await editor.reveal('heartbeat := NOT heartbeat');
    await editor.fromMenu('heartbeat := NOT heartbeat', 'Corrupt this result…');
    await expect(disturb.field('Statement')).toHaveValue(/^Main\.st:\d+$/);
    await disturb.when('At random');
    await disturb.field('Probability per scan').fill('120 %');
    await disturb.button.click();
    await expect(disturb.refusal).toContainText('Enter a probability');
    await disturb.field('Probability per scan').fill('1/2');
    await disturb.button.click();
    await expect(disturb.line('Main.st')).toContainText('by Mika');
    await expect(disturb.line('Main.st')).toContainText(/happened/, { timeout: 60_000 });
  });

  await test.step('several disturbances are taken back at once', async () => {
    await disturb.kind('Bit flip');
    await disturb.path.fill('D500');
    await disturb.field('Bit').fill('0');
    await disturb.when('In a scan');
    await disturb.field('Scan').fill('1');
    await disturb.button.click();
    await expect(disturb.refusal).toContainText('This scan is over');
    await disturb.field('Scan').fill('900 000 000');
    await disturb.button.click();
    await expect(disturb.line('D500')).toContainText('Waiting');
    await expect(disturb.list).toContainText('2 disturbances');
    await disturb.list.getByRole('button', { name: 'Take all back' }).click();
    await expect(disturb.pane).toContainText('No disturbance is active');
  });

  await test.step('in the past nothing can be disturbed', async () => {
    await mika.timeline.click(0.5);
    await mika.page.getByRole('button', { name: 'Show everybody' }).click();
    await expect(mika.timeline.banner).toBeVisible();
    await expect(disturb.button).toBeDisabled();
    await mika.timeline.returnToLive();
    await expect(disturb.button).toBeEnabled();
  });
});
