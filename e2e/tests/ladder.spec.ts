import { drawing } from '../fixtures/drawing';
import { expect, test } from '../fixtures/test';

const EMPTY = `FUNCTION_BLOCK Latch
VAR_INPUT go, halt : BOOL; END_VAR
VAR_OUTPUT on : BOOL; END_VAR
RUNG "The motor holds itself"
END_RUNG
END_FUNCTION_BLOCK
`;

test('a rung is drawn by keys, is text at once, and shows where power flows', async ({ openAs, server }) => {
  const mika = await openAs('Mika');
  const { page } = mika;
  const { keyboard } = page;
  const sheet = await drawing(mika, server, {
    block: 'Latch',
    text: EMPTY,
    variables: 'latch : Latch;',
    calls: 'latch(go := start);',
  });
  await test.step('a motor that holds itself, from nothing, by the keyboard alone', async () => {
    await expect(sheet).toContainText('The motor holds itself');
    await sheet.focus();
    for (const [key, name] of [
      ['c', 'go'],
      ['w', 'on'],
    ] as const) {
      await keyboard.press(key);
      await keyboard.type(name);
      await keyboard.press('Enter');
      await expect(sheet.getByRole('option', { name: `Contact ${name}` })).toBeVisible();
      await expect(sheet).toBeFocused();
    }
    await keyboard.press('ArrowUp');
    await keyboard.press('Home');
    expect.soft(await sheet.getByRole('option', { selected: true }).getAttribute('aria-label')).toBe('Contact go');
    await keyboard.press('o');
    await keyboard.type('on');
    await keyboard.press('Enter');
    await expect(sheet.getByRole('option', { name: 'Coil on' })).toBeVisible();
  });

  await test.step('what is taken back is gone from drawing and text, and comes again', async () => {
    await keyboard.press('Control+Z');
    await expect(sheet.getByRole('option', { name: 'Coil on' })).toHaveCount(0);
    await keyboard.press('Control+Y');
    await expect(sheet.getByRole('option', { name: 'Coil on' })).toBeVisible();
  });

  await test.step('a closed contact is still a closed one after it is given its name', async () => {
    await sheet.getByRole('option', { name: 'Contact go' }).click();
    await keyboard.press('!');
    await expect(sheet.getByRole('option', { name: 'Closed contact go' })).toBeVisible();
    await keyboard.press('F2');
    await keyboard.type('on');
    await keyboard.press('Enter');
    await expect(sheet.getByRole('option', { name: 'Closed contact on' })).toBeVisible();
    await keyboard.press('Control+Z');
    await keyboard.press('!');
    await expect(sheet.getByRole('option', { name: 'Contact go', exact: true })).toBeVisible();
  });

  await test.step('Escape in a field leaves the rung as it is', async () => {
    await sheet.getByRole('option', { name: 'Contact go', exact: true }).click();
    for (const key of ['F2', 'c']) {
      await keyboard.press(key);
      await keyboard.type('zzz');
      // The first Escape would close the list of offers.
      await expect(sheet.getByRole('combobox')).toHaveAttribute('aria-expanded', 'false');
      await keyboard.press('Escape');
      await expect(sheet).toBeFocused();
      await expect(sheet.getByRole('combobox')).toHaveCount(0);
      await expect(sheet.getByRole('option', { name: 'zzz' })).toHaveCount(0);
    }
    await expect(sheet.getByRole('option', { name: 'Contact go', exact: true })).toBeVisible();
  });

  await test.step('it is built, and power flows where its contacts are closed', async () => {
    await mika.editor('Latch.st').build();
    await mika.watch.set('start', 'TRUE');
    await expect(sheet.locator('.el.on')).toHaveCount(3);
    await mika.watch.set('start', 'FALSE');
    await expect(sheet.locator('.el.on')).toHaveCount(2);
  });

  await test.step('a breakpoint halts before its contact, and a step goes on to the coil', async () => {
    const contact = sheet.getByRole('option', { name: 'Contact go' });
    await contact.click();
    await keyboard.press('F9');
    await expect(sheet.getByRole('option', { name: 'Contact go, next element, breakpoint' })).toBeVisible();
    await expect(sheet.getByText('next element')).toBeVisible();
    await contact.click();
    await keyboard.press('F9');
    await expect(sheet.getByRole('option', { name: 'Contact go, next element', exact: true })).toBeVisible();
    await keyboard.press('F10');
    await expect(sheet.getByRole('option', { name: 'Coil on, next element' })).toBeVisible();
    await keyboard.press('F5');
    await expect(sheet.getByText('next element')).toHaveCount(0);
    await expect(mika.statusBar).not.toContainText('earlier halt');
  });

  await test.step('a coil that two rungs write is told in both', async () => {
    await sheet.focus();
    await keyboard.press('Control+I');
    for (const [key, name] of [
      ['c', 'halt'],
      ['w', 'on'],
    ] as const) {
      await keyboard.press(key);
      await keyboard.type(name);
      await keyboard.press('Enter');
      await expect(sheet).toBeFocused();
    }
    await keyboard.press('End');
    await keyboard.press('o');
    await keyboard.type('on');
    await keyboard.press('Enter');
    await expect(sheet.getByText('Rungs 1, 2 write on; the last one counts')).toHaveCount(2);
    for (let edits = 0; edits < 4; edits += 1) await keyboard.press('Control+Z');
    await expect(sheet.getByText('Rungs 1, 2 write on')).toHaveCount(0);
  });

  await test.step('elements and rungs are copied as text, repeated, named and switched off', async () => {
    await sheet.focus();
    await keyboard.press('Control+L');
    await keyboard.press('Control+C');
    await keyboard.press('Control+V');
    await expect(sheet.getByRole('group')).toHaveCount(2);
    const second = sheet.getByRole('group').nth(1);
    await expect(second.getByRole('option', { name: 'Coil on' })).toBeVisible();
    await keyboard.press('t');
    await keyboard.press('Control+A');
    await keyboard.type('Once more');
    await keyboard.press('Enter');
    await expect(second).toContainText('Once more');
    await expect(sheet).toBeFocused();
    await second.getByRole('option', { name: 'Contact go' }).click();
    await keyboard.press('Control+D');
    await expect(second.getByRole('option', { name: 'Contact go' })).toHaveCount(2);
    await keyboard.press('Control+X');
    await expect(second.getByRole('option', { name: 'Contact go' })).toHaveCount(1);
    await keyboard.press('Control+/');
    await expect(second).toContainText('switched off');
    await second.getByText('Once more').click();
    await keyboard.press('Control+X');
    await expect(sheet.getByRole('group')).toHaveCount(1);
    await page.evaluate(() => {
      const data = new DataTransfer();
      data.setData('text/plain', 'hello world');
      document.activeElement?.dispatchEvent(new ClipboardEvent('paste', { clipboardData: data, bubbles: true }));
    });
    await expect(page.getByText('The clipboard has no rung, network or element that fits here.')).toBeVisible();
  });

  await test.step('a name that is not declared is told at its contact, and declared from there', async () => {
    await sheet.getByRole('option', { name: 'Contact go', exact: true }).click();
    await keyboard.press('c');
    await keyboard.type('nix');
    await keyboard.press('Enter');
    const wrong = sheet.getByRole('option', { name: 'Contact nix, `nix` is not declared.' });
    await expect(wrong).toHaveAttribute('aria-selected', 'true');
    await expect(sheet.getByTitle('`nix` is not declared.')).toBeVisible();
    await page.getByRole('button', { name: 'Declare nix : BOOL' }).click();
    await expect(sheet.getByRole('option', { name: 'Contact nix', exact: true })).toBeVisible();
    for (let edits = 0; edits < 2; edits += 1) await keyboard.press('Control+Z');
    await expect(sheet.getByRole('option', { name: 'Contact nix' })).toHaveCount(0);
  });

  await test.step('several elements are chosen, copied, deleted, and dragged into a different rung', async () => {
    const chosen = sheet.getByRole('option', { selected: true });
    await sheet.getByRole('option', { name: 'Contact go', exact: true }).click();
    await keyboard.press('Shift+End');
    await expect(chosen).toHaveCount(4);
    await keyboard.press('Escape');
    await expect(chosen).toHaveCount(1);
    await sheet.getByRole('option', { name: 'Contact go', exact: true }).click();
    await sheet.getByRole('option', { name: 'Coil on' }).click({ modifiers: ['Control'] });
    await expect(chosen).toHaveCount(2);
    await keyboard.press('Control+C');
    await keyboard.press('Control+I');
    await keyboard.press('Control+V');
    const [first, second] = [sheet.getByRole('group').first(), sheet.getByRole('group').nth(1)];
    await expect(second.getByRole('option')).toHaveCount(2);
    await keyboard.press('Shift+ArrowLeft');
    await keyboard.press('Delete');
    await expect(second.getByRole('option')).toHaveCount(0);
    await first.getByRole('option', { name: 'Contact go' }).hover();
    await page.mouse.down();
    await second.getByRole('presentation').first().hover();
    await expect(sheet.locator('.drops .over')).toHaveCount(1);
    await page.mouse.up();
    await expect(second.getByRole('option', { name: 'Contact go' })).toBeVisible();
    await expect(first.getByRole('option', { name: 'Contact go' })).toHaveCount(0);
    await keyboard.press('Control+Shift+A');
    await keyboard.press('Delete');
    await expect(sheet.getByRole('group')).toHaveCount(1);
    await expect(sheet.getByRole('option')).toHaveCount(0);
    for (let edits = 0; edits < 5; edits += 1) await keyboard.press('Control+Z');
    await expect(sheet.getByRole('group')).toHaveCount(1);
    await expect(sheet.getByRole('option', { name: 'Coil on' })).toBeVisible();
  });

  await test.step('a pin of a box has a field of its own: a double click opens it, and Tab goes from pin to pin', async () => {
    await sheet.getByRole('option', { name: 'Contact go', exact: true }).click();
    await keyboard.press('f');
    await keyboard.type('TON');
    await keyboard.press('Enter');
    await expect(sheet.getByRole('combobox')).toHaveValue('ton1');
    await keyboard.type('late');
    await keyboard.press('Tab');
    const field = page.getByRole('combobox', { name: 'Input PT of late: nothing is connected here' });
    await expect(field).toBeFocused();
    await keyboard.type('T#2s');
    await keyboard.press('Enter');
    const timer = sheet.getByRole('option', { name: 'Box late' });
    await expect(timer).toContainText('T#2s');
    await expect(sheet.getByText('not built yet: it did not run')).toHaveCount(1);
    const place = await timer.getByText('T#2s').boundingBox();
    if (!place) throw new Error('no pin');
    await page.mouse.dblclick(place.x + place.width / 2, place.y + place.height / 2);
    await expect(page.getByRole('combobox', { name: 'Input PT of late: T#2s' })).toBeFocused();
    await keyboard.press('Control+A');
    await keyboard.type('T#1h2m3s');
    await keyboard.press('Enter');
    await expect(timer).toContainText('T#1h2m3s');
    for (let edits = 0; edits < 3; edits += 1) await keyboard.press('Control+Z');
    await expect(timer).toHaveCount(0);
  });

  await test.step('a variable has a different name in all files: Ctrl+F2', async () => {
    await sheet.getByRole('option', { name: 'Contact go', exact: true }).click();
    await keyboard.press('Control+F2');
    await page.getByRole('dialog').getByRole('textbox').fill('begin');
    await keyboard.press('Enter');
    await expect(sheet.getByRole('option', { name: 'Contact begin', exact: true })).toBeVisible();
    await expect(sheet.getByRole('option', { name: 'Contact go' })).toHaveCount(0);
  });

  await test.step('a whole rung is dragged by its number', async () => {
    await sheet.getByRole('option', { name: 'Coil on' }).click();
    await keyboard.press('Control+I');
    await keyboard.press('t');
    await keyboard.type('The other');
    await keyboard.press('Enter');
    const groups = sheet.getByRole('group');
    await expect(groups.nth(1)).toContainText('The other');
    await groups.nth(1).locator('.no').hover();
    await page.mouse.down();
    await groups.first().locator('.hd').hover();
    await expect(sheet.locator('.dropabove')).toHaveCount(1);
    await page.mouse.up();
    await expect(groups.first()).toContainText('The other');
    await expect(groups.nth(1).getByRole('option', { name: 'Coil on' })).toBeVisible();
    for (let edits = 0; edits < 3; edits += 1) await keyboard.press('Control+Z');
    await expect(groups).toHaveCount(1);
  });

  await test.step('the only rung of a block is emptied, not taken away with its drawing', async () => {
    await keyboard.press('Control+Delete');
    await expect(sheet.getByRole('option')).toHaveCount(0);
    await expect(sheet.getByRole('group')).toHaveCount(1);
    await expect(page.getByRole('radio', { name: 'Ladder' })).toBeChecked();
    await keyboard.press('Control+Z');
    await expect(sheet.getByRole('option', { name: 'Coil on' })).toBeVisible();
  });

  await test.step('it is the text of the file', async () => {
    await page.getByRole('radio', { name: 'Both' }).click();
    await expect(mika.editor('Latch.st').line('| [on]')).toBeVisible();
    await expect(mika.editor('Latch.st').line('> (on)')).toBeVisible();
  });

  await test.step('what comes into the rung while a field is open stays, and so does what is typed', async () => {
    await keyboard.press('Control+S');
    const project = (await server.get<{ id: number }[]>('/projects'))[0]?.id;
    const saved = () => server.get<{ text: string; version: number }>(`/projects/${project}/files/Latch.st`);
    await expect.poll(async () => (await saved()).text).toContain('| [on]');
    const { text, version } = await saved();
    await sheet.getByRole('option', { name: 'Coil on' }).click();
    await keyboard.press('F2');
    await keyboard.type('ha');
    const data = { text: text.replace('> (on)', '> [go] (on)'), version };
    const file = new URL(`/api/projects/${project}/files/Latch.st`, page.url()).href;
    expect((await page.request.put(file, { data })).status()).toBe(200);
    await expect(sheet.getByRole('option', { name: 'Contact go' })).toBeVisible();
    await expect(sheet.getByRole('combobox')).toBeFocused();
    await keyboard.type('lt');
    await keyboard.press('Enter');
    await expect(sheet.getByRole('option', { name: 'Coil halt' })).toBeVisible();
    await expect(sheet.getByRole('option', { name: 'Contact go' })).toBeVisible();
  });
});
