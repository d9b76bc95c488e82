import { expect, test } from '../fixtures/test';
import { TraceImport } from '../pages/traceimport';
import { Verify } from '../pages/verify';

const SCANS = 20;
const WRONG = 12;

/** Nobody presses start, so the conveyor does not move. In one scan the controller counts parts that do not exist. */
function recorded({ head = 'scan,start,motor,partsTotal', wrong = true } = {}): string {
  const rows = Array.from({ length: SCANS }, (_, scan) => `${scan},FALSE,FALSE,${wrong && scan === WRONG ? 7 : 0}`);
  return `${head}\n${rows.join('\n')}\n`;
}

/** The same as TwinCAT Scope exports it: a block of properties, tabs, a decimal comma, uneven times. */
function scope(): string {
  const names = ['GVL.start', 'GVL.motor', 'MAIN.fbBelt.nPosition'];
  const rows = Array.from({ length: SCANS }, (_, scan) => [`${10 * scan + (scan % 3)},5`, '0', '0', '0']);
  const head = [
    ['Name', 'Line'],
    ['File', 'scope.csv'],
    ['Name', 'start', 'motor', 'nPosition'],
    ['Data-Type', 'BIT', 'BIT', 'INT16'],
    ['SampleTime[ms]', '10', '10', '10'],
    ['SymbolName', ...names],
  ];
  return [...head, ...rows].map((row) => row.join('\t')).join('\r\n');
}

