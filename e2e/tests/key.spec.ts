import { expect, test } from '../fixtures/test';
import { Ide } from '../pages/ide';

test.use({ ownServer: true });

test('a colleague who follows a link is asked for the key, and comes to where the link leads', async ({
  browser,
  server,
  openAs,
}) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const { origin, searchParams } = new URL(server.address);
  const link = `${origin}/i/1?panel=history`;
  const page = await (await browser.newContext()).newPage();
  const key = page.getByLabel('Key');

  await test.step('the address alone is refused, with a field for the key', async () => {
    await page.goto(link);
    await expect(page.getByRole('heading', { level: 1 })).toHaveText('This bench has a key');
    await expect(page.getByRole('alert')).toHaveCount(0);
    expect((await page.request.get(`${origin}/api/projects`)).status()).toBe(401);
  });

  await test.step('a wrong key is refused there', async () => {
    await key.fill('wrong');
    await page.getByRole('button', { name: 'Open' }).click();
    await expect(page.getByRole('alert')).toContainText('not the key of this server');
  });

  const jo = new Ide(page);
  await test.step('the right one leads to where the link leads', async () => {
    await key.fill(searchParams.get('token') ?? '');
    await key.press('Enter');
    await jo.runs();
    await expect(page.getByRole('tab', { name: 'History', selected: true })).toBeVisible();
    await expect(page).toHaveURL(`${origin}/i/1`);
  });

  await test.step('the next link needs no key', async () => {
    await page.goto(`${origin}/i/1`);
    await jo.runs();
  });

  await test.step('once the key is not known any more, the page itself asks for it', async () => {
    await page.context().clearCookies();
    await server.kill();
    await server.startAgain();
    await expect(page.getByRole('heading', { name: 'This server requires its key' })).toBeVisible();
    await key.fill(server.address);
    await page.getByRole('button', { name: 'Open' }).click();
    await jo.runs();
  });
  await page.context().close();
});
