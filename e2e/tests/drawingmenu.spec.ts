import { drawing } from '../fixtures/drawing';
import { expect, test } from '../fixtures/test';

const LATCH = `FUNCTION_BLOCK Latch
VAR_INPUT go, halt : BOOL; END_VAR
VAR_OUTPUT on : BOOL; END_VAR
RUNG "The motor runs"
    [go] [/halt] (on)
END_RUNG
END_FUNCTION_BLOCK
`;

test('the menu of a drawing does what its keys do, by mouse and by keyboard', async ({ openAs, server }) => {
  const mika = await openAs('Mika');
  const { page } = mika;
  const { keyboard } = page;
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
  const sheet = await drawing(mika, server, {
    block: 'Latch',
    text: LATCH,
    variables: 'latch : Latch;',
    calls: 'latch(go := start);',
  });
  const menu = page.getByRole('menu', { name: 'Menu of the drawing' });
  const entry = (name: string) => menu.getByRole('menuitem', { name });
  const element = (name: string) => sheet.getByRole('option', { name, exact: true });

  await test.step('a contact is negated, and its menu says with which key', async () => {
    await element('Contact go').click({ button: 'right' });
    await expect(entry('Negate')).toContainText('!');
    await entry('Negate').click();
    await expect(element('Closed contact go')).toBeVisible();
    await expect(sheet).toBeFocused();
    await keyboard.press('Control+Z');
    await expect(element('Contact go')).toBeVisible();
  });

  await test.step('by keyboard it opens at the cursor, and Escape goes back to the drawing', async () => {
    await element('Coil on').click();
    await keyboard.press('m');
    await expect(menu.getByRole('menuitem').first()).toBeFocused();
    await keyboard.press('Escape');
    await expect(menu).toHaveCount(0);
    await expect(sheet).toBeFocused();
    await keyboard.press('ContextMenu');
    await entry('Insert a contact below').press('Enter');
    await keyboard.type('go');
    await keyboard.press('Enter');
    await expect(element('Contact go')).toHaveCount(2);
    await expect(sheet).toBeFocused();
    await keyboard.press('Control+Z');
    await expect(element('Contact go')).toHaveCount(1);
  });

  await test.step('an element is cut and pasted', async () => {
    await element('Closed contact halt').click({ button: 'right' });
    await entry('Cut').click();
    await expect(element('Closed contact halt')).toHaveCount(0);
    await element('Contact go').click({ button: 'right' });
    await entry('Paste').click();
    await expect(element('Closed contact halt')).toBeVisible();
  });

  await test.step('a variable is forced and released, and a breakpoint is set', async () => {
    await mika.editor('Latch.st').build();
    await expect(element('Closed contact halt')).toHaveClass(/closes/);
    await element('Coil on').click({ button: 'right' });
    await entry('Force to TRUE').click();
    await expect(sheet.locator('.el.forced')).toHaveCount(1);
    await element('Coil on').click({ button: 'right' });
    await entry('Release force').click();
    await expect(sheet.locator('.el.forced')).toHaveCount(0);
    await element('Contact go').click({ button: 'right' });
    await entry('Breakpoint').click();
    await expect(sheet.getByRole('option', { name: 'Contact go, next element, breakpoint' })).toBeVisible();
  });

  await test.step('where no element is, it is the menu of the rung', async () => {
    await sheet.getByText('The motor runs').click({ button: 'right' });
    await expect(entry('Negate')).toHaveCount(0);
    await entry('Insert a rung below').click();
    await expect(sheet.getByRole('group')).toHaveCount(2);
  });

  await test.step('of several rungs it says how many it deletes', async () => {
    await sheet.getByText('The motor runs').click();
    await sheet
      .getByRole('group')
      .nth(1)
      .getByText('2')
      .click({ modifiers: ['Control'] });
    await sheet.getByText('The motor runs').click({ button: 'right' });
    await expect(entry('Delete the rung')).toHaveCount(0);
    await entry('Delete 2 rungs').click();
    await expect(element('Coil on')).toHaveCount(0);
    await keyboard.press('Control+Z');
    await expect(element('Coil on')).toBeVisible();
  });
});
