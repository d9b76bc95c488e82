import { expect, test } from '../fixtures/test';
import { Ide } from '../pages/ide';

test.use({ ownServer: true });

test('a colleague who follows a link is asked for the token, and then reaches the target of the link', {
  tag: '@nightly',
}, async ({ browser, server, openAs }) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const { origin, searchParams } = new URL(server.address);
  const link = `${origin}/i/1?panel=history`;
  const page = await (await browser.newContext()).newPage();
  const token = page.getByLabel('Token');

  await test.step('the plain address is refused, with a field for the token', async () => {
    await page.goto(link);
    await expect(page.getByRole('heading', { level: 1 })).toHaveText('This server requires its token');
    await expect(page.getByRole('alert')).toHaveCount(0);
    expect((await page.request.get(`${origin}/api/projects`)).status()).toBe(401);
  });

  await test.step('a wrong token is refused', async () => {
    await token.fill('wrong');
    await page.getByRole('button', { name: 'Open' }).click();
    await expect(page.getByRole('alert')).toContainText('not the token of this server');
  });

  const jo = new Ide(page);
  await test.step('the right token opens the target of the link', async () => {
    await token.fill(searchParams.get('token') ?? '');
    await token.press('Enter');
    await jo.runs();
    await expect(page.getByRole('tab', { name: 'History', selected: true })).toBeVisible();
    await expect(page).toHaveURL(`${origin}/i/1`);
  });

  await test.step('the next link needs no token', async () => {
    await page.goto(`${origin}/i/1`);
    await jo.runs();
  });

  await test.step('after the browser lost the token, the page itself asks for it', async () => {
    // Without a server no answer that is still under way can bring the token back.
    await server.kill();
    await page.context().clearCookies();
    await server.startAgain();
    await expect(page.getByRole('heading', { name: 'This server requires its token' })).toBeVisible();
    await token.fill(server.address);
    await page.getByRole('button', { name: 'Open' }).click();
    await jo.runs();
  });
  await page.context().close();
});
