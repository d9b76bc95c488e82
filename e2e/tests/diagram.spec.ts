import type { Locator } from '@playwright/test';
import type { Server } from '../fixtures/server';
import { expect, test } from '../fixtures/test';
import type { Ide } from '../pages/ide';

const EMPTY = `FUNCTION_BLOCK Hold
VAR_INPUT go, halt : BOOL; END_VAR
VAR_OUTPUT on : BOOL; END_VAR
NETWORK "The motor holds itself"
END_NETWORK
END_FUNCTION_BLOCK
`;

/** Opens the drawing of a block with an empty network, which the main program calls. */
async function drawing(mika: Ide, server: Server): Promise<Locator> {
  const { page } = mika;
  await mika.runs();
  const project = (await server.get<{ id: number; name: string }[]>('/projects'))[0]?.id;
  const files = new URL(`/api/projects/${project}/files/`, page.url()).href;
  const { text, version } = await server.get<{ text: string; version: number }>(`/projects/${project}/files/Main.st`);
  const main = text
    .replace('END_VAR', '  hold : Hold;\nEND_VAR')
    .replace('END_PROGRAM', 'hold(go := start, halt := stop);\nEND_PROGRAM');
  for (const [file, data] of [
    ['Hold.st', { text: EMPTY, version: 0 }],
    ['Main.st', { text: main, version }],
  ] as const)
    expect((await page.request.put(`${files}${file}`, { data })).status()).toBe(200);
  const sheet = page.getByRole('listbox', { name: 'Drawing of Hold.st' });
  await mika.explorer.item('Hold').dblclick();
  await expect(sheet).toContainText('The motor holds itself');
  return sheet;
}

test('a network is drawn by keys from nothing, is text at once, is built, and its value comes out @nightly', async ({
  openAs,
  server,
}) => {
  const mika = await openAs('Mika');
  const { page } = mika;
  const { keyboard } = page;
  const sheet = await drawing(mika, server);
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
});
