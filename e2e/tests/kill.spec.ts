import { expect, test } from '../fixtures/test';

interface InstanceInfo {
  name: string;
  state: { pid: number | null; restarts: number };
}

const ERROR = 'Battery error';

test('kill -9 of the PLC is shown, and its values continue', async ({ openAs, server }, info) => {
  const mika = await openAs('Mika');
  await mika.runs();
  await mika.watch.set('start', 'TRUE');
  await expect.poll(() => mika.watch.number('Main.parts.total')).toBeGreaterThan(1);
  await mika.simulator.generate(ERROR);
  const before = { scan: await mika.top.scan(), parts: await mika.watch.number('Main.parts.total') };
  const states = await mika.top.noteStates();

  const pid = await processOf(server);
  const killedAt = Date.now();
  process.kill(pid, 'SIGKILL');

  await test.step('the page shows it', async () => {
    const shownAfter = async () => {
      const other = (await states()).find(({ at, text }) => at >= killedAt && !text.includes('Running'));
      return other ? other.at - killedAt : null;
    };
    await expect.poll(shownAfter).not.toBeNull();
    const after = await shownAfter();
    info.annotations.push({ type: 'measured', description: `shown ${after} ms after kill -9` });
    console.log(`    shown ${after} ms after kill -9`);
    expect((await states()).some(({ text }) => text.includes('Restarting'))).toBe(true);
  });

  await test.step('the PLC runs again from where it was', async () => {
    await expect(mika.top.state).toContainText('Running');
    const back = (await states()).at(-1)?.at ?? Number.NaN;
    console.log(`    running again ${back - killedAt} ms after kill -9`);
    await mika.top.scansGoOn(before.scan);
    expect(await mika.watch.number('Main.parts.total')).toBeGreaterThanOrEqual(before.parts);
    await mika.watch.shows('motor', 'TRUE');
    await expect.poll(() => mika.watch.number('Main.parts.total')).toBeGreaterThan(before.parts);
    await expect(mika.banner).toBeHidden();
    await expect(mika.statusBar).toContainText('1 restart');
    expect(await processOf(server)).not.toBe(pid);
  });

  await test.step('the error is still generated, and the history still lists it', async () => {
    await mika.watch.add('A402.04');
    await mika.watch.shows('A402.04', 'TRUE');
    await mika.showPanel('History');
    await expect(mika.history(ERROR)).toContainText(['Generated']);
    await expect(mika.history(ERROR)).toContainText(['Mika']);
  });
});

async function processOf(server: { get: <T>(path: string) => Promise<T> }): Promise<number> {
  const [instance] = await server.get<InstanceInfo[]>('/instances');
  if (!instance?.state.pid) throw new Error('the instance has no process');
  return instance.state.pid;
}
