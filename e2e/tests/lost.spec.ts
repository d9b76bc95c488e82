import type { WebSocket as Socket } from '@playwright/test';
import { expect, test } from '../fixtures/test';

test.use({ ownServer: true });

/** Only what hangs takes so long: the page waits for a word of the server, and for longer in front of each try. */
const LONG = 90_000;

/** Each 5 s a server that has nothing else to say; the page gives it up after 12 s. */
const saysThatItLives = (socket: Socket) =>
  socket.waitForEvent('framereceived', {
    predicate: ({ payload }) => String(payload).includes('"alive"'),
    timeout: LONG,
  });

test('without a server the page says so, keeps what was typed, and comes back by itself', async ({
  openAs,
  server,
}) => {
  const mika = await openAs('Mika');
  const main = mika.editor('Main.st');
  await mika.runs();
  await main.addBelow('uptime : TIME;', '  unsaved   : INT;');
  await expect(mika.statusBar).toContainText('Not saved');

  await test.step('the server is gone: banner, grey, nothing to press', async () => {
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

  await test.step('an entry is not lost, and says that it was not sent', async () => {
    await mika.watch.write('start', 'TRUE');
    await expect(mika.watch.refusal).toContainText('Not sent.');
    await expect(mika.watch.entry('start')).toHaveValue('TRUE');
  });

  await test.step('the server is back: the page is, too, and the text is still there', async () => {
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

test('a server that is frozen is noticed, too, and goes on where it stood', { tag: '@all' }, async ({
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

  await test.step('paused, nothing changes: that is no loss', async () => {
    await mika.page.keyboard.press('F5');
    await expect(mika.top.state).toContainText('Paused');
    for (let told = 0; told < 3; told += 1) await saysThatItLives(await socket);
    await expect(mika.statusBar).toContainText('Connected');
    await expect(mika.banner).toBeHidden();
    await mika.page.keyboard.press('F5');
    await mika.runs();
  });

  await test.step('frozen: no connection is closed, and yet the page says so', async () => {
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

  await test.step('it goes on: the page is back, and so is everything that was there', async () => {
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
