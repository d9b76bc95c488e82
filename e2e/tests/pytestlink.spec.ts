import { spawn } from 'node:child_process';
import { mkdtemp, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { expect, test } from '../fixtures/test';

const PROGRAM = `VAR_GLOBAL start : BOOL; motor : BOOL; END_VAR
PROGRAM Main
VAR n : INT; END_VAR
n := n + 1;
motor := start AND n < 12;
END_PROGRAM
`;
const TEST = `def test_the_motor_goes_on(plc):
    plc.write("start", True)
    plc.run()
    plc.always(50, "motor")
`;

test('a test that fails leaves a link, which opens the browser at the scan of the failure', {
  tag: '@nightly',
}, async ({ openAs, server }) => {
  const folder = await mkdtemp(join(tmpdir(), 'scanbench-'));
  await writeFile(join(folder, 'main.st'), PROGRAM);
  await writeFile(join(folder, 'test_motor.py'), TEST);
  const pytest = resolve('..', '.venv', 'bin', 'pytest');
  const child = spawn(pytest, ['test_motor.py'], {
    cwd: folder,
    env: { ...process.env, SCANBENCH_SERVER: server.address },
  });
  let said = '';
  for (const stream of [child.stdout, child.stderr]) stream.on('data', (data) => (said += data));
  await new Promise((ended) => child.on('close', ended));
  await rm(folder, { recursive: true });

  expect(said).toContain('`motor` did not hold any more after scan 11, the 11. of 50. Now motor = FALSE');
  const link = /http:\S+/.exec(said)?.[0] ?? said;
  const jo = await openAs('Jo', `${new URL(link).pathname}`);
  await expect(jo.page.getByText('test_the_motor_goes_on').first()).toBeVisible();
  await expect(jo.page).toHaveURL(/scan/);
  await expect(jo.top.state).toHaveAttribute('title', /^scan 11 of 12/);
});
