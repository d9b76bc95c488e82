import type { Server } from '../fixtures/server';
import { expect, test } from '../fixtures/test';
import { Verify } from '../pages/verify';

interface Told {
  ok: boolean;
  message: string;
  scan: number;
}

interface Verified {
  scan: number | null;
  differing: number;
}

/** Disturbs a scan, and returns its number. On a loaded machine a free-running verification may skip this scan: then it tries again. */
async function disturbUntilItDiffers(server: Server, disturbance: object): Promise<number> {
  const verified = async () => {
    const [found] = await server.get<Verified[]>(`/instances/${server.instance}/verifications`);
    return { scan: found?.scan ?? -1, differing: found?.differing ?? 0 };
  };
  for (;;) {
    const told = await server.post<Told>(`/instances/${server.instance}/disturbances`, disturbance);
    expect(told.ok, told.message).toBe(true);
    await expect.poll(async () => (await verified()).scan).toBeGreaterThan(told.scan);
    if ((await verified()).differing > 0) return told.scan;
  }
}

test('a range is verified, and a single flipped bit is found at its scan and variable', async ({ openAs, server }) => {
  const ada = await openAs('Ada');
  const verify = new Verify(ada.page);
  await ada.runs();
  await ada.watch.set('start', 'TRUE');

  await test.step('the selected lines of the editor are the range', async () => {
    await verify.show();
    await expect(verify.pane).toContainText('Is the result right?');
    await ada.explorer.tree.getByRole('treeitem', { name: 'Belt', exact: true }).dblclick();
    const editor = ada.editor('Belt.st');
    await editor.line('position := position + STEP;').click();
    await ada.page.keyboard.press('Home');
    for (let line = 0; line < 4; line += 1) await ada.page.keyboard.press('Shift+ArrowDown');
    await ada.page.keyboard.press('Control+Alt+v');
    await expect(verify.dialog.getByRole('radio', { name: 'Lines' })).toBeChecked();
    await expect(verify.dialog.getByLabel('File')).toHaveValue('Belt.st');
    await expect(verify.dialog.getByLabel('From line')).toHaveValue(/\d+/);
    await verify.dialog.getByLabel('From line').fill('14');
    await verify.dialog.getByLabel('To line').fill('20');
    await verify.dialog.getByRole('button', { name: 'Verify', exact: true }).click();
    await expect(verify.dialog).toBeHidden();
    await expect(verify.pane).toContainText('Belt, lines 14 to 20');
  });

  await test.step('without a disturbance nothing differs', async () => {
    await expect.poll(() => verify.count('compared'), { timeout: 60_000 }).toBeGreaterThan(50);
    await expect.poll(() => verify.count('differ')).toBe(0);
    await expect(verify.rows.first()).toBeVisible();
    await expect(verify.pane.getByRole('button', { name: 'First difference' })).toBeDisabled();
  });

  const jo = await openAs('Jo');
  const others = new Verify(jo.page);
  await jo.runs();
  await others.show();

  let scan = 0;
  await test.step('a bit is flipped: the difference is shown at its scan, with its variable, bit and disturbance', async () => {
    const flip = { kind: 'flip', path: 'Main.belt.position', bit: 9 };
    scan = await disturbUntilItDiffers(server, flip);
    await expect.poll(() => verify.count('differ')).toBe(1);
    await verify.maximise();
    await verify.press('First difference');
    await expect(verify.row(scan)).toHaveAttribute('aria-selected', 'true');
    await expect(verify.row(scan)).toHaveAttribute('data-differs', 'true');
    await expect(verify.row(scan).getByText('Memory Main.belt.position, bit 9')).toBeInViewport({ ratio: 0.5 });
    await expect(verify.facts).toContainText('Difference 1 of 1');
    await expect(verify.facts).toContainText('one bit differs');
    await expect(verify.facts).toContainText('the input is wrong, not the logic');
    await expect(verify.cell(scan, 'input:position').locator('svg')).toBeVisible();
    await expect(verify.source).toContainText('position := position + STEP;');
  });

  await test.step('a colleague sees the same, and can filter by differences', async () => {
    await expect.poll(() => others.count('differ')).toBe(1);
    await others.press('Only differences');
    await expect(others.rows).toHaveCount(1);
    await expect(others.row(scan)).toBeVisible();
    await others.press('Only differences');
  });

  await test.step('the columns are arranged by keyboard, and stay so', async () => {
    await verify.press('Columns');
    const columns = ada.page.getByRole('dialog', { name: 'Columns' });
    await columns.getByRole('listitem').filter({ hasText: 'barrier' }).getByRole('checkbox').uncheck();
    await columns.getByRole('combobox', { name: 'Format of position' }).first().selectOption('hex');
    await columns.getByRole('button', { name: 'Close' }).last().click();
    await expect(verify.table.getByRole('columnheader', { name: 'barrier' })).toHaveCount(0);
    await expect(verify.cell(scan, 'input:position')).toContainText('16#');
  });

  await test.step('the verification is exported, stopped and kept', async () => {
    await verify.press('Stop');
    await expect(verify.state).toHaveAttribute('data-state', 'stopped');
    expect(await verify.export('CSV table')).toContain(String(scan));
    expect(await verify.export('HTML report')).toContain('Main.belt.position');
    await verify.press('Export');
    await ada.page.getByRole('menuitem', { name: 'Keep as a record…' }).click();
    const dialog = ada.page.getByRole('dialog', { name: 'Keep the verification' });
    await dialog.getByLabel('Name').fill('flipped bit');
    await dialog.getByRole('button', { name: 'Keep' }).click();
    await expect(dialog).toBeHidden();
    const records = await server.get<{ name: string; by: string }[]>(
      `/projects/${server.project}/verification-records`,
    );
    expect(records.map(({ name, by }) => [name, by])).toEqual([['flipped bit', 'Ada']]);
  });

  await test.step('verifying the same past scans afterwards gives the same result', async () => {
    await verify.press('Choose a verification');
    await ada.page.getByRole('menuitem', { name: 'Verify this range again…' }).click();
    await verify.dialog.getByRole('radio', { name: 'Past scans' }).click();
    await verify.dialog.getByLabel('First scan').fill(String(scan - 20));
    await verify.dialog.getByLabel('Last scan').fill(String(scan + 20));
    await verify.dialog.getByRole('button', { name: 'Verify', exact: true }).click();
    await expect(verify.state).toHaveAttribute('data-state', 'done', { timeout: 60_000 });
    await expect.poll(() => verify.count('compared')).toBe(41);
    await expect.poll(() => verify.count('skipped')).toBe(0);
    await expect.poll(() => verify.count('differ')).toBe(1);
    await verify.press('First difference');
    await expect(verify.row(scan)).toHaveAttribute('data-differs', 'true');
  });
});

