/** The debug adapter on stdio, with the client that VS Code's own adapters are tested with: one for each test. */
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { afterEach, beforeEach } from 'node:test';
import { DebugClient } from '@vscode/debugadapter-testsupport';
import { COMMAND, HERE } from './command.mjs';

export { HERE };
export const PROGRAM = join(HERE, 'counter.st');
export const COUNTS = { path: PROGRAM, line: 8 };
export const FIRST = { path: PROGRAM, line: 18 };
export const LAST = { path: PROGRAM, line: 21 };
const PATIENCE_MS = 60_000;

/** The client of the running test. */
export let client;

beforeEach(async () => {
  client = new DebugClient(COMMAND, 'dap', 'scanbench');
  client.defaultTimeout = PATIENCE_MS;
  await client.start();
});

afterEach(() => client.stop());

/** Launches and waits for the halt at the first statement. */
export async function entered(args = {}) {
  const halted = client.assertStoppedLocation('entry', FIRST);
  await Promise.all([
    client.configurationSequence(),
    client.launch({ program: PROGRAM, stopOnEntry: true, pace: 0, ...args }),
    halted,
  ]);
}

/** Does something, and waits for the halt that it causes. */
export async function haltAfter(request, reason, place) {
  const [stack] = await Promise.all([client.assertStoppedLocation(reason, place), request()]);
  return stack.body.stackFrames;
}

export async function value(expression, frameId) {
  return (await client.evaluateRequest({ expression, frameId, context: 'watch' })).body.result;
}

export async function breakAt(place, options = {}) {
  const answer = await client.setBreakpointsRequest({
    source: { path: place.path },
    breakpoints: [{ line: place.line, ...options }],
  });
  assert.equal(answer.body.breakpoints[0].verified, true, answer.body.breakpoints[0].message);
  return answer.body.breakpoints[0];
}
