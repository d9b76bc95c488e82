import { drawing } from '../fixtures/drawing';
import { expect, test } from '../fixtures/test';

const EMPTY = `FUNCTION_BLOCK Hold
VAR_INPUT go, halt : BOOL; END_VAR
VAR_OUTPUT on : BOOL; END_VAR
NETWORK "The motor holds itself"
END_NETWORK
END_FUNCTION_BLOCK
`;

const CHART = EMPTY.replace(/NETWORK[\s\S]*END_NETWORK/, 'INITIAL_STEP Init:\nEND_STEP');

const hold = (text: string) => ({
  block: 'Hold',
  text,
  variables: 'hold : Hold;',
  calls: 'hold(go := start, halt := stop);',
});

test('a network is drawn by keys from nothing, is text at once, is built, and its value comes out @nightly', async ({
  openAs,
  server,
}) => {
  const mika = await openAs('Mika');
  const { page } = mika;
  const { keyboard } = page;
  const sheet = await drawing(mika, server, hold(EMPTY));
  const item = (name: string) => sheet.getByRole('option', { name, exact: true });
  const type = async (text: string, key: string) => {
    await expect(sheet.getByRole('combobox')).toBeFocused();
    await keyboard.type(text);
    await keyboard.press(key);
  };

  await test.step('boxes, their inputs, and a timer whose instance is declared with it', async () => {
    await sheet.focus();
    await keyboard.press('f');
    // What there is comes from the server, with its pins.
    await expect(page.getByRole('option', { name: /^TON IN, PT → Q, ET/ })).toBeAttached();
    await type('or', 'Tab');
    await type('go', 'Tab');
    await type('on', 'Enter');
    await expect(item('1: box OR to #w1')).toBeVisible();
    await expect(sheet).toBeFocused();
    await keyboard.press('Home');
    await keyboard.press('f');
    await type('AND', 'Tab');
    await type('halt', 'Enter');
    await expect(sheet).toBeFocused();
    await keyboard.press('!');
    await expect(item('Input 2 of AND: NOT halt')).toHaveAttribute('aria-selected', 'true');
    await keyboard.press('ArrowRight');
    await keyboard.press('a');
    await type('on', 'Enter');
    await expect(item('3: #w2 to on')).toBeVisible();
    await expect(sheet).toBeFocused();
    await keyboard.press('f');
    await type('TON', 'Enter');
    await type('wait', 'Tab');
    await type('T#1s', 'Enter');
    await expect(item('Input PT of wait: T#1s')).toBeVisible();
  });

  await test.step('what is taken back is gone from drawing and text, with its declaration', async () => {
    for (let edits = 0; edits < 2; edits += 1) await keyboard.press('Control+Z');
    await expect(sheet.getByRole('option', { name: 'box wait' })).toHaveCount(0);
    await page.getByRole('radio', { name: 'Both' }).click();
    const editor = mika.editor('Hold.st');
    await expect(editor.line('#w2 = AND(#w1, NOT halt);')).toBeVisible();
    await expect(editor.line('wait')).toHaveCount(0);
    await page.getByRole('radio', { name: 'Blocks' }).click();
  });

  await test.step('it is built, and its value comes out @nightly', async () => {
    await mika.editor('Hold.st').build();
    const value = sheet.getByRole('option', { name: '3: #w2 to on', exact: true });
    await expect(value).toContainText('on FALSE');
    await mika.watch.set('start', 'TRUE');
    await expect(value).toContainText('on TRUE');
    await mika.watch.set('start', 'FALSE');
    await mika.watch.set('stop', 'TRUE');
    await expect(value).toContainText('on FALSE');
  });

  await test.step('a line that is pasted sets a wire of its own, and the network has a title and is copied', async () => {
    await item('1: box OR to #w1').click();
    await keyboard.press('Control+C');
    await keyboard.press('Control+V');
    await expect(item('2: box OR to #w3')).toHaveAttribute('aria-selected', 'true');
    await keyboard.press('Control+X');
    await expect(item('2: box OR to #w3')).toHaveCount(0);
    await keyboard.press('t');
    await type('Twice', 'Enter');
    await expect(sheet.getByText('Twice')).toBeVisible();
    await expect(sheet).toBeFocused();
    await keyboard.press('Control+L');
    await keyboard.press('Control+D');
    await expect(sheet.getByRole('group')).toHaveCount(2);
    await keyboard.press('Control+/');
    await expect(sheet.getByText('switched off')).toHaveCount(1);
  });
});

