import { readFile } from 'node:fs/promises';
import { Broker } from '../fixtures/broker';
import { Plant } from '../fixtures/plant';
import { expect, test } from '../fixtures/test';
import { Communication } from '../pages/communication';

test('the map of Modbus is shown, is that of the project once it has one, and is exported', {
  tag: '@nightly',
}, async ({ openAs, server }) => {
  const jo = await openAs('Jo');
  await jo.runs();
  const communication = new Communication(jo.page);
  await communication.open();
  const map = communication.part('What the registers mean');
  await expect(map.getByRole('row', { name: /Holding registers 0 \d+ D0/ })).toBeVisible();

  const own = 'group,first,last,from\nholding register,0,99,D1000\ndiscrete input,0,31,CIO100.00\n';
  await server.put(`/projects/${server.project}/files/modbus.csv`, { text: own, version: 0 });
  await expect(map.getByRole('row', { name: /Holding registers 0 99 D1000 D1099/ })).toBeVisible();
  await expect(map.getByRole('row')).toHaveCount(3);

  const download = jo.page.waitForEvent('download');
  await map.getByRole('link', { name: 'Download as CSV' }).click();
  const lines = (await readFile(await (await download).path(), 'utf8')).trim().split(/\r?\n/);
  expect(lines[0]).toMatch(/^group,first,last,from/);
  expect(lines).toHaveLength(3);
  expect(lines.join('\n')).toContain('holding register,0,99,D1000,D1099');
});

test('a plant that speaks Modbus drives inputs; its line is cut on the page, and whole again', {
  tag: '@nightly',
}, async ({ openAs }) => {
  const plant = await Plant.start();
  const jo = await openAs('Jo');
  await jo.runs();
  const communication = new Communication(jo.page);
  await communication.open();
  const part = communication.part('Plant (Modbus TCP client)');

  await test.step('it is wired, and what it says is in the memory', async () => {
    await part.getByRole('textbox', { name: 'Address of the plant' }).fill('127.0.0.1');
    await part.getByRole('spinbutton', { name: 'Port' }).fill(`${plant.port}`);
    await part.getByRole('button', { name: 'Add a range' }).click();
    await part.getByRole('textbox', { name: /Memory/ }).fill('CIO200.00');
    await part.getByRole('button', { name: 'Apply' }).click();
    await part.getByRole('switch', { name: 'Plant (Modbus TCP client)' }).click();
    await expect(part).toContainText(/exchanges/);
    plant.inputs[0] = 0b101;
    await jo.page.getByRole('button', { name: 'Other panels' }).click();
    await jo.showPanel('Watch');
    await jo.watch.add('CIO200');
    await jo.watch.shows('CIO200', '16#0005');
  });

  await test.step('a cut line is told as such, and values come again once it is whole', async () => {
    await part.getByRole('radio', { name: 'Cut' }).click();
    await expect(part).toContainText('does not answer');
    await expect(part.getByRole('alert')).toBeVisible();
    await part.getByRole('radio', { name: '100 of every 500 scans' }).click();
    await expect(part.getByRole('radio', { name: '100 of every 500 scans' })).toBeChecked();
    plant.inputs[0] = 0b110;
    await jo.watch.shows('CIO200', '16#0006'); // while the fault is gone
    await part.getByRole('radio', { name: 'None' }).click();
    await expect(part.getByRole('alert')).toHaveCount(0);
  });
  await plant.stop();
});

test('values are published to a broker with a password; a wrong one, and a broker that is gone, are told', {
  tag: '@nightly',
}, async ({ openAs }) => {
  const broker = await Broker.start('Ada', 'open sesame');
  const jo = await openAs('Jo');
  await jo.runs();
  const communication = new Communication(jo.page);
  await communication.open();
  const part = communication.part('MQTT and Sparkplug B');
  const password = part.getByLabel('Password');

  await test.step('a wrong password is told with what helps, and the right one is taken', async () => {
    await part.getByRole('spinbutton', { name: 'Port' }).fill(`${broker.port}`);
    await part.getByRole('textbox', { name: 'Variables and addresses' }).fill('D100');
    await part.getByRole('textbox', { name: 'User' }).fill('Ada');
    await password.fill('wrong');
    await expect(part).toContainText('Without TLS the password is sent as it is');
    await part.getByRole('button', { name: 'Apply' }).click();
    await expect(password).toHaveValue('');
    await part.getByRole('switch', { name: 'MQTT and Sparkplug B' }).click();
    await expect(part.getByRole('alert')).toContainText('refuses the user Ada');
    await expect(part).toContainText('not connected');
    await password.fill('open sesame');
    await part.getByRole('button', { name: 'Apply' }).click();
    await expect(part).toContainText(/\d+ messages?/);
    await expect(password).toHaveAttribute('placeholder', /^kept/);
    await expect(part.getByRole('alert')).toHaveCount(0);
  });

  await test.step('what is no certificate is refused, and stays as it was typed', async () => {
    await part.getByRole('switch', { name: 'TLS' }).click();
    await part.getByRole('textbox', { name: 'Certificate of the CA' }).fill('nothing of the kind');
    await part.getByRole('button', { name: 'Apply' }).click();
    await expect(part.getByRole('alert')).toContainText('no certificate in PEM');
    await expect(part.getByRole('textbox', { name: 'Certificate of the CA' })).toHaveValue('nothing of the kind');
    await expect(part).toContainText(/\d+ messages?/);
  });

  await test.step('the broker goes away', async () => {
    await broker.stop();
    await expect(part).toContainText('not connected');
  });
});
