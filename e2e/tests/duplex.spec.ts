import AxeBuilder from '@axe-core/playwright';
import { expect, test } from '../fixtures/test';

interface Row {
  id: number;
}

const PROGRAM = `PROGRAM Main
VAR n : DINT; alone AT CIO 100.00 : BOOL; duplex AT A328.08 : BOOL; END_VAR
n := n + 1;
alone := NOT duplex;
END_PROGRAM
`;

test('a PLC of two CPU Units: the standby takes over, and the failed one comes back', {
  tag: '@nightly',
}, async ({ openAs, server }) => {
  const project = await server.post<Row>('/projects', { name: 'Duplex', model: 'CS1D-CPU65H', watch: [] });
  await server.put(`/projects/${project.id}/files/main.st`, { text: PROGRAM, version: 0 });
  const plc = await server.post<Row>('/instances', { project: project.id, name: 'duplex-1' });
  const raise = (id: string) => server.post(`/instances/${plc.id}/errors/generate`, { errors: [{ id, details: {} }] });
  const jo = await openAs('Jo', `/i/${plc.id}`);
  await jo.runs();
  const { page } = jo;
  const pane = page.locator('[data-pane=plcerrors]');
  const units = pane.getByRole('region', { name: 'CPU Units' });
  await page.keyboard.press('Control+Shift+P');
  await page.getByRole('combobox', { name: 'Commands' }).pressSequentially("PLC's own errors");
  await page.getByRole('option', { name: "Show the PLC's own errors" }).click();
  await expect(units).toContainText('Duplex: both CPU Units run, the left one controls.');

  await test.step('the program goes on in simplex, and the page says why', async () => {
    await raise('memory-error');
    await expect(units).toContainText('Simplex: the right CPU Unit controls');
    await expect(units).toContainText('Memory error');
    await jo.runs();
    await expect(jo.banner).toBeHidden();
    await raise('communications-port-3-error');
    await expect(pane.getByRole('row').filter({ hasText: 'Communications port 3' })).toContainText('no code');
    const { violations } = await new AxeBuilder({ page }).include('[data-pane=plcerrors]').analyze();
    expect(violations.map(({ id, nodes }) => `${id}: ${nodes[0]?.html}`)).toEqual([]);
  });

  await test.step('a tool clears the error, and simplex stays until the failed one is repaired', async () => {
    await server.post(`/instances/${plc.id}/errors/recover`, { ids: ['communications-port-3-error'] });
    await pane.getByRole('button', { name: 'Clear all errors' }).click();
    await expect(pane).toContainText('The PLC reports no error.');
    await units.getByRole('button', { name: 'Repair' }).click();
    await expect(units).toContainText('Duplex: both CPU Units run, the right one controls.');
  });

  await test.step('the second one stops it', async () => {
    await raise('memory-error');
    await expect(units).toContainText('Simplex: the left CPU Unit controls');
    await raise('cycle-time-over');
    await expect(jo.top.state).toContainText('Fatal error');
    await expect(jo.banner).toContainText('Cycle time too long');
  });
});
