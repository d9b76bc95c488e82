import { expect, test } from '../fixtures/test';

// Files of the build are kept by the browser, so only the window of a browser that is new to the server has to load the editor.
test.use({ ownServer: true });

test('an editor that cannot be loaded at first comes by itself, with its styles', { tag: '@nightly' }, async ({
  server,
  browser,
}) => {
  const page = await (await browser.newContext()).newPage();
  let reachable = false;
  await page.route(/assets\/monaco/, (route) => (reachable ? route.continue() : route.abort()));
  await page.goto(server.address);
  await expect(page.getByText('could not be loaded')).toBeVisible();
  // The rest of the page lives meanwhile.
  await expect(page.getByRole('tab', { name: 'Watch' })).toBeVisible();
  reachable = true;
  await expect(page.locator('.view-line').first()).toBeVisible();
  // Without its styles the editor would show the field that it types into.
  await expect(page.locator('.monaco-editor textarea, .monaco-editor .native-edit-context').first()).toHaveCSS(
    'position',
    'absolute',
  );
  await page.context().close();
});
