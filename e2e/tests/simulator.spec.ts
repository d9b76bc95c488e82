import { expect, test } from '../fixtures/test';

const BASIC = 'Basic I/O Unit error';
const BATTERY = 'Battery error';
const MEMORY = 'Memory error';
const SETUP = 'PLC Setup error';

test('a group and two more errors are raised in one scan, with their details; the fatal one stops the PLC, and is recovered', async ({
  openAs,
}) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const { simulator } = mika;

  await test.step('while no error was raised yet, the panel says how to begin', async () => {
    await expect(mika.page.getByRole('region', { name: 'No error raised with this program yet' })).toBeVisible();
    await expect(simulator.error(BATTERY)).toContainText('Never');
  });

  await test.step('the box of a group ticks its errors; it is half if some are ticked', async () => {
    await simulator.box('Units').check();
    await expect(simulator.box(BASIC)).toBeChecked();
    await expect(simulator.box('Special I/O Unit error')).toBeChecked();
    await simulator.box('Special I/O Unit error').uncheck();
    await expect(simulator.box('Units')).toHaveJSProperty('indeterminate', true);
    await simulator.box(SETUP).check();
    await simulator.box(MEMORY).check();
  });

  await simulator.generateButton.click();
  await expect(simulator.dialog).toContainText('Nothing is written until you choose Generate');

  await test.step('List: a table of choices, with the number each adds and what will be written', async () => {
    const page = simulator.dialogPage(MEMORY);
    await page.getByRole('radio', { name: /I\/O table checksum/ }).check();
    await expect(page).toContainText('+3');
    const preview = page.getByRole('region', { name: 'What will be written' });
    await expect(preview).toContainText(/A403\.05\s*0 → 1/);
    await expect(preview).toContainText(/A400\s*0000 → 80F4/);
    await expect(preview).toContainText(/A401\.15\s*0 → 1/);
  });

  await test.step('Edit: a refused entry has a reason, and nothing can be generated', async () => {
    await simulator.step(SETUP).click();
    const page = simulator.dialogPage(SETUP);
    const entry = page.getByRole('textbox').first();
    await entry.fill('1A0G');
    await expect(page.getByRole('alert')).toContainText('G is not a hex digit');
    await expect(simulator.step(SETUP)).toContainText('entry refused');
    await expect(simulator.dialog.getByRole('button', { name: /^Generate / })).toBeDisabled();
    await entry.fill('416');
    await page.getByRole('button', { name: 'Decimal' }).click();
    await expect(entry).toHaveValue('1046');
    await page.getByRole('button', { name: 'Hex' }).click();
    await entry.fill('1A0');
    await expect(page.getByRole('alert')).toHaveCount(0);
    await expect(page.getByRole('region', { name: 'What will be written' })).toContainText(/0000 → 01A0/);
  });

  await test.step('Spin: a number in its range, reached by Back and Next', async () => {
    await simulator.dialog.getByRole('button', { name: 'Next' }).click();
    const page = simulator.dialogPage(BASIC);
    await page.getByRole('spinbutton', { name: 'Rack number' }).fill('2');
    await page.getByRole('spinbutton', { name: 'Slot number' }).fill('7');
    await simulator.dialog.getByRole('button', { name: 'Back' }).click();
    await expect(simulator.dialogPage(SETUP)).toBeVisible();
  });

  await test.step('all of them in one scan', async () => {
    await simulator.dialog.getByRole('button', { name: /^Generate / }).click();
    await expect(simulator.dialog).toBeHidden();
    const scans: string[] = [];
    for (const name of [MEMORY, SETUP, BASIC]) {
      await simulator.select(name);
      await expect(simulator.error(name)).toContainText('Generated');
      const said = /before scan ([\d,]+)\./.exec((await simulator.details.textContent()) ?? '')?.[1] ?? '';
      expect(said).not.toBe('');
      scans.push(said);
    }
    expect(new Set(scans).size).toBe(1);
    await expect(simulator.details).toContainText('Rack number 2, Slot number 7');
    await expect(simulator.word('A400')).toHaveText('80F4');
  });

  await test.step('the PLC is stopped; after recovery it continues, and the other errors are still present', async () => {
    await expect(mika.top.state).toContainText('Fatal error');
    await expect(simulator.error(MEMORY)).toContainText('Stopped');
    await mika.banner.getByRole('button', { name: 'Recover and go on' }).click();
    await mika.runs();
    await expect(mika.banner).toBeHidden();
    await expect(simulator.error(MEMORY)).toContainText('Cleared');
    await expect(simulator.error(BASIC)).toContainText('Generated');
    await expect(simulator.error('Special I/O Unit error')).toContainText('Never');
    await expect(simulator.word('A400')).not.toHaveText('0000');
  });

  await test.step('never, generated and cleared each have their icon', async () => {
    const icon = (name: string, state: string) => simulator.error(name).locator(`.st.${state} svg`).first().innerHTML();
    const icons = [
      await icon('Special I/O Unit error', 'never'),
      await icon(BASIC, 'generated'),
      await icon(MEMORY, 'cleared'),
    ];
    expect(new Set(icons).size).toBe(3);
  });

  await test.step('Clear all recovers the remaining errors', async () => {
    await mika.page.getByRole('button', { name: 'Clear all' }).click();
    await expect(simulator.error(BASIC)).toContainText('Cleared');
    await expect(simulator.word('A400')).toHaveText('0000');
  });
});

