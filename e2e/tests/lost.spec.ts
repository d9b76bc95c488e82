import { expect, test } from '../fixtures/test';

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
    await expect(mika.banner).toBeHidden({ timeout: 20_000 });
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

test('a server that is frozen is noticed, too, and goes on where it stood', async ({ openAs, server }) => {
  const mika = await openAs('Mika');
  const main = mika.editor('Main.st');
  await mika.runs();
  await mika.watch.set('start', 'TRUE');
  await mika.watch.shows('motor', 'TRUE');
  await main.addBelow('uptime : TIME;', '  unsaved   : INT;');

  await test.step('paused, nothing changes: that is no loss', async () => {
    await mika.page.keyboard.press('F5');
    await expect(mika.top.state).toContainText('Paused');
    await mika.page.waitForTimeout(14_000);
    await expect(mika.statusBar).toContainText('Connected');
    await expect(mika.banner).toBeHidden();
    await mika.page.keyboard.press('F5');
    await mika.runs();
  });

  await test.step('frozen: no connection is closed, and yet the page says so', async () => {
    server.freeze();
    await expect(mika.banner).toContainText('No connection to line-1 since', { timeout: 16_000 });
    await expect(mika.top.state).toContainText('State unknown');
    await expect(mika.statusBar).toContainText('Not connected');
    await expect(main.saveButton).toBeDisabled();
    await expect(main.saveButton).toHaveAttribute('title', /No connection to the server/);
    await expect(main.buildButton).toBeDisabled();
    await expect(main.buildButton).toHaveAttribute('title', /No connection to the server/);
    await expect(mika.banner).toContainText('Attempt 2', { timeout: 15_000 });
  });

  await test.step('it goes on: the page is back, and so is everything that was there', async () => {
    server.thaw();
    await expect(mika.banner).toBeHidden({ timeout: 20_000 });
    await mika.runs();
    await mika.watch.shows('motor', 'TRUE');
    await expect(main.line('unsaved : INT;')).toBeVisible();
    await main.save();
    await expect(mika.statusBar).toContainText(/Saved \d\d:\d\d/);
    await expect(mika.top.here.getByRole('listitem')).toHaveCount(1);
  });
});
