import type { WebSocket as Socket } from '@playwright/test';
import { expect, test } from '../fixtures/test';

test.use({ ownServer: true });

/** Only a failure takes this long: the page waits for a message of the server, and longer before each attempt. */
const LONG = 90_000;

/** The message that an idle server sends every 5 s; the page assumes a lost connection after 12 s. */
const saysThatItLives = (socket: Socket) =>
  socket.waitForEvent('framereceived', {
    predicate: ({ payload }) => String(payload).includes('"alive"'),
    timeout: LONG,
  });

test('without a server the page says so, keeps the entries, and reconnects by itself', { tag: '@nightly' }, async ({
  openAs,
  server,
}) => {
  const mika = await openAs('Mika');
  const main = mika.editor('Main.st');
  await mika.runs();
  await main.addBelow('uptime : TIME;', '  unsaved   : INT;');
  await expect(mika.statusBar).toContainText('Not saved');

  await test.step('the server is gone: banner, grey values, disabled controls', async () => {
    await server.kill();
    await expect(mika.banner).toContainText('No connection to line-1 since');
    await expect(mika.banner).toContainText('Your unsaved text is kept in this browser');
    await expect(mika.banner.getByRole('button', { name: 'Try now' })).toBeEnabled();
    await expect(mika.top.state).toContainText('State unknown');
    await expect(mika.statusBar).toContainText('Not connected');
    await expect(mika.top.mode('PROGRAM')).toBeDisabled();
    const scan = await mika.top.scan();
    await expect(mika.banner).toContainText(/Attempt [2-9]/);
    expect(await mika.top.scan()).toBe(scan);
  });

  await test.step('an entry is kept, with a note that it was not sent', async () => {
    await mika.watch.write('start', 'TRUE');
    await expect(mika.watch.refusal).toContainText('Not sent.');
    await expect(mika.watch.entry('start')).toHaveValue('TRUE');
  });

  await test.step('the server is back: the page reconnects, and the text is still there', async () => {
    await server.startAgain();
    await expect(mika.banner).toBeHidden({ timeout: LONG });
    await mika.runs();
    await expect(mika.statusBar).toContainText('Connected');
    await expect(main.line('unsaved : INT;')).toBeVisible();
    await expect(mika.statusBar).toContainText('Not saved');
    await mika.watch.entry('start').press('Enter');
    await mika.watch.shows('motor', 'TRUE');
    await main.save();
    await expect(mika.statusBar).toContainText(/Saved \d\d:\d\d/);
  });
});

test('a frozen server is noticed, too, and the page continues when the server does', { tag: '@nightly' }, async ({
  openAs,
  server,
}) => {
  const mika = await openAs('Mika');
  const main = mika.editor('Main.st');
  const socket = mika.page.waitForEvent('websocket');
  await mika.page.reload();
  await mika.runs();
  await mika.watch.set('start', 'TRUE');
  await mika.watch.shows('motor', 'TRUE');
  await main.addBelow('uptime : TIME;', '  unsaved   : INT;');

  await test.step('while the PLC is paused nothing changes, and the connection counts as alive', async () => {
    await mika.page.keyboard.press('F5');
    await expect(mika.top.state).toContainText('Paused');
    for (let told = 0; told < 3; told += 1) await saysThatItLives(await socket);
    await expect(mika.statusBar).toContainText('Connected');
    await expect(mika.banner).toBeHidden();
    await mika.page.keyboard.press('F5');
    await mika.runs();
  });

  await test.step('frozen: no connection is closed, but the page notices', async () => {
    server.freeze();
    await expect(mika.banner).toContainText('No connection to line-1 since', { timeout: LONG });
    await expect(mika.top.state).toContainText('State unknown');
    await expect(mika.statusBar).toContainText('Not connected');
    await expect(main.saveButton).toBeDisabled();
    await expect(main.saveButton).toHaveAttribute('title', /No connection to the server/);
    await expect(main.buildButton).toBeDisabled();
    await expect(main.buildButton).toHaveAttribute('title', /No connection to the server/);
    await expect(mika.banner).toContainText('Attempt 2', { timeout: LONG });
  });

  await test.step('the server continues: the page reconnects, and nothing was lost', async () => {
    server.thaw();
    await expect(mika.banner).toBeHidden({ timeout: LONG });
    await mika.runs();
    await mika.watch.shows('motor', 'TRUE');
    await expect(main.line('unsaved : INT;')).toBeVisible();
    await main.save();
    await expect(mika.statusBar).toContainText(/Saved \d\d:\d\d/);
    await expect(mika.top.here.getByRole('listitem')).toHaveCount(1);
  });
});