test('the tree, the details and the editor show the reaction', { tag: '@nightly' }, async ({ openAs }) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const { simulator, page } = mika;

  await test.step('an error that is handled', async () => {
    await simulator.generate(BASIC);
    await expect(simulator.error(BASIC)).toContainText('Acted');
    await expect(simulator.reaction).toContainText('after 1 scan');
    await expect(simulator.reaction.getByRole('table', { name: 'Variables changed by the error' })).toContainText(
      'lamp',
    );
    await expect(simulator.group('Units')).toContainText(/^Units1 of/);
  });

  await test.step('its readers are links, and the editor marks them while it is selected', async () => {
    await simulator.reaction
      .getByRole('group', { name: 'Read at' })
      .getByRole('button', { name: /^ErrorHandler\.st:\d+$/ })
      .first()
      .click();
    const editor = mika.editor('ErrorHandler.st');
    await expect(editor.line('any := basicIoError').first()).toContainText('reads the flag');
    await expect(page.locator('.readermark').first()).toBeVisible();
    await simulator.select(BATTERY);
    await expect(page.locator('.readermark')).toHaveCount(0);
  });

  await test.step('an error that nobody reads is a finding', async () => {
    await simulator.generate(BATTERY);
    await expect(simulator.error(BATTERY)).toContainText('Never read');
    await expect(simulator.reaction).toContainText('No statement read A402.04');
    await expect(simulator.reaction).toContainText('Next: evaluate A402.04');
    await simulator.filterBy('Findings');
    await expect(simulator.error(BATTERY)).toBeVisible();
    await expect(simulator.error(BASIC)).toHaveCount(0);
  });
});