test('a controller log is mapped, verified and kept', { tag: '@nightly' }, async ({ openAs }) => {
  const mika = await openAs('Mika');
  const trace = new TraceImport(mika.page);
  const verify = new Verify(mika.page);
  await mika.runs();
  await trace.open();
  await expect(trace.start).toBeDisabled();

  await test.step('a broken file is refused with its row, and nothing is imported', async () => {
    await trace.choose('broken.csv', 'scan,start\n0,1\n1,1,1,1\n');
    await expect(trace.dialog).toContainText('broken.csv could not be read. Nothing was imported.');
    await expect(trace.problem('row 3')).toBeVisible();
    await expect(trace.start).toBeDisabled();
  });

  await test.step('a file of TwinCAT Scope is recognised, its columns are mapped, an output gets a tolerance', async () => {
    await trace.choose('scope.csv', scope());
    await expect(trace.dialog).toContainText('TwinCAT Scope');
    await expect(trace.variable('MAIN.fbBelt.nPosition')).toHaveValue('Main.belt.position');
    await expect(trace.column('GVL.motor')).toContainText('Proposed 93 %');
    await trace.dialog.getByRole('button', { name: 'Tolerance of GVL.motor' }).click();
    const within = mika.page.getByRole('dialog', { name: 'Tolerance of GVL.motor' });
    await within.getByRole('textbox', { name: 'Earlier or later, in milliseconds' }).fill('20');
    await within.getByRole('button', { name: 'Set' }).click();
    await expect(trace.column('GVL.motor')).toContainText('20 ms');
    await expect(trace.verdict).toContainText(`Scans 1 to ${SCANS} can be verified.`);
  });

  await test.step('unknown columns, gaps and invalid cells are reported with row and column', async () => {
    await trace.choose('line.csv', 'scan,start,motor,sped\n0,FALSE,FALSE,1\n1,maybe,FALSE,2\n5,FALSE,FALSE,3\n');
    await expect(trace.column('start')).toContainText('Proposed');
    await expect(trace.problem('sped')).toContainText('column sped');
    await expect(trace.problem('maybe')).toContainText('row 3, column start');
    await expect(trace.problem('missing')).toContainText('row 4');
    await expect(trace.verdict).toContainText('It cannot be verified yet: 3 problems.');
    await expect(trace.start).toBeDisabled();
  });

  await test.step('the mapping is corrected by hand and by completion', async () => {
    await trace.role('sped').selectOption('an input');
    await trace.variable('sped').fill('Main.belt.pos');
    await mika.page.getByRole('option', { name: 'Main.belt.position' }).click();
    await expect(trace.variable('sped')).toHaveValue('Main.belt.position');
    await trace.role('sped').selectOption('not used');
    await trace.dialog.getByLabel('Missing scans').selectOption('are not compared');
    await expect(trace.verdict).toContainText('It cannot be verified yet: 1 problem.');
  });

  await test.step('the corrected file keeps the manual mapping', async () => {
    await trace.choose('line.csv', recorded({ head: 'scan,sped,motor,partsTotal' }));
    await expect(trace.role('sped')).toHaveValue('ignore');
    await expect(trace.variable('sped')).toHaveValue('Main.belt.position');
    await expect(trace.dialog.getByLabel('Missing scans')).toHaveValue('skip');
    await trace.role('sped').selectOption('an input');
    await trace.variable('sped').fill('start');
    await expect(trace.verdict).toContainText(`Scans 0 to ${SCANS - 1} can be verified.`);
  });

  await test.step('a mapping is saved, and loaded again', async () => {
    await trace.saveAs('Line 1');
    await expect(trace.verdict).toContainText('Saved as “Line 1”.');
    await trace.variable('sped').fill('lamp');
    await trace.load('Line 1');
    await expect(trace.variable('sped')).toHaveValue('start');
    await expect(trace.verdict).toContainText('can be verified');
  });

  await test.step('closed and opened again, the dialog is as it was left', async () => {
    await trace.dialog.getByRole('button', { name: 'Cancel' }).click();
    await expect(trace.dialog).toBeHidden();
    await trace.open();
    await expect(trace.variable('sped')).toHaveValue('start');
  });

  await test.step('the wrong cell is found at its scan and variable', async () => {
    await trace.start.click();
    await expect(trace.dialog).toBeHidden({ timeout: 60_000 });
    await expect(verify.state).toContainText('Done', { timeout: 60_000 });
    await expect.poll(() => verify.count('compared')).toBe(SCANS);
    await verify.press('First difference');
    await expect(verify.row(WRONG)).toHaveAttribute('aria-selected', 'true');
    await expect(verify.facts).toContainText(`partsTotal, scan ${WRONG}`);
    await expect(verify.facts).toContainText('line.csv');
  });

  await test.step('it says what was compared, and what was not', async () => {
    await verify.press('What was compared');
    const said = mika.page.getByRole('dialog', { name: 'What was compared' });
    await expect(said.getByRole('row', { name: /^partsTotal 20 1 / })).toBeVisible();
    await expect(said).toContainText('Main.station.run');
    await said.getByRole('button', { name: 'Close' }).last().click();
  });

  await test.step('the verification is kept; a colleague opens, exports and deletes it', async () => {
    await verify.press('Export');
    await mika.page.getByRole('menuitem', { name: /^Keep as a record/ }).click();
    const keeping = mika.page.getByRole('dialog', { name: 'Keep the verification' });
    await keeping.getByRole('textbox', { name: 'Name' }).fill('Acceptance');
    await keeping.getByRole('button', { name: 'Keep', exact: true }).click();
    await expect(keeping).toBeHidden();

    const jo = await openAs('Jo');
    await jo.runs();
    const records = new TraceImport(jo.page);
    await records.openRecords();
    await expect(records.record('Acceptance')).toContainText('line.csv, version 1');
    await expect(records.record('Acceptance')).toContainText('Mika');
    await records.record('Acceptance').getByRole('button', { name: 'Export Acceptance' }).click();
    const [download] = await Promise.all([
      jo.page.waitForEvent('download'),
      jo.page.getByRole('menuitem', { name: 'CSV' }).click(),
    ]);
    expect(download.suggestedFilename()).toBe('Acceptance.csv');
    await records.record('Acceptance').getByRole('button', { name: 'Open Acceptance' }).click();
    const shown = new Verify(jo.page);
    await expect(shown.pane).toContainText('Acceptance');
    await expect(shown.row(WRONG)).toBeVisible();

    await records.openRecords();
    await records.record('Acceptance').getByRole('button', { name: 'Delete Acceptance' }).click();
    await jo.page
      .getByRole('dialog', { name: 'Delete this verification?' })
      .getByRole('button', { name: 'Delete' })
      .click();
    await expect(records.records).toContainText('No saved verifications yet');
  });
});
