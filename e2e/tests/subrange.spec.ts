import { expect, test } from '../fixtures/test';

const PROGRAM = `TYPE
  Level : INT (0..1000);
  Color : (RED, GREEN, BLUE);
END_TYPE

FUNCTION_BLOCK Valve
VAR_INPUT want : INT; END_VAR
VAR open : Level; END_VAR
  open := want;
END_FUNCTION_BLOCK

PROGRAM Main
VAR
  x    : Level;
  y    : INT := 5;
  z    : INT;
  err  : BOOL;
  lamp : Color := GREEN;
  text : WSTRING[20] := "Grüße";
  v1   : Valve;
END_VAR
  z := x + y;
  err := SUBRANGE_ERROR(x);
  v1(want := z);
  x := 7 * 2;
END_PROGRAM
`;

test('a value outside its subrange is limited, listed and marked, and the list leads to the source', {
  tag: '@nightly',
}, async ({ openAs }) => {
  const jo = await openAs('Jo');
  await jo.runs();
  await jo.top.newProject('Subranges');
  const main = jo.editor('Main.st');
  await expect(main.region).toBeVisible();
  await main.replaceWith(PROGRAM.replace('  x := 7 * 2;\n', ''));
  await main.build();
  await expect(main.outcome).toContainText('Built');
  await jo.runs();
  for (const path of ['Main.x', 'Main.z', 'Main.err', 'Main.lamp', 'Main.text']) await jo.watch.add(path);

  await test.step('enumerations are shown and written by name, wide strings in quotes', async () => {
    await jo.watch.shows('Main.lamp', 'GREEN');
    await jo.watch.set('Main.lamp', 'Color#BLUE');
    await jo.watch.shows('Main.lamp', 'BLUE');
    await jo.watch.shows('Main.text', '"Grüße"');
  });

  await test.step('values stay at the ends of their lines with the find widget open and with the checks shown', async () => {
    await main.caretAfter('z := x + y;');
    await jo.page.keyboard.press('Control+F');
    await expect(main.region.getByRole('textbox', { name: 'Find' })).toBeFocused();
    await expect.poll(() => main.valuesAreBeside('err')).toBe(true);
    await main.region.getByRole('button', { name: 'Show embedded checks' }).click();
    await expect(main.region.locator('.view-line').filter({ hasText: '⊂' }).first()).toBeVisible();
    for (const name of ['err', 'z', 'x']) await expect.poll(() => main.valuesAreBeside(name), name).toBe(true);
  });

  await test.step('a force colours the value in the text at once, and its release removes the colour', async () => {
    await expect(main.forcedValue('err')).toHaveCount(0);
    await jo.watch.fromMenu('Main.err', 'Force to TRUE');
    await expect(main.forcedValue('err').first()).toBeVisible();
    await jo.watch.releaseOf('Main.err').click();
    await expect(main.forcedValue('err')).toHaveCount(0);
    await main.region.getByRole('button', { name: 'Show embedded checks' }).click();
    await jo.page.keyboard.press('Escape');
  });

  await test.step('nothing is listed while there is no violation', async () => {
    await jo.diagnostics.show();
    await expect(jo.page.getByText('No violations.')).toBeVisible();
    await jo.showPanel('Watch');
  });

  await test.step('the program continues with the limited value', async () => {
    await jo.watch.set('Main.x', '1200');
    await jo.watch.shows('Main.z', '1005');
    await jo.watch.shows('Main.err', 'TRUE');
  });

  const mika = await openAs('Mika');
  await mika.runs();
  await mika.top.goTo(/Subranges/);
  for (const ide of [jo, mika]) {
    await test.step('everybody sees place, instance, value and count', async () => {
      await ide.diagnostics.show();
      const read = ide.diagnostics.entry('x was 1200, outside the range 0..1000');
      await expect(read).toContainText('Main.st:22:');
      await expect(ide.diagnostics.entry('open was 1005, outside the range 0..1000')).toContainText('Main.v1');
    });
  }

  await test.step('a click goes to the source line, which is marked', async () => {
    await jo.diagnostics.entry('open was 1005').click();
    await expect(jo.statusBar).toContainText('Ln 9,');
    await expect(main.region.locator('.squiggly-warning').first()).toBeVisible();
  });

  await test.step('the view of embedded checks shows the checks in the text, and those proved unnecessary', async () => {
    await main.replaceWith(PROGRAM);
    await expect(main.region.getByText('⊂ 0..1000')).toHaveCount(0);
    await main.region.getByRole('button', { name: 'Show embedded checks' }).click();
    await expect(main.region.getByText('⊂ 0..1000').first()).toBeVisible();
    await expect(main.region.getByText('✓ 0..1000').first()).toBeVisible();
    await main.region.getByRole('button', { name: 'Show embedded checks' }).click();
    await expect(main.region.getByText('⊂ 0..1000')).toHaveCount(0);
  });

  await test.step('after the value is back in range, somebody clears the list for everybody', async () => {
    await jo.showPanel('Watch');
    await jo.watch.set('Main.x', '12');
    await jo.watch.shows('Main.z', '17');
    await jo.diagnostics.show();
    await jo.diagnostics.clearButton.click();
    await expect(jo.page.getByText('No violations.')).toBeVisible();
    await expect(mika.page.getByText('No violations.')).toBeVisible();
  });
});