test('shaped faults: for some scans, intermittent, when a condition holds', { tag: '@nightly' }, async ({ openAs }) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const { simulator } = mika;

  await test.step('for some scans: it recovers by itself', async () => {
    await simulator.select(BATTERY);
    await simulator.shape('How', 'For some scans');
    await simulator.details.getByRole('textbox', { name: 'scans' }).fill('0');
    await expect(simulator.generateButton).toBeDisabled();
    await simulator.details.getByRole('textbox', { name: 'scans' }).fill('20');
    await simulator.generateButton.click();
    await expect(simulator.error(BATTERY)).toContainText('Cleared');
    await expect(simulator.armed).toHaveCount(0);
  });

  await test.step('intermittent, until it is taken back', async () => {
    await simulator.select(BATTERY);
    await simulator.shape('How', 'Intermittent');
    await simulator.details.getByRole('textbox', { name: 'of every' }).fill('40');
    await simulator.generateButton.click();
    await expect(simulator.armed).toContainText(BATTERY);
    await expect(simulator.armed).toContainText(/raised [2-9]\d* times/);
    await expect(simulator.armed).toContainText('by Mika');
    await expect(mika.statusBar).toContainText('1 fault armed');
    await simulator.armed.getByRole('button', { name: /^Take back/ }).click();
    await expect(simulator.armed).toHaveCount(0);
    await expect(simulator.error(BATTERY)).toContainText('Cleared');
  });

  await test.step('while an error chatters, the preview of a different one is shown', async () => {
    await simulator.select(BATTERY);
    await simulator.shape('How', 'Chatters: on and off, scan by scan');
    await simulator.generateButton.click();
    await expect(simulator.armed).toContainText(/raised \d+ times/);
    await simulator.select(BASIC);
    await expect(simulator.preview).toContainText('A402.12');
    await simulator.armed.getByRole('button', { name: /^Take back/ }).click();
    await expect(simulator.armed).toHaveCount(0);
  });

  await test.step('a scan in the form that passes meanwhile is reported as over, without a key press', async () => {
    await simulator.select(BASIC);
    await simulator.shape('When', 'At a scan');
    await simulator.details.getByRole('textbox', { name: 'Scan' }).fill(String((await mika.top.scan()) + 200));
    await expect(simulator.details).toContainText('This scan is over. Choose a later one.');
    await expect(simulator.generateButton).toBeDisabled();
  });

  await test.step('a condition with an unknown name is refused below the row, with similar names', async () => {
    await simulator.select(BASIC);
    await simulator.shape('When', 'When a condition holds');
    await simulator.details.getByRole('combobox', { name: 'Condition' }).fill('strat');
    await simulator.generateButton.click();
    await expect(simulator.refusal).toContainText('strat');
    await simulator.refusal.getByRole('button', { name: 'start', exact: true }).click();
    await simulator.generateButton.click();
    await expect(simulator.armed).toContainText('Waiting');
    await expect(simulator.error(BASIC)).toContainText('Armed');
  });

  await test.step('the fault begins when the condition holds', async () => {
    await mika.watch.set('start', 'TRUE');
    await expect(simulator.error(BASIC)).toContainText('Generated');
    await mika.watch.shows('lamp', 'TRUE');
  });
});

test('an error is found, raised and recovered by keyboard alone', { tag: '@nightly' }, async ({ openAs }) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const { keyboard } = mika.page;
  await mika.goToPane('errors');
  await mika.simulator.tree.focus();
  await keyboard.type('batt');
  await expect(mika.simulator.details).toContainText(BATTERY);
  await keyboard.press('Enter');
  await expect(mika.simulator.error(BATTERY)).toContainText('Generated');
  await keyboard.press('Home');
  await keyboard.press('ArrowLeft');
  await expect(mika.simulator.error(MEMORY)).toHaveCount(0);
  await keyboard.press('ArrowRight');
  await keyboard.press('ArrowRight');
  await keyboard.press('Space');
  await expect(mika.simulator.box(MEMORY)).toBeChecked();
  await keyboard.press('Space');
  await expect(mika.simulator.box(MEMORY)).not.toBeChecked();
});

test('two people: the second sees the error, and may change its details', { tag: '@nightly' }, async ({ openAs }) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const jo = await openAs('Jo');
  await jo.runs();

  await mika.simulator.select(BASIC);
  await mika.simulator.details.getByRole('spinbutton', { name: 'Rack number' }).fill('1');
  await mika.simulator.generate(BASIC);
  await expect(jo.simulator.error(BASIC)).toContainText('Generated');

  await test.step('raising it again is refused, with the name of the person who raised it', async () => {
    await jo.simulator.select(BASIC);
    await expect(jo.simulator.details).toContainText('Generated by Mika');
    await jo.simulator.details.getByRole('spinbutton', { name: 'Rack number' }).fill('3');
    await jo.simulator.generateButton.click();
    await expect(jo.simulator.refusal).toContainText('Already generated by Mika (Rack number 1');
  });

  await test.step('with different details it is raised again on purpose', async () => {
    await jo.simulator.refusal.getByRole('button', { name: 'Change details' }).click();
    await expect(jo.simulator.refusal).toHaveCount(0);
    await expect(mika.simulator.details).toContainText('Generated by Jo');
    await expect(mika.simulator.details).toContainText('Rack number 3');
  });

  await test.step('it is recovered for both', async () => {
    await jo.simulator.recover(BASIC);
    await expect(mika.simulator.error(BASIC)).toContainText('Cleared');
  });
});
