/** Launching, stepping and ending; impossible requests. */
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';
import { COUNTS, client, entered, FIRST, HERE, haltAfter, LAST, PROGRAM, value } from './session.mjs';

test('unknown requests are refused, and the adapter goes on', async () => {
  await assert.rejects(client.send('illegal_request'), /illegal_request/);
  const answer = await client.initializeRequest();
  assert.equal(answer.body.supportsStepBack, true);
  assert.equal(answer.body.supportsConfigurationDoneRequest, true);
});

test('a path format other than path is refused', async () => {
  await assert.rejects(
    client.initializeRequest({ adapterID: 'scanbench', linesStartAt1: true, columnsStartAt1: true, pathFormat: 'url' }),
    /pathFormat/,
  );
});

test('a program with errors is not launched, and the message has the place', async () => {
  const broken = join(HERE, 'broken.st');
  const said = client.waitForEvent('output');
  await assert.rejects(client.launch({ program: broken }), /1 error, nothing was started: .*broken\.st:5:6/);
  const { body } = await said;
  assert.equal(body.source.path, broken);
  assert.equal(body.line, 5);
});

test('a program that does not exist is refused', async () => {
  await assert.rejects(client.launch({ program: join(HERE, 'nowhere.st') }), /nowhere\.st does not exist/);
});

test('stopOnEntry halts at the first statement', () => entered());

test('steps: in, over, out, and back again', async () => {
  await entered();
  await haltAfter(() => client.nextRequest({ threadId: 1 }), 'step', { path: PROGRAM, line: 19 });
  await haltAfter(() => client.stepInRequest({ threadId: 1 }), 'step', COUNTS);
  await haltAfter(() => client.stepOutRequest({ threadId: 1 }), 'step', { path: PROGRAM, line: 20 });
  assert.equal(await value('Main.n'), '1');
  await haltAfter(() => client.stepBackRequest({ threadId: 1 }), 'step', COUNTS);
  await haltAfter(() => client.stepBackRequest({ threadId: 1 }), 'step', { path: PROGRAM, line: 19 });
  await haltAfter(() => client.stepBackRequest({ threadId: 1 }), 'step', FIRST);
  assert.equal(await value('Main.n'), '0');
});

test('pause halts a program that runs', async () => {
  await Promise.all([client.configurationSequence(), client.launch({ program: PROGRAM })]);
  const [event] = await Promise.all([client.waitForEvent('stopped'), client.pauseRequest({ threadId: 1 })]);
  assert.equal(event.body.reason, 'pause');
  assert.equal(event.body.allThreadsStopped, true);
});

test('our own requests: force, single scan, run to a line', async () => {
  await entered();
  await client.customRequest('scanbench/force', { path: 'Main.n', value: '100' });
  await haltAfter(() => client.customRequest('scanbench/singleScan', {}), 'step', FIRST);
  const place = { source: { path: PROGRAM }, line: 21 };
  await haltAfter(() => client.customRequest('scanbench/runTo', place), 'goto', LAST);
  assert.equal(await value('Main.n'), '101'); // forced before the program, which then counts from there
  await client.customRequest('scanbench/release', {});
});

test('terminate ends the program', async () => {
  await entered();
  const ended = client.waitForEvent('terminated');
  await client.terminateRequest({});
  await ended;
});
