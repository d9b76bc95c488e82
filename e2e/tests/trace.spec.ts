import { expect, test } from '../fixtures/test';
import { Trace } from '../pages/trace';

test('signals are recorded, a trigger catches an error, and earlier scans are recorded afterwards', {
  tag: '@nightly',
}, async ({ openAs, server }) => {
  const mika = await openAs('Mika');
  const trace = new Trace(mika.page);
  await mika.runs();
  await mika.watch.set('start', 'TRUE');

  await test.step('signals are added by typing; a wrong one is refused', async () => {
    await trace.show();
    await expect(trace.pane).toContainText('No signals yet');
    await trace.add('Main.belt.position');
    await trace.add('motor');
    await trace.add('A402.12');
    await trace.add('Main.belt.position * 2');
    const box = mika.page.getByRole('combobox', { name: 'Signal to record' });
    await box.fill('Main.belt.positon');
    await box.press('Enter');
    await expect(trace.pane.getByRole('alert')).toContainText('Main.belt.position');
    await trace.pane.getByRole('alert').getByRole('button', { name: 'Close' }).click();
    await box.fill('');
    await expect(trace.state).toHaveText('Recording');
    await expect.poll(() => trace.inks()).toBeGreaterThan(200);
  });

  const jo = await openAs('Jo');
  const others = new Trace(jo.page);
  await test.step('a colleague has the same trace', async () => {
    await jo.runs();
    await others.show();
    await expect(others.row('Main.belt.position * 2')).toBeVisible();
    await expect(others.state).toHaveText('Recording');
  });

  await test.step('armed on a rising edge, the trace waits, and an error triggers it', async () => {
    await trace.enter('Buffer', '400');
    await trace.arm('A402.12', 'rises');
    await trace.enter('Before', '70');
    await expect(trace.pane).toContainText('280 of 400 scans');
    await expect(trace.state).toHaveText('Armed');
    await expect(others.state).toHaveText('Armed');
    // all scans before the trigger are recorded
    const rows = async () => (await server.get<{ rows: number }[]>(`/instances/${server.instance}/traces`))[0]?.rows;
    await expect.poll(rows).toBeGreaterThan(280);
    await mika.simulator.generate('Basic I/O Unit error');
    await expect(trace.state).toHaveText('Complete');
    await expect(others.state).toHaveText('Complete');
    await expect(trace.pane).toContainText(/scan [\d,]+, A402\.12 rises/);
  });

  await test.step('the cursors read values, also by keyboard', async () => {
    await trace.clickAt(0.3);
    await trace.clickAt(0.9);
    const before = await trace.scanOf('A');
    await expect.poll(() => trace.scanOf('B')).toBeGreaterThan(before);
    await expect(trace.row('A402.12')).toContainText(/FALSE.*TRUE.*rose/);
    await expect(trace.row('motor')).toContainText(/TRUE.*FALSE.*fell/);
    await trace.cursor('A').focus();
    await mika.page.keyboard.press('ArrowRight');
    await expect.poll(() => trace.scanOf('A')).toBe(before + 1);
    await mika.page.keyboard.press('Home');
    const first = await trace.scanOf('A');
    await mika.page.keyboard.press('End');
    await expect.poll(() => trace.scanOf('A')).toBe(first + 399);
    await mika.page.keyboard.press('Home');
  });

  await test.step('the exported file has every scan', async () => {
    const [head, ...rows] = await trace.csv();
    expect(head).toEqual(['scan', 'time [s]', 'Main.belt.position', 'motor', 'A402.12', 'Main.belt.position * 2']);
    expect(rows.length).toBe(400);
    expect(Number(rows[0]?.[0])).toBe(await trace.scanOf('A'));
    rows.forEach((row, at) => {
      expect(Number(row[0])).toBe(Number(rows[0]?.[0]) + at);
      expect(Number(row[5])).toBe(2 * Number(row[2]));
      expect(row[4]).toBe(at < 280 ? '0' : '1');
    });
  });

  await test.step('the trace is kept, and the next one is compared with it', async () => {
    await trace.choose('Export', 'Keep as a record…');
    await mika.page.getByRole('dialog').getByLabel('Name').fill('first jam');
    await mika.page.getByRole('dialog').getByRole('button', { name: 'Keep' }).click();
    await expect(mika.page.getByRole('dialog')).toBeHidden();
    await trace.show();
    await trace.choose('Compare with…', 'first jam');
    await expect(trace.pane.getByRole('button', { name: 'Compare with…' })).toContainText('With first jam, by trigger');
  });

  await test.step('a retrospective trace records any signals of the last 1,000 scans', async () => {
    await expect.poll(() => mika.top.scan(), 'there are 1,000 scans').toBeGreaterThan(1000);
    await trace.choose('Choose a trace', 'Record earlier scans…');
    const dialog = mika.page.getByRole('dialog');
    await dialog.getByLabel('Signals, one per line').fill('Main.uptime\nMain.belt.position\nlamp');
    await dialog.getByLabel(/Number of scans/).fill('1000');
    await dialog.getByRole('button', { name: 'Record' }).click();
    await expect(dialog).toBeHidden();
    await expect(trace.pane).toContainText(/recorded from the journal by Mika/, { timeout: 120_000 });
    await expect(trace.row('Main.uptime')).toBeVisible();
    const [head, ...rows] = await trace.csv();
    expect(head?.slice(2)).toEqual(['Main.uptime [s]', 'Main.belt.position', 'lamp']);
    expect(rows.length).toBe(1000);
    expect(rows.map((row) => Number(row[0]))).toEqual(rows.map((_, at) => Number(rows[0]?.[0]) + at));
    expect(Number(rows[10]?.[2]) - Number(rows[0]?.[2])).toBeCloseTo(0.1);
  });
});
