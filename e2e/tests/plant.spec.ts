import { expect, test } from '../fixtures/test';

const INPUTS = 'time; CIO0\n0; 0\n200; 7\n';

test('a plant is created in the browser, and drives the inputs', { tag: '@nightly' }, async ({ openAs }) => {
  const jo = await openAs('Jo');
  await jo.runs();
  const main = jo.editor('Main.st');

  await test.step('an added table goes to the plant by itself, and opens as text', async () => {
    await jo.explorer.addFiles({ name: 'inputs.csv', text: INPUTS });
    await expect(jo.explorer.item('Plant')).toBeVisible();
    await expect(jo.explorer.item('inputs.csv')).toBeVisible();
    await expect(jo.editor('plant/inputs.csv').line('200; 7')).toBeVisible();
  });

  await test.step('after a build its input changes', async () => {
    await main.open();
    await main.build();
    await expect(main.outcome).toContainText('Built for line-1');
    await jo.watch.add('CIO0');
    await jo.watch.shows('CIO0', '16#0007');
  });

  await test.step('a new file with the folder plant/ is a program of the plant', async () => {
    await jo.explorer.newFile('plant/tank.st');
    await expect(jo.explorer.item('tank.st')).toBeVisible();
    const tank = jo.editor('plant/tank.st');
    await tank.replaceWith('PROGRAM Tank\nVAR level : INT; END_VAR\nlevel := level + 1;\nEND_PROGRAM\n');
    await tank.build();
    await expect(tank.outcome).toContainText('Built for line-1');
    await jo.watch.add('Tank.level');
    await expect.poll(() => jo.watch.number('Tank.level')).toBeGreaterThan(0);
  });
});
