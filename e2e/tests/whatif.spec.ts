import { expect, test } from '../fixtures/test';
import { Verify } from '../pages/verify';

test('from a row of a verification the smallest change of its inputs is found, tried beside others, and kept as a test', {
  tag: '@nightly',
}, async ({ openAs, server }) => {
  const ada = await openAs('Ada');
  const verify = new Verify(ada.page);
  await ada.runs();
  await expect.poll(() => ada.top.scan()).toBeGreaterThan(60);
  await server.post(`/instances/${server.instance}/verifications`, { first: 20, last: 40, range: { pou: 'Belt' } });
  await verify.show();
  await verify.maximise();
  await verify.rows.first().click();
  await verify.press('What if…');

  const form = ada.page.getByRole('form', { name: 'What if' });
  await expect(form.getByLabel('From scan')).toHaveValue('20');
  await expect(form.getByLabel('May change')).toHaveValue('Main.belt.run; Main.belt.position');
  await form.getByLabel('What should be').fill('NOT Main.belt.barrier');
  await form.getByLabel('Force all the time').uncheck();
  await form.getByRole('button', { name: 'Try' }).click();
  const table = ada.page.getByRole('table', { name: 'What came of it' });
  const best = table.getByRole('row').filter({ hasText: 'Smallest change found' });
  await expect(best).toContainText('Main.belt.position = 50');
  const saved = ada.page.waitForEvent('download');
  await ada.page.getByRole('button', { name: 'Save as test' }).click();
  expect((await saved).suggestedFilename()).toMatch(/\.scenario\.yaml$/);

  await form.getByRole('radio', { name: 'Several values' }).click();
  await form.getByLabel('Variable').fill('Main.belt.position');
  await form.getByLabel('Values', { exact: true }).fill('0..100/50, many');
  await form.getByRole('button', { name: 'Try' }).click();
  await expect(table.getByRole('row')).toHaveCount(6);
  await expect(table.getByRole('row').last()).toContainText('`many`');
});
