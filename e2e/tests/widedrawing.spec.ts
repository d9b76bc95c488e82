import { drawing } from '../fixtures/drawing';
import { expect, test } from '../fixtures/test';

const NAMES = Array.from({ length: 40 }, (_, index) => `contact_${index}`);
const WIDE = `FUNCTION_BLOCK Wide
VAR ${NAMES.join(', ')}, last, small : BOOL; END_VAR
RUNG "Wider than the window"
    ${NAMES.map((name) => `[${name}]`).join(' ')} (last)
END_RUNG
RUNG "Not so wide"
    [last] (small)
END_RUNG
END_FUNCTION_BLOCK
`;

test('the end of a wide rung is scrolled to, with the titles in sight', async ({ openAs, server }) => {
  const mika = await openAs('Mika');
  const { page } = mika;
  const sheet = await drawing(mika, server, { block: 'Wide', text: WIDE, variables: 'wide : Wide;', calls: 'wide();' });
  const coil = sheet.getByRole('option', { name: 'Coil last' });
  await expect(coil).toBeAttached();
  await expect(coil).not.toBeInViewport();
  await sheet.focus();
  await page.keyboard.press('End');
  await expect(coil).toBeInViewport({ ratio: 1 });
  for (const title of ['Wider than the window', 'Not so wide'])
    await expect(sheet.getByText(title)).toBeInViewport({ ratio: 1 });
  await page.keyboard.press('Home');
  await expect(sheet.getByRole('option', { name: 'Contact contact_0' })).toBeInViewport({ ratio: 1 });
  for (const title of ['Wider than the window', 'Not so wide'])
    await expect(sheet.getByText(title)).toBeInViewport({ ratio: 1 });
});
