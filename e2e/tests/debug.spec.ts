import { expect, test } from '../fixtures/test';
import type { Ide } from '../pages/ide';

const MAIN = `FUNCTION_BLOCK Counter
VAR_INPUT run : BOOL; step : INT; END_VAR
VAR count : INT; done : BOOL; END_VAR
VAR_TEMP next : INT; END_VAR
next := count + step;
IF run THEN
  count := next;
END_IF;
done := count > 0;
END_FUNCTION_BLOCK

PROGRAM Main
VAR
  go : BOOL;
  a  : ARRAY[1..3] OF Counter;
  i  : INT;
  n  : INT;
END_VAR
FOR i := 1 TO 3 DO
  a[i](run := go, step := i);
END_FOR;
n := n + 1;
END_PROGRAM

CONFIGURATION Plant
  RESOURCE Cpu ON PLC
    TASK Cyclic(INTERVAL := T#10ms, PRIORITY := 1);
    PROGRAM Main WITH Cyclic : Main;
  END_RESOURCE
END_CONFIGURATION
`;
const BROKEN = `PROGRAM Main
VAR go : BOOL; d : INT := 1; n : INT; END_VAR
IF go THEN
  d := d - 1;
END_IF;
n := 100 / d;
END_PROGRAM

CONFIGURATION Plant
  RESOURCE Cpu ON PLC
    TASK Cyclic(INTERVAL := T#10ms, PRIORITY := 1);
    PROGRAM Main WITH Cyclic : Main;
  END_RESOURCE
END_CONFIGURATION
`;
const FILE = 'Main.st';

test('a breakpoint in one of three instances: inspect, change, step, step back, continue', async ({ openAs }) => {
  const mika = await openAs('Mika');
  await prepared(mika, 'Counters');
  const { debug, top, page } = mika;

  await test.step('an invalid condition stays, with the reason', async () => {
    await debug.fromGutter(FILE, 'count := next;', 'Add conditional breakpoint…');
    await debug.fillForm({ Condition: 'nonsense > 1' });
    await expect(debug.form.getByRole('alert')).toContainText('nonsense');
    await expect(debug.glyph(FILE, 'gl-bp-unbound')).toBeVisible();
  });

  await test.step('corrected, it halts only in the third instance', async () => {
    await debug.fillForm({ Condition: 'next > 30' }, { Instance: 'Main.a[3]' });
    await expect(debug.form).toBeHidden();
    await expect(debug.glyph(FILE, 'gl-bp-cond')).toBeVisible();
    await expect(debug.breakpoints).toHaveCount(1);
    await mika.watch.set('Main.go', 'TRUE');
    await expect(top.state).toContainText('Halted');
    await expect(top.state).toContainText('at breakpoint, line 7');
    await expect(debug.haltedLine(FILE)).toBeVisible();
    await expect(debug.frames).toHaveCount(2);
    await expect(debug.frames.first()).toContainText('Counter');
    await expect(debug.frames.first()).toContainText('a[3]');
    await expect(debug.frames.nth(1)).toContainText('Main');
    await expect(debug.variable('next')).toHaveText('33');
    await expect(debug.variable('count')).toHaveText('30');
    await expect(debug.variable('step')).toHaveText('3');
    await expect(mika.statusBar).toContainText('debug build');
  });

  await test.step('the caller shows its own variables', async () => {
    await debug.frames.nth(1).click();
    await expect(debug.variable('i')).toHaveText('3');
    await debug.frames.first().click();
    await expect(debug.variable('count')).toHaveText('30');
  });

  await test.step('values are changed in place; wrong ones are refused there', async () => {
    await debug.setVariable('count', '70000');
    await expect(debug.section('Variables').getByRole('alert')).toContainText('INT');
    await page.keyboard.press('Escape');
    await debug.setVariable('next', '500');
    await expect(debug.variable('next')).toHaveText('500');
    await debug.step('Step over');
    await expect(debug.variable('count')).toHaveText('500');
    await expect(mika.watch.value('Main.a[3].count')).toHaveText('500');
  });

  await test.step('a step back undoes a statement, a step over executes it again', async () => {
    await debug.step('Step back');
    await expect(top.state).toContainText('line 7, read-only');
    await expect(page.getByRole('region', { name: 'In the past' })).toBeVisible();
    await expect(debug.variable('count')).toHaveText('30');
    await debug.step('Step over');
    await expect(debug.variable('count')).toHaveText('500');
    await expect(top.state).toContainText('Halted');
  });

  await test.step('step out of the block, and into it in the next scan', async () => {
    await debug.removeAll();
    await debug.step('Step out');
    await expect(debug.frames).toHaveCount(1);
    await debug.fromGutter(FILE, 'a[i](run', 'Run to here');
    await expect(top.state).toContainText('line 20');
    await debug.step('Step into');
    await expect(debug.frames).toHaveCount(2);
    await expect(debug.frames.first()).toContainText('a[1]');
  });

  await test.step('the program continues', async () => {
    await page.keyboard.press('F5');
    await expect(top.state).toContainText('Running');
    await top.scansGoOn();
    await expect(debug.section('Call stack')).toBeHidden();
  });
});

