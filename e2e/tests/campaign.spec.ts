import { expect, test } from '../fixtures/test';
import { Campaigns } from '../pages/campaigns';

test('a campaign: who noticed each of many disturbances; one leads to its scan, and is opened as a PLC', {
  tag: '@nightly',
}, async ({ openAs }) => {
  const mika = await openAs('Mika');
  const campaigns = new Campaigns(mika.page);
  await mika.runs();
  await campaigns.open();
  await expect(campaigns.pane).toContainText('No campaign yet');

  await test.step('a condition that cannot be is refused', async () => {
    await campaigns.field('Disturbances').fill('24');
    await campaigns.field('Noticed by the program where').fill('Main.nowhere');
    await campaigns.begin();
    await expect(campaigns.pane.getByRole('alert')).toContainText('nowhere');
  });

  await test.step('it tries all of them, and says who noticed each', async () => {
    await campaigns.field('Noticed by the program where').fill('');
    await campaigns.begin();
    await expect(campaigns.over).toBeVisible({ timeout: 60_000 });
    await expect(campaigns.rows).toHaveCount(24);
    await campaigns.outcome('verification').click();
    const found = Number((await campaigns.outcome('verification').textContent())?.replace(/\D/g, ''));
    await expect(campaigns.rows).toHaveCount(found);
  });

  await test.step('a row leads to its scan', async () => {
    const link = campaigns.rows.first().getByRole('button', { name: /^[\d,]+$/ });
    const scan = Number((await link.textContent())?.replace(/\D/g, ''));
    await link.click();
    await expect(mika.page.getByRole('slider', { name: 'Timeline' })).toHaveAttribute('aria-valuenow', String(scan));
  });

  await test.step('the run as it was disturbed is a new PLC', async () => {
    await campaigns.rows
      .first()
      .getByRole('button', { name: /^Open disturbance/ })
      .click();
    await expect(mika.page.locator('[data-pane="campaign"]')).toContainText('No campaign yet', { timeout: 60_000 });
  });
});
