import { drawing } from '../fixtures/drawing';
import { expect, test } from '../fixtures/test';
import { Debug } from '../pages/debug';
import { Verify } from '../pages/verify';

const GATE = `FUNCTION_BLOCK Gate
VAR_INPUT go, stop : BOOL; END_VAR
VAR_OUTPUT run, slow, late : BOOL; END_VAR
VAR pulse : BOOL; jam : TON; END_VAR
RUNG "Somebody wants it"
    [go] (pulse)
END_RUNG
RUNG "The motor holds itself"
    < [pulse] | [run] > [/stop] (run) (R pulse)
END_RUNG
RUNG "A part is stuck"
    [run] jam(IN := ~, PT := T#1h).Q (slow)
END_RUNG
RUNG "The pulse is over by now"
    [pulse] (late)
END_RUNG
END_FUNCTION_BLOCK
`;

test('power is drawn as the code saw it: live, halted before a block, one scan back, different in a verification', {
  tag: '@nightly',
}, async ({ openAs, server }) => {
  const mika = await openAs('Mika');
  const { page } = mika;
  const { keyboard } = page;
  const sheet = await drawing(mika, server, {
    block: 'Gate',
    text: GATE,
    variables: 'first, second : Gate;',
    calls: 'first(go := start);\nsecond(go := FALSE);',
  });
  const rung = (title: string) => sheet.getByRole('group', { name: new RegExp(title) });
  await expect(sheet).toContainText('The motor holds itself');
  // The block was not built: there is no instance whose power could be drawn.
  await expect(page.getByText('No instance', { exact: true })).toBeVisible();

  await test.step('live: a contact has the power that it had, not the value that is there after the scan', async () => {
    await mika.editor('Gate.st').build();
    await mika.watch.set('start', 'TRUE');
    await expect(page.getByText(/^As the code saw it in scan \d/)).toBeVisible();
    const holds = rung('The motor holds itself');
    await expect(holds.locator('.el.on').and(page.getByRole('option', { name: 'Contact pulse' }))).toBeVisible();
    await expect(rung('The pulse is over').locator('.el.on')).toHaveCount(0);
  });

  let halted = 0;
  await test.step('halted before the block: what comes later is as of the last scan', async () => {
    const box = rung('A part is stuck').getByRole('option', { name: 'Box jam' });
    await box.click();
    await keyboard.press('F9');
    await expect(rung('A part is stuck').getByText('next element')).toBeVisible();
    await expect(rung('The pulse is over').getByText('as of the last scan')).toBeVisible();
    await expect(rung('A part is stuck').locator('.el.on')).toHaveCount(1);
    await expect(rung('The motor holds itself').getByText('now FALSE')).toBeVisible();
    await rung('The motor holds itself').getByRole('option', { name: 'Contact pulse' }).click();
    await expect(page.getByText('pulse: seen here TRUE, now FALSE')).toBeVisible();
    halted = await mika.top.scan();
  });

  await test.step('a contact is forced: the step to the coil and the next scan see it', async () => {
    const debug = new Debug(page);
    await mika.watch.add('Main.first.stop');
    await mika.watch.fromMenu('Main.first.stop', 'Force to TRUE');
    await debug.step('Step over');
    await expect(sheet.getByRole('option', { name: 'Coil slow, next element' })).toBeVisible();
    await debug.removeAll();
    await page.keyboard.press('F5');
    await expect(mika.top.state).toContainText('Running');
    await expect(rung('The motor holds itself').locator('.el.on')).toHaveCount(2);
    await expect(rung('The motor holds itself').locator('.el.forced')).toHaveCount(1);
  });

  await test.step('one scan back it is what the code saw then', async () => {
    await mika.timeline.goTo(halted);
    await expect(page.getByText(`As the code saw it in scan ${(halted - 1).toLocaleString('en')}`)).toBeVisible();
    await expect(rung('A part is stuck').locator('.el.on')).toHaveCount(1);
    await mika.timeline.goTo(halted - 1);
    await expect(page.getByText(`As the code saw it in scan ${(halted - 2).toLocaleString('en')}`)).toBeVisible();
  });

  await test.step('a difference that was planted at a coil is marked there, and what follows from it on both sides', async () => {
    await mika.timeline.returnToLive();
    const verify = new Verify(page);
    await verify.show();
    await server.post(`/instances/${server.instance}/verifications`, {
      range: { pou: 'Gate', instance: 'Main.first' },
    });
    await expect.poll(() => verify.count('compared'), { timeout: 60_000 }).toBeGreaterThan(5);
    const line = GATE.split('\n').findIndex((each) => each.includes('(run)')) + 1;
    await server.post(`/instances/${server.instance}/disturbances`, {
      kind: 'result',
      path: 'Main.first.run',
      site: `Gate.st:${line}`,
      bit: 0,
      probability: 1,
    });
    await expect.poll(() => verify.count('differ'), { timeout: 60_000 }).toBeGreaterThan(0);
    await verify.press('First difference');
    const [holds, stuck] = [rung('The motor holds itself'), rung('A part is stuck')];
    await expect(holds.getByText(/1 different, scan \d/)).toBeVisible();
    await expect(holds.locator('.elemdiff.first')).toHaveText('First difference A TRUE  A′ FALSE');
    // The contact that reads it, the input of the timer, and the wire between them.
    await expect(stuck.locator('.elemdiff:not(.onwire)')).toHaveText(['A TRUE  A′ FALSE', 'A TRUE  A′ FALSE']);
    await expect(stuck.locator('.elemdiff.onwire')).toHaveText('A 1  A′ 0');
    await expect(stuck.locator('.wire[data-apart="A"]').first()).toBeAttached();
    await expect(page.locator('.elemdiff.first')).toHaveCount(1);
    await expect(rung('Somebody wants it').locator('.elemdiff')).toHaveCount(0);
  });
});