test('set data shows whether the input or the logic caused a wrong result', { tag: '@nightly' }, async ({
  openAs,
  server,
}) => {
  const ada = await openAs('Ada');
  const verify = new Verify(ada.page);
  await ada.runs();
  await ada.watch.set('start', 'TRUE');
  await verify.show();

  let scan = 0;
  await test.step('an instruction gives a wrong result', async () => {
    await ada.explorer.tree.getByRole('treeitem', { name: 'Belt', exact: true }).click({ button: 'right' });
    await ada.page.getByRole('menuitem', { name: 'Verify Belt…' }).click();
    await expect(verify.dialog.getByLabel('POU')).toHaveValue('Belt');
    await verify.dialog.getByRole('button', { name: 'Verify', exact: true }).click();
    await expect(verify.dialog).toBeHidden();
    await verify.maximise();
    await expect.poll(() => verify.count('compared'), { timeout: 60_000 }).toBeGreaterThan(10);
    const disturbed = await disturbUntilItDiffers(server, { kind: 'result', site: 'Belt.st:20', bit: 0 });
    await expect.poll(() => verify.count('differ')).toBeGreaterThan(0);
    await verify.press('Stop');
    await verify.press('First difference');
    scan = Number(await verify.table.locator('[aria-selected="true"]').getAttribute('data-scan'));
    expect(scan).toBeGreaterThanOrEqual(disturbed);
    await expect(verify.facts).toContainText('The same inputs gave a different result');
    await expect(verify.cell(scan, 'output:barrier:A').locator('svg')).toBeVisible();
    await expect(verify.source.locator('.diffln')).toContainText('barrier := position < 50;');
  });

  const a = await verify.cell(scan, 'output:barrier:A').innerText();
  const monitor = await verify.cell(scan, "output:barrier:A'").innerText();
  expect(a).not.toBe(monitor);

  await test.step('an invalid value is refused in its row, and stays as typed', async () => {
    await verify.press('Try different inputs');
    const box = verify.table.getByRole('textbox');
    await expect(box).toBeFocused();
    await box.press('Escape');
    await verify.set(scan, 'input:position', 'fast');
    await expect(verify.table.getByRole('alert')).toContainText('not INT');
    await expect(box).toHaveValue('fast');
    await box.press('Escape');
    await expect(box).toBeHidden();
  });

  await test.step('with different inputs the reference also gives A; A itself never changes', async () => {
    await verify.set(scan, 'input:position', a.includes('TRUE') ? '10' : '300');
    await expect(verify.cell(scan, "output:barrier:A'")).toHaveText(a);
    await expect(verify.cell(scan, 'output:barrier:A')).toHaveText(a);
    await expect(verify.cell(scan, 'from')).toHaveText('Set');
    await expect(verify.facts).toContainText('With the edited inputs the reference gives the result of A.');
  });

  await test.step('on the recorded inputs the result is the old one', async () => {
    await verify.choose('Monitor runs on', 'Recorded');
    await expect(verify.cell(scan, "output:barrier:A'")).toHaveText(monitor);
    await expect(verify.cell(scan, 'output:barrier:A')).toHaveText(a);
    await expect(verify.cell(scan, 'from')).toHaveText('Recorded');
  });

  await test.step('the record of used variables lists every read and write', async () => {
    await verify.press('Used variables');
    await expect(verify.facts.getByRole('row').filter({ hasText: 'barrier' })).toContainText('written');
  });

  await test.step('from there the user goes to the scan', async () => {
    await verify.press('Go to this scan');
    await expect(ada.timeline.banner).toBeVisible();
  });
});
