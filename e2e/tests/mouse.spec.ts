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
    const offers = this.page.getByRole('listbox', { name: 'Matching variables and addresses' });
    await this.click(offers.getByRole('option', { name: new RegExp(`^${name}\\b`) }).first());
    await expect(this.sheet.getByRole('combobox')).toHaveCount(0);
  }

  /** Takes what the open field proposes. */
  async take(): Promise<void> {
    await this.click(this.sheet.getByRole('button', { name: 'Take this' }));
    await expect(this.sheet.getByRole('combobox')).toHaveCount(0);
  }
}

test('the motor latch is drawn from an empty rung in ten clicks, and holds itself @nightly', async ({
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
  await mouse.click(option('After the branches'));
  await mouse.tool('Closed');
  await mouse.choose('halt');
  await expect(option('Closed contact halt')).toBeVisible();
  expect(mouse.clicks).toBe(10);
  await expect(sheet.getByRole('option')).toHaveCount(5);

  await mika.editor('Hold.st').build();
  await mika.watch.set('start', 'TRUE');
  await expect(sheet.locator('.el.on')).toHaveCount(4);
  await mika.watch.set('start', 'FALSE');
  await expect(sheet.locator('.el.on')).toHaveCount(3);
  await mika.watch.set('stop', 'TRUE');
  await expect(sheet.locator('.el.on')).toHaveCount(0);
});

test('a chart with a simultaneous branch and an alternative is drawn from its first step, and runs @nightly', async ({
  openAs,
  server,
}) => {
  const mika = await openAs('Mika');
  const sheet = await drawing(mika, server, hold('INITIAL_STEP Init:\nEND_STEP'));
  const mouse = new Mouse(mika.page, sheet);
  const option = (name: string) => sheet.getByRole('option', { name, exact: true });
  const condition = async (transition: string, name: string) => {
    // What is not connected says so.
    await mouse.click(sheet.getByRole('option', { name: `${transition}: ???` }));
    await mouse.tool('Name');
    await mouse.choose(name);
    await expect(option(`${transition}: ${name}`)).toBeVisible();
  };

  await test.step('two steps one after the other, the second with one beside it', async () => {
    await mouse.click(option('Initial step Init'));
    for (const name of ['Step1', 'Step2']) {
      await mouse.tool('Step');
      await mouse.take();
      await expect(option(`Step ${name}`)).toHaveAttribute('aria-selected', 'true');
    }
    await mouse.tool('Simultaneous');
    await mouse.take();
    await expect(sheet.getByRole('option', { name: 'Transition from Step1 to Step2, Step3: ???' })).toBeVisible();
    await mouse.click(option('Step Step2'));
    await mouse.tool('Action');
    await mouse.choose('on');
    await expect(option('Action on, N, of step Step2')).toBeVisible();
  });

  await test.step('from both back to the first, or from the one between', async () => {
    await condition('Transition from Init to Step1', 'go');
    await mouse.tool('Alternative');
    await mouse.choose('halt');
    await expect(option('Transition from Init to Step1: halt')).toBeVisible();
    await mouse.tool('Delete');
    await expect(option('Transition from Init to Step1: halt')).toHaveCount(0);
    await condition('Transition from Step1 to Step2, Step3', 'go');
    await mouse.click(option('Step Step2'));
    await mouse.tool('Jump');
    await mouse.choose('Init');
    await condition('Transition from Step2, Step3 to Init', 'halt');
  });

  await test.step('the initial step stays, and the page says why', async () => {
    await mouse.click(option('Initial step Init'));
    await mouse.tool('Delete');
    await expect(mika.page.getByText('A chart needs its initial step.')).toBeVisible();
    await expect(option('Initial step Init')).toBeVisible();
  });

  await test.step('it is built, and runs', async () => {
    await mika.editor('Hold.st').build();
    await expect(sheet.locator('.step.on')).toHaveCount(1);
    await mika.watch.set('start', 'TRUE');
    await expect(sheet.locator('.step.on')).toHaveCount(2);
    await expect(sheet.locator('.action.closes')).toHaveCount(1);
    await mika.watch.set('start', 'FALSE');
    await mika.watch.set('stop', 'TRUE');
    await expect(sheet.locator('.step.on')).toHaveCount(1);
  });
});