test('a network is drawn with the mouse @nightly', async ({ openAs, server }) => {
  const mika = await openAs('Mika');
  const { page } = mika;
  const sheet = await drawing(mika, server, hold(EMPTY));
  const item = (name: string) => sheet.getByRole('option', { name, exact: true });
  // Its name goes on with what is wrong, as long as it is.
  const pin = (name: string) => sheet.getByRole('option', { name: new RegExp(`^${name}: nothing is connected here`) });
  const tool = (name: string) => page.getByRole('toolbar', { name: 'Edit the drawing' }).getByRole('button', { name });
  const offer = (name: RegExp) => page.getByRole('option', { name });
  const fill = async (text: string) => {
    await sheet.getByRole('combobox').fill(text);
    await sheet.getByRole('combobox').press('Enter');
    await expect(sheet.getByRole('combobox')).toHaveCount(0);
  };

  await test.step('two boxes from the picker, an input that is double-clicked, and a wire that is dragged', async () => {
    await sheet.click({ position: { x: 200, y: 20 } });
    for (const name of ['OR', 'AND']) {
      await tool('Box').click();
      await sheet.getByRole('combobox').fill(name);
      await offer(new RegExp(`^${name} IN1`)).click();
      await expect(sheet.getByRole('combobox')).toHaveCount(0);
      await sheet.getByRole('option', { name: /^1: box OR/ }).click();
    }
    // Its line of the text is dragged before the other one.
    const box = (name: RegExp) => sheet.getByRole('option', { name });
    await box(/^2: box AND/).dragTo(box(/^1: box OR/));
    await expect(box(/^1: box AND/)).toBeVisible();
    await expect(box(/^2: box OR/)).toBeVisible();
    await sheet.press('Control+Z');
    await expect(box(/^1: box OR/)).toBeVisible();
    await pin('Input 1 of OR').dblclick();
    await fill('go');
    await pin('Input 2 of OR').dblclick();
    await fill('on');
    await pin('Input 2 of AND').dblclick();
    await fill('halt');
    await tool('Negate').click();
    await item('2: box AND to #w2').click();
    await tool('Assign').click();
    await fill('on');
    await item('Input 1 of AND: #w1').click();
    await tool('Delete').click();
    await item('Output of OR to #w1').dragTo(pin('Input 1 of AND'));
    await expect(item('Input 1 of AND: #w1')).toBeVisible();
  });

  await test.step('it is built, and its value comes out', async () => {
    await mika.editor('Hold.st').build();
    const value = item('3: #w2 to on');
    await expect(value).toContainText('on FALSE');
    await mika.watch.set('start', 'TRUE');
    await expect(value).toContainText('on TRUE');
  });

  await test.step('what cannot be read is not edited, and says so', async () => {
    await page.getByRole('radio', { name: 'Both' }).click();
    await mika.editor('Hold.st').caretAfter('#w1 = OR');
    await page.keyboard.type(' )');
    await expect(sheet.getByText('cannot be drawn')).toBeVisible();
    await item('2: box AND to #w2').click();
    await tool('Box').click();
    await expect(page.getByText('This text cannot be read')).toBeVisible();
  });
});