test('the mark of a breakpoint is where the breakpoint is after a build, and who types keeps the focus at a halt', {
  tag: '@nightly',
}, async ({ openAs }) => {
  const mika = await openAs('Mika');
  await prepared(mika, 'Counters');
  const { debug, page, top } = mika;
  const editor = mika.editor(FILE);

  await test.step('a statement is removed: its breakpoint goes on to the next one, and its mark, too', async () => {
    await top.chooseMode('PROGRAM');
    await editor.addBelow('END_IF;', 'done := FALSE;');
    await editor.build();
    await expect(editor.saveButton).toBeDisabled();
    await expect(editor.outcome).toContainText('Built');
    await editor.caretAfter('done := FALSE;');
    await page.keyboard.press('F9');
    await expect(debug.glyph(FILE, 'gl-bp')).toBeVisible();
    await expect(debug.breakpoints).toContainText('9');
    await page.keyboard.press('Shift+Home');
    await page.keyboard.press('Delete');
    await page.keyboard.press('Backspace');
    await editor.build();
    await expect(editor.saveButton).toBeDisabled();
    await expect(editor.line('done := FALSE;')).toHaveCount(0);
    await expect(debug.breakpoints).toContainText('9');
    await expect.poll(() => debug.isBeside(FILE, 'gl-bp', 'done := count > 0;')).toBe(true);
  });

  await test.step('a halt and a step leave the focus in the text', async () => {
    await top.chooseMode('MONITOR');
    await expect(top.state).toContainText('Halted');
    await editor.caretAfter('count := next;');
    await page.keyboard.press('F10');
    await expect(top.state).toContainText('after a step');
    await page.keyboard.type(' // typed');
    await expect(editor.line('count := next; // typed')).toBeVisible();
  });
});

