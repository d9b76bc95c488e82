import { expect, test } from '../fixtures/test';
import type { Ide } from '../pages/ide';

const CONFIGURATION = `
CONFIGURATION Plant
  RESOURCE Cpu ON PLC
    TASK Cyclic(INTERVAL := T#10ms, PRIORITY := 1);
    PROGRAM Main WITH Cyclic : Main;
  END_RESOURCE
END_CONFIGURATION
`;

/** A program whose line 9 causes a run-time error as soon as `go` is TRUE. */
function program(fault: string): string {
  return `PROGRAM Main
VAR
  go      : BOOL;
  divisor : INT;
  index   : INT := 7;
  list    : ARRAY[0..4] OF INT;
  result  : INT;
END_VAR
  IF go THEN ${fault} END_IF;
  result := result + 1;
END_PROGRAM
${CONFIGURATION}`;
}

const FAULTS = [
  { name: 'divides by zero', fault: 'result := 10 / divisor;', said: /zero/ },
  { name: 'indexes outside of an array', fault: 'list[index] := 1;', said: /0\.\.4/ },
  { name: 'loops for ever', fault: 'WHILE go DO result := 0; END_WHILE;', said: /does not end/ },
];

test('a program with a run-time error stops with file and line, and no other PLC stops', { tag: '@nightly' }, async ({
  openAs,
}) => {
  const jo = await openAs('Jo');
  await jo.runs();
  const mika = await openAs('Mika');
  await mika.top.newProject('Traps');
  const main = mika.editor('Main.st');
  await ready(mika);

  await test.step('for a program without variables the page says that there are none', async () => {
    await mika.page.getByRole('button', { name: "Add the program's variables" }).click();
    await expect(mika.page.getByText('The running program has no variables.')).toBeVisible();
  });

  for (const { name, fault, said } of FAULTS) {
    await test.step(name, async () => {
      await main.replaceWith(program(fault));
      await main.build();
      await expect(main.outcome).toContainText('Built');
      await mika.runs();
      await watched(mika, 'Main.go');
      await watched(mika, 'Main.result');
      await mika.page.keyboard.press('Control+Home');
      await mika.watch.write('Main.go', 'TRUE');

      await expect(mika.top.state).toContainText('Trapped');
      await expect(mika.banner).toContainText('A run-time error stopped the program.');
      await expect(mika.banner).toContainText(said);
      await expect(mika.banner).toContainText(/ at Main\.st:9 in scan [\d,]+\./);
      await expect(main.region.locator('.trapline')).toBeVisible();
      await expect(main.region.locator('.traparrow')).toBeVisible();
      await mika.banner.getByRole('button', { name: 'Main.st:9' }).click();
      await expect(mika.statusBar).toContainText('Ln 9,');

      await expect(jo.top.state).toContainText('Running');
      await jo.top.scansGoOn();
      await expect(jo.banner).toBeHidden();
    });

    await test.step(`${name}: corrected and restarted, it runs again`, async () => {
      await main.replaceWith(program('result := 5;'));
      await main.build();
      await expect(main.outcome).toContainText('Built');
      await mika.top.restart();
      await mika.runs();
      await expect(mika.banner).toBeHidden();
      await expect(main.region.locator('.trapline')).toHaveCount(0);
    });
  }
});

test('after its cause is corrected by hand, a stopped program continues with its variables', {
  tag: '@nightly',
}, async ({ openAs }) => {
  const mika = await openAs('Mika');
  await mika.top.newProject('Going on');
  const main = mika.editor('Main.st');
  await ready(mika);
  await main.replaceWith(program('result := 10 / divisor;'));
  await main.build();
  await expect(main.outcome).toContainText('Built');
  await mika.runs();
  await watched(mika, 'Main.go');
  await watched(mika, 'Main.index');
  await mika.page.keyboard.press('Control+Home');
  await mika.watch.write('Main.index', '3');
  await mika.watch.write('Main.go', 'TRUE');
  await expect(mika.top.state).toContainText('Trapped');

  await mika.watch.write('Main.go', 'FALSE');
  await mika.banner.getByRole('button', { name: 'Recover and go on' }).click();
  await mika.runs();
  await expect(mika.banner).toBeHidden();
  await mika.watch.shows('Main.index', '3');
});

/** Waits until a new project has a text to edit, and its PLC exists. */
async function ready(ide: Ide): Promise<void> {
  const main = ide.editor('Main.st');
  if (!(await main.region.isVisible())) await ide.page.screenshot({ path: 'test-results/new-project.png' });
  await expect(main.region).toBeVisible();
}

async function watched(ide: Ide, path: string): Promise<void> {
  if (!(await ide.watch.row(path).isVisible())) await ide.watch.add(path);
}
