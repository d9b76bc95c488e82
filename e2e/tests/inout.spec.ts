import { expect, test } from '../fixtures/test';

test('a write to an in-out goes to the variable that was passed, or to that of a different call', {
  tag: '@nightly',
}, async ({ openAs }) => {
  const mika = await openAs('Mika');
  const jo = await openAs('Jo');
  await mika.runs();
  const level = 'Main.buffer.level';

  await test.step('the row shows its binding, the call and the scan', async () => {
    await mika.watch.add(level);
    await expect(mika.watch.row(level)).toContainText('bufferLevel (D110)');
    await expect(mika.watch.binding(level)).toContainText(/By reference.*Main\.st:30.*bound in scan/);
  });

  await test.step('a value written there reaches the variable, and a colleague sees it with its author', async () => {
    await jo.watch.add('bufferLevel');
    await mika.watch.set(level, '1000');
    for (const [ide, path] of [
      [mika, level],
      [jo, 'bufferLevel'],
    ] as const)
      await expect.poll(() => ide.watch.number(path)).toBeGreaterThan(900);
    await expect(jo.watch.writtenBy('bufferLevel', 'Mika')).toBeVisible();
  });

  await test.step('a value that does not fit is refused, with the variable, its type and its range', async () => {
    await mika.watch.write(level, '40000');
    await expect(mika.watch.refusal).toContainText('Main.buffer.level -> bufferLevel (D110): 40000 is outside of INT');
    await mika.watch.entry(level).press('Escape');
  });

  await test.step('a force holds the variable; both rows are marked, and each can release it', async () => {
    await mika.watch.entry(level).fill('77');
    await mika.watch.entry(level).press('F7');
    await jo.watch.shows('bufferLevel', '77');
    await expect(mika.watch.releaseOf(level)).toBeVisible();
    await jo.watch.releaseOf('bufferLevel').click();
    await expect(mika.watch.releaseOf(level)).toBeHidden();
  });

  await test.step('a second call of the same instance: the last one counts', async () => {
    const main = mika.editor('Main.st');
    await main.addBelow('uptime    : TIME;', '  spare : INT := 500;');
    await main.addBelow('buffer(level := bufferLevel', '  buffer(level := spare, fill := FALSE, drain := FALSE);');
    await main.build();
    await expect(mika.watch.row(level)).toContainText('Main.spare');
    await expect(mika.watch.binding(level)).toContainText('last of 2 calls');
    await mika.watch.set(level, '300');
    await mika.watch.add('Main.spare');
    await mika.watch.shows('Main.spare', '300');
  });

  await test.step('the other call is chosen, and writes go to its variable', async () => {
    await mika.watch.pickCall(level, /bufferLevel/);
    await expect(mika.watch.binding(level)).toContainText('chosen from 2 calls');
    await mika.watch.set(level, '2000');
    await expect.poll(() => jo.watch.number('bufferLevel')).toBeGreaterThan(1900);
    await mika.watch.shows('Main.spare', '300');
  });
});
