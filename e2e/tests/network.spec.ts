import { Fins } from '../fixtures/fins';
import type { Server } from '../fixtures/server';
import { expect, test } from '../fixtures/test';

const ASKS = `PROGRAM Main
VAR n : DINT; ready AT A202.07 : BOOL; failed AT A219.07 : BOOL; code AT A210 : WORD; END_VAR
  n := n + 1;
  IF n = 1 THEN
    %D300 := 2; %D301 := 0; %D302 := WORD#16#4E00; %D303 := WORD#16#0700; %D304 := 5;
  END_IF;
  IF failed THEN %D50 := code; END_IF;
  IF ready THEN RECV(S := %D100, D := %D0, C := %D300); END_IF;
END_PROGRAM
`;
const ANSWERS = `PROGRAM Main
VAR first AT D100 : WORD; second AT D101 : WORD; END_VAR
  first := 16#0042; second := 16#1234;
END_PROGRAM
`;

interface Seen {
  servers: { kind: string; address: string }[];
}

/** A PLC with this program, whose FINS server is on at this node; its number, and the address for clients. */
async function plc(server: Server, name: string, main: string, node: number): Promise<{ id: number; address: string }> {
  const project = await server.post<{ id: number }>('/projects', { name, model: 'CJ1M-CPU13', watch: ['D0', 'D50'] });
  await server.put(`/projects/${project.id}/files/Main.st`, { text: main, version: 0 });
  const { id } = await server.post<{ id: number }>('/instances', { project: project.id, name });
  const wanted = { on: true, host: '127.0.0.1', port: 0, access: 'write', node, error_bits: false };
  const seen = (await server.put(`/instances/${id}/communication/fins`, wanted)) as Seen;
  return { id, address: seen.servers.find(({ kind }) => kind === 'fins')?.address ?? '' };
}

test('two PLCs exchange data; one is switched off, then its line is broken, and the program of the other gets the error', {
  tag: '@nightly',
}, async ({ openAs, server }) => {
  const other = await plc(server, 'answers', ANSWERS, 78);
  const one = await plc(server, 'asks', ASKS, 77);
  const jo = await openAs('Jo', `/i/${one.id}`);
  await jo.runs();
  const { page } = jo;
  const errors = page.locator('[data-pane=errors]');
  const lines = errors.getByRole('region', { name: 'Communication lines' });
  const client = await Fins.connect(one.address, 'udp');
  const port = errors.getByRole('row', { name: /Communications port 7/i });

  await test.step('what the other one has comes by RECV', async () => {
    await expect.poll(() => client.words('D0', 2)).toEqual([0x42, 0x1234]);
    await errors.getByRole('searchbox').fill('port 7');
    await expect(port).toContainText('Never');
  });

  await test.step('it is switched off: the port has an error, and the program its completion code', async () => {
    await server.patch(`/instances/${other.id}`, { power: false });
    await expect.poll(() => client.words('D50')).toEqual([0x0205]);
    await expect(port).toContainText(/Generated|Cleared/);
    await jo.showPanel('Events');
    await expect(page.locator('[data-pane=log]')).toContainText('completion code 0205');
    await server.patch(`/instances/${other.id}`, { power: true });
    await client.write('D0', [0, 0]);
    await expect.poll(() => client.words('D0', 2)).toEqual([0x42, 0x1234]);
  });

  await test.step('the line to its clients is broken in the tree: what its own program asks gets no answer', async () => {
    await lines.getByRole('button', { name: 'Communication lines' }).click();
    await lines.getByRole('button', { name: 'Break the line of FINS' }).click();
    await page.getByRole('menuitemradio', { name: 'No answer' }).click();
    await expect(lines).toContainText('1 broken');
    await lines.getByRole('button', { name: 'Mend the line of FINS' }).click();
    await expect(lines).toContainText('nothing wrong');
    await client.write('D0', [0, 0]);
    await expect.poll(() => client.words('D0', 2)).toEqual([0x42, 0x1234]);
  });
  client.disconnect();
});
