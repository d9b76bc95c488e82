import { readFile } from 'node:fs/promises';
import AxeBuilder from '@axe-core/playwright';
import { drawing } from '../fixtures/drawing';
import { expect, test } from '../fixtures/test';

const BATCH = `FUNCTION_BLOCK Batch
VAR_INPUT start, empty : BOOL; level : INT; END_VAR
VAR_OUTPUT inlet, heater : BOOL; END_VAR
VAR rounds : INT; END_VAR
INITIAL_STEP Idle: END_STEP
STEP Fill:
    inlet(N);
END_STEP
STEP Heat:
    heater(N);
END_STEP
STEP Mix:
    Count(N);
END_STEP
ACTION Count:
    rounds := rounds + 1;
END_ACTION
TRANSITION FROM Idle TO (Fill, Heat) := start; END_TRANSITION
TRANSITION FROM (Fill, Heat) TO Mix := level >= 80; END_TRANSITION
TRANSITION FROM Mix TO Idle := empty; END_TRANSITION
END_FUNCTION_BLOCK
FUNCTION_BLOCK Guard
VAR_INPUT start, stop : BOOL; END_VAR
VAR_OUTPUT running : BOOL; END_VAR
NETWORK "Holds itself"
    #any = OR(start, #run);
    #run = AND(#any, NOT stop);
    running := #run;
END_NETWORK
END_FUNCTION_BLOCK
`;

test('a chart with a simultaneous branch and a network are drawn, live, with lanes and halts @nightly', async ({
  openAs,
  server,
}) => {
  const mika = await openAs('Mika');
  const { page } = mika;
  const sheet = await drawing(mika, server, {
    block: 'Batch',
    text: BATCH,
    variables: 'batch : Batch;\n  guard : Guard;',
    calls: 'batch(start := start, level := SEL(stop, 0, 80));\nguard(start := start, stop := stop);',
  });
  const step = (name: string) => sheet.getByRole('option', { name: new RegExp(`^(Initial s|S)tep ${name}\\b`) });
  const active = sheet.locator('.step.on');
  /** A scan in which only the first step was active. */
  let idle = 0;
  await test.step('it is drawn, and the first step is active', async () => {
    await expect(step('Idle')).toBeVisible();
    await mika.editor('Batch.st').build();
    await expect(active).toHaveCount(1);
    await expect(step('Idle')).toContainText('T#');
    // The timeline may still show a scan before the build: it is told of less often than the drawing.
    const { state } = await server.get<{ state: { scan: number } }>(`/instances/${server.instance}`);
    await expect.poll(() => mika.timeline.position()).toBeGreaterThan(state.scan);
    idle = await mika.timeline.position();
  });

  await test.step('two steps become active together, with their actions', async () => {
    await mika.watch.set('start', 'TRUE');
    await expect(active).toHaveCount(2);
    await expect(sheet.locator('.action.closes')).toHaveCount(2);
    await expect(sheet.getByRole('option', { name: 'Transition from Fill, Heat to Mix: level >= 80' })).toHaveClass(
      /enabled/,
    );
  });

  await test.step('a breakpoint halts at a step, marked in the drawing', async () => {
    await step('Heat').click();
    await page.keyboard.press('F9');
    await expect(sheet.getByRole('option', { name: 'Step Heat, next element, breakpoint' })).toBeVisible();
    await step('Fill').click();
    await step('Heat').click();
    await expect(step('Heat')).toHaveAttribute('aria-selected', 'true');
    // Nothing changes while it is halted, and what is live stays when elements are selected.
    await expect(active).toHaveCount(2);
    await page.keyboard.press('F9');
    await page.keyboard.press('F5');
    await expect(sheet.getByText('next element')).toHaveCount(0);
  });

  await test.step('its text has the values of actions and transitions at the ends of their lines', async () => {
    await page.getByRole('radio', { name: 'Both' }).click();
    await expect(page.locator('.inlinerow').filter({ hasText: 'rounds' })).not.toHaveCount(0);
    const level = page.locator('.inlinerow').filter({ hasText: /level\s*0/ });
    await expect(level).not.toHaveCount(0);
    // In the past they are those of the scan that is shown, and the drawing has its step.
    await mika.timeline.goTo(idle);
    await expect(level).not.toHaveCount(0);
    await expect(active).toHaveCount(1);
    await mika.timeline.returnToLive();
    await expect(active).toHaveCount(2);
    await page.getByRole('radio', { name: 'Drawing' }).click();
  });

  await test.step('a network beside it is drawn, with what its wires have', async () => {
    const box = sheet.getByRole('option', { name: '2: box AND to #run' });
    await box.scrollIntoViewIfNeeded();
    await expect(sheet.locator('.wire.on[data-wire="#RUN"]')).not.toHaveCount(0);
    await expect(sheet.getByRole('option', { name: '3: #run to running' })).toContainText('running TRUE');
    await box.click();
    await page.keyboard.press('F9');
    await expect(sheet.getByRole('option', { name: '2: box AND to #run, next element, breakpoint' })).toBeVisible();
    await box.click();
    await page.keyboard.press('F9');
    await page.keyboard.press('F5');
    await expect(sheet.getByText('next element')).toHaveCount(0);
  });

  await test.step('the lanes show when each step was active', async () => {
    await page.getByRole('tab', { name: 'Steps', exact: true }).click();
    await page.getByRole('button', { name: 'Record the steps' }).click();
    const lane = (name: string) => page.getByRole('table', { name: 'Times of the steps' }).getByRole('row', { name });
    await expect(lane('Fill')).toHaveClass('on');
    await expect(lane('Idle')).not.toHaveClass('on');
    await page.getByRole('tab', { name: 'Watch', exact: true }).click();
    await mika.watch.set('stop', 'TRUE');
    await page.getByRole('tab', { name: 'Steps', exact: true }).click();
    await expect(lane('Mix')).toHaveClass('on');
    await expect(lane('Fill').getByRole('cell').nth(1)).toHaveText('1');
  });

  await test.step('the drawing is saved as an SVG, and is readable for everybody', async () => {
    const [file] = await Promise.all([
      page.waitForEvent('download'),
      page.getByRole('button', { name: 'SVG' }).click(),
    ]);
    expect(file.suggestedFilename()).toBe('Batch.svg');
    const written = await readFile(await file.path(), 'utf8');
    for (const each of ['Idle', 'level &gt;= 80', '#run', 'stroke: #']) expect.soft(written).toContain(each);
    expect.soft(written).not.toMatch(/var\(--|: ;/);
    const { violations } = await new AxeBuilder({ page }).include('.graphicview').include('.steps').analyze();
    expect.soft(violations.map(({ id, nodes }) => `${id}: ${nodes[0]?.html}`)).toEqual([]);
  });

  await test.step('a text that cannot be read is shown below the last drawing', async () => {
    await page.getByRole('radio', { name: 'Both' }).click();
    const line = mika.editor('Batch.st').line('TRANSITION FROM Mix TO Idle');
    await line.click();
    await page.keyboard.press('End');
    await page.keyboard.type(' )');
    await expect(sheet.getByText('cannot be drawn')).toBeVisible();
    await expect(step('Mix')).toBeVisible();
    await expect(active).toHaveCount(0);
    await page.keyboard.press('Control+Z');
    await expect(sheet.getByText('cannot be drawn')).toHaveCount(0);
    await line.click();
    await expect(line).toBeVisible();
  });
});
