/** Drawn with the mouse alone: no key is pressed. */
import type { Locator, Page } from '@playwright/test';
import { drawing } from '../fixtures/drawing';
import { expect, test } from '../fixtures/test';

const head = `FUNCTION_BLOCK Hold
VAR_INPUT go, halt : BOOL; END_VAR
VAR_OUTPUT on : BOOL; END_VAR
`;
const hold = (body: string) => ({
  block: 'Hold',
  text: `${head}${body}\nEND_FUNCTION_BLOCK\n`,
  variables: 'hold : Hold;',
  calls: 'hold(go := start, halt := stop);',
});

/** Buttons, and names that are offered; each click is counted. */
class Mouse {
  clicks = 0;

  constructor(
    private readonly page: Page,
    private readonly sheet: Locator,
  ) {}

  async click(what: Locator): Promise<void> {
    await what.click();
    this.clicks += 1;
  }

  async tool(name: string): Promise<void> {
    const tools = this.page.getByRole('toolbar', { name: 'Edit the drawing' });
    await this.click(tools.getByRole('button', { name: new RegExp(`\\b${name}$`) }));
  }

  /** Chooses a name of the list that the open field offers. */
  async choose(name: string): Promise<void> {
    const offers = this.page.getByRole('listbox', { name: 'Suggestions' });
    await this.click(offers.getByRole('option', { name: new RegExp(`^${name}\\b`) }).first());
    await expect(this.sheet.getByRole('combobox')).toHaveCount(0);
  }

  /** Takes what the open field proposes. */
  async take(): Promise<void> {
    await this.click(this.sheet.getByRole('button', { name: 'Take this' }));
    await expect(this.sheet.getByRole('combobox')).toHaveCount(0);
  }
}

test('the motor latch is drawn from an empty rung in eleven clicks, and holds itself @nightly', async ({
  openAs,
  server,
}) => {
  const mika = await openAs('Mika');
  const sheet = await drawing(mika, server, hold('RUNG\nEND_RUNG'));
  const mouse = new Mouse(mika.page, sheet);
  const option = (name: string) => sheet.getByRole('option', { name, exact: true });

  await mouse.click(sheet.getByRole('group'));
  for (const [tool, name, made] of [
    ['Contact', 'go', 'Contact go'],
    ['Below', 'on', 'Contact on'],
    ['Coil', 'on', 'Coil on'],
  ] as const) {
    await mouse.tool(tool);
    await mouse.choose(name);
    await expect(option(made)).toBeVisible();
  }
  // Behind the parallel, whose end is a place of its own: before the coil.
  await mouse.click(option('Coil on'));
  await mouse.tool('Before');
  await mouse.tool('Closed');
  await mouse.choose('halt');
  await expect(option('Closed contact halt')).toBeVisible();
  expect(mouse.clicks).toBe(11);

  await mika.editor('Hold.st').build();
  await mika.watch.set('start', 'TRUE');
  await expect(sheet.locator('.el.on')).toHaveCount(4);
  await mika.watch.set('start', 'FALSE');
  await expect(sheet.locator('.el.on')).toHaveCount(3);
  await mika.watch.set('stop', 'TRUE');
  await expect(sheet.locator('.el.on')).toHaveCount(0);
});