test('logpoint, execution point, data breakpoint, and coverage', { tag: '@nightly' }, async ({ openAs }) => {
  const mika = await openAs('Mika');
  await prepared(mika, 'Points');
  const { debug, top, page } = mika;

  await test.step('a logpoint writes into the console and does not halt', async () => {
    await debug.fromGutter(FILE, 'n := n + 1;', 'Add logpoint…');
    await debug.fillForm({ Message: 'n is {n}', Hits: '3' });
    await expect(debug.glyph(FILE, 'gl-bp-log')).toBeVisible();
    const console_ = await debug.showConsole();
    await expect(console_).toContainText(/n is \d+/);
    await expect(top.state).toContainText('Running');
    await debug.removeAll();
  });

  await test.step('the console evaluates, and changes values only on request', async () => {
    const console_ = await debug.showConsole();
    await debug.evaluate('Main.a[2].count * 2 + 7');
    await expect(console_).toContainText('7');
    await debug.evaluate('Main.nothing');
    await expect(console_).toContainText('nothing');
    await debug.evaluate('! Main.go := TRUE');
    await mika.showPanel('Watch');
    await mika.watch.shows('Main.go', 'TRUE');
  });

  await test.step('an execution point writes at its statement', async () => {
    await debug.fromGutter(FILE, 'n := n + 1;', 'Add execution point…');
    await debug.fillForm({ Assignments: 'n := 1000;' });
    await expect(debug.glyph(FILE, 'gl-bp-assign')).toBeVisible();
    await mika.watch.shows('Main.n', '1001');
    await debug.removeAll();
  });

  await test.step('a data breakpoint halts where the value was changed', async () => {
    await debug.section('Breakpoints').getByRole('button', { name: 'New breakpoint' }).click();
    await page.getByRole('menuitem', { name: 'Break at a variable…' }).click();
    const dialog = page.getByRole('dialog', { name: 'Break at a variable…' });
    await dialog.getByRole('textbox', { name: 'Variable or address' }).fill('Main.nope');
    await dialog.getByRole('button', { name: 'Set' }).click();
    await expect(dialog.getByRole('alert')).toContainText('nope');
    await expect(debug.breakpoints).toHaveCount(0);
    await dialog.getByRole('textbox', { name: 'Variable or address' }).fill('Main.a[2].count');
    await dialog.getByRole('textbox', { name: 'Condition' }).fill('Main.a[2].count MOD 100 = 0');
    await dialog.getByRole('button', { name: 'Set' }).click();
    // The reason names the variable, its old and its new value.
    await expect(debug.section('Call stack')).toContainText(/Main\.a\[2\]\.count changed from \d+ to \d+00/);
    // The PLC is halted after the statement that wrote.
    const console_ = await debug.showConsole();
    await debug.evaluate('Main.a[2].count');
    await expect(console_).toContainText(/\d00/);
    await debug.removeAll();
    await debug.step('Continue');
    await expect(top.state).toContainText('Running');
    // The frame of the halt is gone, but the console still evaluates.
    await debug.evaluate('Main.a[3].step + 40');
    await expect(console_).toContainText('43');
  });

  await test.step('coverage marks the executed lines', async () => {
    const editor = mika.editor(FILE);
    await editor.region.getByRole('switch', { name: /^Coverage/ }).click();
    await expect(editor.region.locator('.cover.full').first()).toBeVisible();
    await expect(editor.region).toContainText(/Coverage \d+/);
  });
});

test('after a run-time error one can still step back', { tag: '@nightly' }, async ({ openAs }) => {
  const mika = await openAs('Mika');
  await prepared(mika, 'Broken', BROKEN);
  const { debug, top } = mika;

  await mika.watch.set('Main.go', 'TRUE');
  await expect(top.state).toContainText('Trapped');
  await debug.step('Step back');
  await expect(top.state).toContainText('In the past');
  await expect(debug.variable('d')).toHaveText('0');
  await debug.step('Step back');
  await expect(debug.variable('d')).toHaveText('1');
  await expect(debug.section('Breakpoints')).toBeVisible();
});

test('two people: both see the halt and who caused it', { tag: '@nightly' }, async ({ openAs }) => {
  const mika = await openAs('Mika');
  await prepared(mika, 'Shared');
  const jo = await openAs('Jo');
  await jo.top.goTo(/^Shared/);
  await jo.runs();
  await jo.editor(FILE).open();

  await mika.debug.clickGutter(FILE, 'n := n + 1;');
  await expect(mika.top.state).toContainText('Halted');
  await expect(jo.top.state).toContainText('Halted');
  await expect(jo.debug.section('Call stack')).toContainText('Halted by Mika');
  await expect(jo.debug.breakpoints).toContainText('Mika');
  await expect(jo.debug.haltedLine(FILE)).toBeVisible();

  await jo.debug.removeAll();
  await jo.debug.step('Continue');
  await expect(mika.top.state).toContainText('Running');
  await expect(mika.debug.breakpoints).toHaveCount(0);
});

async function prepared(mika: Ide, project: string, program = MAIN): Promise<void> {
  await mika.top.newProject(project);
  const main = mika.editor(FILE);
  await main.open();
  await mika.runs();
  await main.replaceWith(program);
  await main.build();
  const dialog = mika.page.getByRole('dialog', { name: /^Online change/ });
  await expect(main.outcome.or(dialog).first()).toBeVisible();
  await expect(main.outcome).toContainText('Built');
  await mika.runs();
  const watched = program === MAIN ? ['Main.go', 'Main.n', 'Main.a[3].count'] : ['Main.go'];
  for (const path of watched) await mika.watch.add(path);
  await main.text.focus();
  await mika.page.keyboard.press('Control+Home');
}
