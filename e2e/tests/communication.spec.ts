import net from 'node:net';
import AxeBuilder from '@axe-core/playwright';
import { client as modbus } from 'jsmodbus';
import { Fins, hostAndPort } from '../fixtures/fins';
import { expect, test } from '../fixtures/test';

test('clients that somebody else wrote see an error that was raised here, and what they write shows with their name', async ({
  openAs,
  server,
}) => {
  const jo = await openAs('Jo');
  await jo.runs();
  const { page } = jo;
  const pane = page.locator('[data-pane=communication]');
  const fins = pane.getByRole('region', { name: 'FINS (UDP and TCP)', exact: true });
  const raise = (id: string) => server.post(`/instances/${server.instance}/errors/generate`, { errors: [{ id }] });

  await test.step('a server is off at first; it is switched on with the right to write', async () => {
    await page.keyboard.press('Control+Shift+P');
    await page.getByRole('combobox', { name: 'Commands' }).pressSequentially('communication unit');
    await page.getByRole('option', { name: 'Show the communication unit' }).click();
    await fins.getByRole('radio', { name: 'read and write' }).click();
    await fins.getByRole('button', { name: 'Apply' }).click();
    await fins.getByRole('switch', { name: 'FINS' }).click(); // at once: it begins with what was applied
    await expect(fins).toContainText('No client is connected.');
  });

  const address = (await fins.locator('.comaddress b').textContent()) ?? '';
  const client = await Fins.connect(address, 'udp');
  const name = 'FINS 127.0.0.1, node 25';

  await test.step('what a FINS client writes is in the memory and in the events, with its name', async () => {
    expect(await client.write('D20000', [42, 7])).toBe('0000');
    expect(await client.words('D20000', 2)).toEqual([42, 7]);
    await expect(fins.getByRole('table', { name: 'Clients' })).toContainText(name);
    await page.getByRole('button', { name: 'Other panels' }).click();
    await jo.showPanel('Events');
    await expect(page.locator('[data-pane=log]')).toContainText(name);
    await expect(page.locator('[data-pane=log]')).toContainText('D20000 to D20001 written, 2 words');
  });

  await test.step('it sees an error that is raised here; writing the error memory is refused, and the page says so', async () => {
    await raise('battery-error');
    await expect.poll(() => client.words('A400')).toEqual([0xf7]);
    expect(await client.write('A400', [0])).toBe('2101');
    await expect(fins).toContainText('2101 this memory is read-only');
    await expect(pane.getByRole('table', { name: 'Who reads the error memory' })).toContainText('A400');
  });

  await test.step('an HMI by Modbus writes, is refused on the error memory, and sees an error and that it is recovered', async () => {
    const map =
      'group,first,last,from\nholding register,0,9,D20010\nholding register,100,100,A400\ninput register,0,2,A400\n';
    await server.put(`/projects/${server.project}/files/modbus.csv`, { text: map, version: 0 });
    const section = pane.getByRole('region', { name: 'Modbus TCP', exact: true });
    await section.getByRole('radio', { name: 'read and write' }).click();
    await section.getByRole('button', { name: 'Apply' }).click();
    await section.getByRole('switch', { name: 'Modbus TCP' }).click();
    await expect(section).toContainText('No client is connected.');
    const socket = new net.Socket();
    const hmi = new modbus.TCP(socket, 1);
    const { host, port } = hostAndPort((await section.locator('.comaddress b').textContent()) ?? '');
    await new Promise<void>((connected) => socket.connect({ host, port }, connected));
    await hmi.writeMultipleRegisters(0, [11, 12]);
    expect(await client.words('D20010', 2)).toEqual([11, 12]);
    expect((await hmi.readHoldingRegisters(1, 1)).response.body.values[0]).toBe(12);
    await expect(page.locator('[data-pane=log]')).toContainText('D20010 to D20011 written, 2 words');
    const refused = await hmi.writeSingleRegister(100, 0).then(
      () => 'done',
      (error: { err: string }) => error.err,
    );
    expect(refused).toBe('ModbusException');
    await expect(section).toContainText('02 an address means nothing, or cannot be written');
    const code = async () => (await hmi.readInputRegisters(0, 1)).response.body.values[0];
    await expect.poll(code).toBe(0xf7);
    await server.post(`/instances/${server.instance}/errors/recover`, { ids: ['battery-error'] });
    await expect.poll(code).toBe(0);
    await expect.poll(() => client.words('A402')).toEqual([0]);
    socket.end();
  });

  await test.step('what cannot be set is told where it was typed, and stays told', async () => {
    await fins.getByRole('textbox', { name: 'Address' }).fill('somewhere');
    await fins.getByRole('button', { name: 'Apply' }).click();
    await expect(fins.getByRole('alert')).toContainText('is no IP address');
    await expect.poll(() => client.words('D20000')).toEqual([42]);
    await expect(fins.getByRole('alert')).toContainText('is no IP address');
    await expect(fins.getByRole('textbox', { name: 'Address' })).toHaveValue('somewhere');
  });

  await test.step('it can be read by everybody', async () => {
    const { violations } = await new AxeBuilder({ page }).include('[data-pane=communication]').analyze();
    expect(violations).toEqual([]);
  });
  client.disconnect();
});