test('a chart is drawn by keys from its first step, is built, and runs @nightly', async ({ openAs, server }) => {
  const mika = await openAs('Mika');
  const { page } = mika;
  const { keyboard } = page;
  const sheet = await drawing(mika, server, hold(CHART));
  const option = (name: string) => sheet.getByRole('option', { name, exact: true });
  const type = async (text: string, key: string) => {
    await expect(sheet.getByRole('combobox')).toBeFocused();
    await keyboard.type(text);
    await keyboard.press(key);
  };
  const key = async (name: string, text: string, last = 'Enter') => {
    await expect(sheet).toBeFocused();
    await keyboard.press(name);
    await type(text, last);
  };

  await test.step('a loop of two steps, one beside the other, actions and conditions', async () => {
    await sheet.focus();
    await keyboard.press('Home');
    await key('s', 'Fill', 'Tab');
    await type('go', 'Enter');
    await expect(option('Transition from Init to Fill: go')).toBeVisible();
    await keyboard.press('ArrowDown');
    await expect(option('Step Fill')).toHaveAttribute('aria-selected', 'true');
    await key('a', 'on');
    await expect(option('Action on, N, of step Fill')).toBeVisible();
    await key('j', 'Init', 'Tab');
    await type('halt', 'Enter');
    await expect(option('Transition from Fill to Init: halt')).toBeVisible();
    await keyboard.press('ArrowUp');
    await expect(option('Step Fill')).toHaveAttribute('aria-selected', 'true');
    await key('p', 'Heat');
    await expect(option('Transition from Init to Fill, Heat: go')).toBeVisible();
    await key('F2', 'Warm');
    await expect(option('Transition from Fill, Warm to Init: halt')).toBeVisible();
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

  await test.step('an action and a step are copied', async () => {
    await option('Action on, N, of step Fill').click();
    await keyboard.press('Control+C');
    await option('Initial step Init').click();
    await keyboard.press('Control+V');
    await expect(option('Action on, N, of step Init')).toBeVisible();
    await option('Step Fill').click();
    await keyboard.press('Control+D');
    await expect(option('Step Fill1')).toBeVisible();
    await expect(option('Action on, N, of step Fill1')).toBeVisible();
    for (let edits = 0; edits < 2; edits += 1) await keyboard.press('Control+Z');
    await expect(option('Step Fill1')).toHaveCount(0);
  });

  await test.step('an action is dragged to a different step, a step after a different one, and several steps are put in', async () => {
    const drag = async (from: string, to: string) => {
      await option(from).hover();
      await page.mouse.down();
      await option(to).hover();
      await expect(sheet.locator('[data-drop]')).toHaveCount(1);
      await page.mouse.up();
    };
    await drag('Action on, N, of step Fill', 'Initial step Init');
    await expect(option('Action on, N, of step Init')).toBeVisible();
    await expect(option('Action on, N, of step Fill')).toHaveCount(0);
    await keyboard.press('Control+Z');
    await option('Transition from Fill, Warm to Init: halt').click();
    await key('s', 'Last');
    await drag('Step Last', 'Transition from Init to Fill, Warm: go');
    await expect(option('Transition from Init to Last: go')).toBeVisible();
    await expect(option('Transition from Fill, Warm to Init: halt')).toBeVisible();
    for (let edits = 0; edits < 2; edits += 1) await keyboard.press('Control+Z');
    await expect(option('Step Last')).toHaveCount(0);
    await option('Step Fill').click();
    await option('Step Warm').click({ modifiers: ['Control'] });
    await keyboard.press('Control+C');
    await option('Transition from Fill, Warm to Init: halt').click();
    await keyboard.press('Control+V');
    await expect(option('Step Fill1')).toBeVisible();
    await expect(option('Step Warm1')).toBeVisible();
    await keyboard.press('Control+Z');
    await expect(option('Step Fill1')).toHaveCount(0);
  });

  await test.step('with the mouse: a step that is chosen, an action by its button, and what is deleted', async () => {
    const tool = (name: string) =>
      page.getByRole('toolbar', { name: 'Edit the drawing' }).getByRole('button', { name });
    await option('Step Warm').click();
    await tool('Step').click();
    await type('Hot', 'Enter');
    await expect(option('Transition from Fill, Hot to Init: halt')).toBeVisible();
    await option('Step Hot').click();
    await tool('Delete').click();
    await expect(option('Step Hot')).toHaveCount(0);
    await option('Initial step Init').click();
    await tool('Delete').click();
    await expect(page.getByText('A chart needs its initial step.')).toBeVisible();
  });
});
