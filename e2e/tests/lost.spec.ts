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
    await expect(mika.banner).toContainText('Attempt 2');
    expect(await mika.top.scan()).toBe(scan);
  });

  await test.step('an entry is not lost, and says that it was not sent', async () => {
    await mika.watch.write('start', 'TRUE');
    await expect(mika.watch.refusal).toContainText('Not sent yet.');
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
