import AxeBuilder from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import { expect, test } from '../fixtures/test';

interface Row {
  id: number;
}

const PROGRAM = `PROGRAM Main
VAR n : DINT; pump : BOOL; END_VAR
n := n + 1;
IF pump THEN FAL(N := 42, S := 'PUMP OVERPRESS'); MSG(3, 'CALL SERVICE'); END_IF;
END_PROGRAM
`;

/** How many characters of each name can be read: all of them where the name has less. */
async function readable(page: Page, names: string): Promise<number[]> {
  return page.locator(names).evaluateAll((all) =>
    all.map((name) => {
      const text = name.textContent ?? '';
      const shown = name.scrollWidth > name.clientWidth ? name.clientWidth / name.scrollWidth : 1;
      return shown === 1 ? Math.max(24, text.length) : Math.floor(text.length * shown) - 1;
    }),
  );
}

test('PLC errors: a FAL with its text, cleared as a tool does it, and what only the simulator recovers', {
  tag: '@nightly',
}, async ({ openAs, server }) => {
  const project = await server.post<Row>('/projects', { name: 'Pump', model: 'CJ1M-CPU63', watch: [] });
  await server.put(`/projects/${project.id}/files/main.st`, { text: PROGRAM, version: 0 });
  const plc = await server.post<Row>('/instances', { project: project.id, name: 'pump-1' });
  const jo = await openAs('Jo', `/i/${plc.id}`);
  await jo.runs();
  const { page } = jo;
  const pane = page.locator('[data-pane=plcerrors]');
  const present = pane.getByRole('table', { name: 'Errors present' });
  const log = pane.getByRole('table', { name: 'Error log of the PLC' });
  const line = (name: string) => present.getByRole('row').filter({ hasText: name });

  await test.step('without an error the window says so', async () => {
    await page.keyboard.press('Control+Shift+P');
    await page.getByRole('combobox', { name: 'Commands' }).pressSequentially("PLC's own errors");
    await page.getByRole('option', { name: "Show the PLC's own errors" }).click();
    await expect(pane).toContainText('The PLC reports no error.');
    await expect(pane).toContainText('The log is empty.');
    await expect(pane.getByRole('button', { name: 'Clear error', exact: true })).toBeDisabled();
  });

  await test.step('a FAL of the program shows with its number and its text, and so does a message', async () => {
    await server.post(`/instances/${plc.id}/write`, { path: 'Main.pump', value: 'TRUE' });
    await expect(line('FAL error')).toContainText('412A');
    await expect(line('FAL error')).toContainText('FAL number 42');
    await expect(line('FAL error')).toContainText('PUMP OVERPRESS');
    await expect(pane.getByRole('table', { name: 'Messages of the program' })).toContainText('CALL SERVICE');
    await expect(log.getByRole('row').nth(1)).toContainText('PUMP OVERPRESS');
    await server.post(`/instances/${plc.id}/write`, { path: 'Main.pump', value: 'FALSE' });
  });

  await test.step('an error whose cause lasts stays when a tool clears it; Recover takes it back', async () => {
    await server.post(`/instances/${plc.id}/errors/generate`, { errors: [{ id: 'battery-error', details: {} }] });
    await expect(line('Battery error')).toContainText('00F7');
    await pane.getByRole('button', { name: 'Clear all errors' }).click();
    await expect(line('FAL error')).toHaveCount(0);
    await pane.getByRole('button', { name: 'Clear error', exact: true }).click();
    await expect(pane.getByRole('alert')).toContainText('cause of Battery error');
    await pane.getByRole('button', { name: 'Recover: Battery error' }).click();
    await expect(pane).toContainText('The PLC reports no error.');
  });

  await test.step('in the past it is what the PLC showed then', async () => {
    const scan = await server.get<{ log: unknown[]; scan: number }>(`/instances/${plc.id}/errors/device`);
    expect(scan.log).toHaveLength(2);
    await jo.timeline.goTo(1);
    await expect(pane).toContainText('The log is empty.');
    await expect(pane.getByRole('button', { name: 'Clear log' })).toBeDisabled();
    await page.keyboard.press('Shift+Escape');
    await expect(log.getByRole('row')).toHaveCount(3);
  });

  await test.step('names can be read at every size, and the page by a screen reader', async () => {
    await server.post(`/instances/${plc.id}/write`, { path: 'Main.pump', value: 'TRUE' });
    await server.post(`/instances/${plc.id}/errors/generate`, {
      errors: [
        { id: 'special-io-unit-setting-error', details: { unit: '20' } },
        { id: 'special-io-unit-error', details: { unit: '3' } },
        { id: 'battery-error', details: {} },
      ],
    });
    await expect(line('Battery error')).toHaveCount(1);
    await page.getByRole('button', { name: 'Other panels' }).click();
    for (const [width, height] of [
      [1440, 900],
      [1024, 700],
    ] as const) {
      await page.setViewportSize({ width, height });
      await expect
        .poll(async () => Math.min(...(await readable(page, '[data-pane=plcerrors] .dname'))))
        .toBeGreaterThan(23);
      await expect.poll(async () => Math.min(...(await readable(page, '.errs .name > .cut')))).toBeGreaterThan(23);
    }
    const { violations } = await new AxeBuilder({ page }).include('[data-pane=plcerrors]').analyze();
    expect(violations.map(({ id, nodes }) => `${id}: ${nodes[0]?.html}`)).toEqual([]);
  });

  await test.step('Clear log empties it', async () => {
    await pane.getByRole('button', { name: 'Clear log' }).click();
    await expect(pane).toContainText('The log is empty.');
  });
});
