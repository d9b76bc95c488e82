import AxeBuilder from '@axe-core/playwright';
import { DataType } from 'node-opcua-client';
import { connect } from '../fixtures/opcua';
import { expect, test } from '../fixtures/test';

test('an operator panel that speaks OPC UA shows an error that is raised here, and what it writes shows with its name', async ({
  openAs,
  server,
}) => {
  const jo = await openAs('Jo');
  await jo.runs();
  const { page } = jo;
  const pane = page.locator('[data-pane=communication]');
  const opcua = pane.getByRole('region', { name: 'OPC UA', exact: true });

  await test.step('the server is switched on with the right to write, on a port that is free', async () => {
    await page.keyboard.press('Control+Shift+P');
    await page.getByRole('combobox', { name: 'Commands' }).pressSequentially('communication unit');
    await page.getByRole('option', { name: 'Show the communication unit' }).click();
    await expect(opcua.getByRole('spinbutton', { name: 'Port' })).toHaveValue('4840');
    await opcua.getByRole('spinbutton', { name: 'Port' }).fill('0');
    await opcua.getByRole('radio', { name: 'read and write' }).click();
    await opcua.getByRole('button', { name: 'Apply' }).click();
    await opcua.getByRole('switch', { name: 'OPC UA', exact: true }).click();
    await expect(opcua).toContainText('No client is connected.');
    await expect(opcua).toContainText('with the token of this server');
  });

  const address = (await opcua.locator('.comaddress b').textContent()) ?? '';
  expect(address).toMatch(/^opc\.tcp:\/\/127\.0\.0\.1:\d+$/);
  const panel = await connect(address, 'Lia', new URL(server.address).searchParams.get('token') ?? '');
  const present = panel.show('ns=2;i=20');
  const alarms = await panel.alarms();

  await test.step('what it writes is in the memory, and in the events with its name', async () => {
    expect(await panel.write('ns=2;s=D20000', DataType.UInt16, 42)).toBe('Good');
    expect(await panel.read('ns=2;s=D20000')).toBe(42);
    await expect(opcua.getByRole('table', { name: 'Clients' })).toContainText('OPC UA Lia, Panel');
    await page.getByRole('button', { name: 'Other panels' }).click();
    await jo.showPanel('Events');
    await expect(page.locator('[data-pane=log]')).toContainText('OPC UA Lia, Panel');
    await expect(page.locator('[data-pane=log]')).toContainText('D20000 := 16#002A');
  });

  await test.step('it shows an error that is raised here, cannot write the error memory, and shows that it is gone', async () => {
    await expect.poll(present).toEqual([]);
    await server.post(`/instances/${server.instance}/errors/generate`, { errors: [{ id: 'battery-error' }] });
    await expect.poll(present).toEqual(['00F7 Battery error']);
    expect(await panel.write('ns=2;s=A400', DataType.UInt16, 0)).toBe('BadUserAccessDenied');
    await expect(opcua).toContainText('write A400');
    await expect(opcua).toContainText('BadUserAccessDenied');
    await server.post(`/instances/${server.instance}/errors/recover`, { ids: ['battery-error'] });
    await expect.poll(present).toEqual([]);
  });

  await test.step('the error is an alarm, until it is gone and somebody at the panel has acknowledged it', async () => {
    await expect.poll(alarms.all).toEqual([{ active: false, acknowledged: false, severity: 500 }]);
    expect(await alarms.acknowledge('a new battery is in')).toBe('Good');
    await expect.poll(alarms.all).toEqual([]);
    await expect(page.locator('[data-pane=log]')).toContainText('battery-error was acknowledged: a new battery is in');
  });

  await test.step('it finds the program where PLCopen has it', async () => {
    const [own, di, iec] = [
      'urn:scanbench:plc',
      'http://opcfoundation.org/UA/DI/',
      'http://PLCopen.org/OpcUa/IEC61131-3/',
    ];
    const main = await panel.find(
      [di, 'DeviceSet'],
      [own, 'line-1'],
      [iec, 'Resources'],
      [own, 'Resource'],
      [iec, 'Programs'],
      [own, 'Main'],
    );
    expect(main).toBe('ns=2;s=Main');
  });

  await test.step('it can be read by everybody', async () => {
    const { violations } = await new AxeBuilder({ page }).include('[data-pane=communication]').analyze();
    expect(violations).toEqual([]);
  });
  await panel.disconnect();
});
