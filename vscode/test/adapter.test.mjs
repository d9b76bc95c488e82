/** The debug adapter on stdio, spoken to by the client with which VS Code's own adapters are tested. */
import assert from 'node:assert/strict';
import { dirname, join, resolve } from 'node:path';
import { afterEach, beforeEach, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { DebugClient } from '@vscode/debugadapter-testsupport';

const HERE = dirname(fileURLToPath(import.meta.url));
const COMMAND = process.env.SCANBENCH ?? resolve(HERE, '../../.venv/bin/scanbench');
const PROGRAM = join(HERE, 'counter.st');
const COUNTS = { path: PROGRAM, line: 8 };
const FIRST = { path: PROGRAM, line: 18 };
const LAST = { path: PROGRAM, line: 21 };
const PATIENCE_MS = 60_000;

let client;

beforeEach(async () => {
  client = new DebugClient(COMMAND, 'dap', 'scanbench');
  client.defaultTimeout = PATIENCE_MS;
  await client.start();
});

afterEach(() => client.stop());

/** Launches and waits for the halt at the first statement. */
async function entered(args = {}) {
  const halted = client.assertStoppedLocation('entry', FIRST);
  await Promise.all([
    client.configurationSequence(),
    client.launch({ program: PROGRAM, stopOnEntry: true, pace: 0, ...args }),
    halted,
  ]);
}

/** Does something, and waits for the halt that comes of it. */
async function haltAfter(request, reason, place) {
  const [stack] = await Promise.all([client.assertStoppedLocation(reason, place), request()]);
  return stack.body.stackFrames;
}

async function value(expression, frameId) {
  return (await client.evaluateRequest({ expression, frameId, context: 'watch' })).body.result;
}

async function breakAt(place, options = {}) {
  const answer = await client.setBreakpointsRequest({
    source: { path: place.path },
    breakpoints: [{ line: place.line, ...options }],
  });
  assert.equal(answer.body.breakpoints[0].verified, true, answer.body.breakpoints[0].message);
  return answer.body.breakpoints[0];
}

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

test('a program with errors is not launched, and the message says where', async () => {
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

test('a breakpoint is verified and hit', () =>
  client.hitBreakpoint({ program: PROGRAM, pace: 0 }, { path: PROGRAM, line: 8 }));

test('a breakpoint in a line without a statement moves to the next one', () =>
  client.hitBreakpoint({ program: PROGRAM }, { path: PROGRAM, line: 11 }, FIRST, FIRST));

test('stack, scopes and variables of a halt; a value is set and counts', async () => {
  await client.hitBreakpoint({ program: PROGRAM, pace: 0 }, COUNTS);
  const { body } = await client.stackTraceRequest({ threadId: 1 });
  assert.equal(body.totalFrames, 2);
  assert.deepEqual(
    body.stackFrames.map((frame) => frame.line),
    [8, 19],
  );
  assert.match(body.stackFrames[0].name, /Main\.a/);
  const [inner, outer] = body.stackFrames;
  const { scopes } = (await client.scopesRequest({ frameId: inner.id })).body;
  const outputs = scopes.find((scope) => scope.name === 'VAR_OUTPUT');
  const { variables } = (await client.variablesRequest(outputs)).body;
  assert.deepEqual(
    variables.map((variable) => [variable.name, variable.value]),
    [['total', '0']],
  );
  const set = await client.setVariableRequest({
    variablesReference: outputs.variablesReference,
    name: 'total',
    value: '41',
  });
  assert.equal(set.body.value, '41');
  await haltAfter(() => client.stepOutRequest({ threadId: 1 }), 'step', { path: PROGRAM, line: 20 });
  assert.equal(await value('Main.a.total'), '42');
  await assert.rejects(client.scopesRequest({ frameId: outer.id }), /earlier halt/);
});

test('arrays are paged', async () => {
  await entered();
  const { body } = await client.evaluateRequest({ expression: 'Main.items', context: 'watch' });
  assert.equal(body.indexedVariables, 3);
  const page = await client.variablesRequest({
    variablesReference: body.variablesReference,
    filter: 'indexed',
    start: 1,
    count: 1,
  });
  assert.deepEqual(
    page.body.variables.map((variable) => variable.value),
    ['20'],
  );
});

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

test('a conditional breakpoint halts when its condition holds; reverse continue comes back to it', async () => {
  await entered();
  await breakAt(LAST, { condition: 'n = 5' });
  const frames = await haltAfter(() => client.continueRequest({ threadId: 1 }), 'breakpoint', LAST);
  assert.equal(await value('n', frames[0].id), '5');
  await haltAfter(() => client.nextRequest({ threadId: 1 }), 'step', FIRST);
  const back = await haltAfter(() => client.reverseContinueRequest({ threadId: 1 }), 'breakpoint', LAST);
  assert.equal(await value('n', back[0].id), '5');
});

test('a condition that is wrong is not verified, and says why', async () => {
  await entered();
  const answer = await client.setBreakpointsRequest({
    source: { path: PROGRAM },
    breakpoints: [{ line: 21, condition: 'm = 5' }],
  });
  assert.equal(answer.body.breakpoints[0].verified, false);
  assert.match(answer.body.breakpoints[0].message, /m/);
});

test('a hit count', async () => {
  await entered();
  await breakAt(LAST, { hitCondition: '>= 4' });
  const frames = await haltAfter(() => client.continueRequest({ threadId: 1 }), 'breakpoint', LAST);
  assert.equal(await value('n', frames[0].id), '4');
});

test('a logpoint speaks and does not halt', async () => {
  await entered();
  await client.setBreakpointsRequest({
    source: { path: PROGRAM },
    breakpoints: [
      { line: 20, logMessage: 'n is {n}' },
      { line: 21, condition: 'n = 3' },
    ],
  });
  const said = client.assertOutput('console', 'n is 1\nn is 2\nn is 3\n');
  await haltAfter(() => client.continueRequest({ threadId: 1 }), 'breakpoint', LAST);
  await said;
});

test('a function breakpoint halts at the first statement of the POU', async () => {
  await entered();
  const answer = await client.setFunctionBreakpointsRequest({ breakpoints: [{ name: 'Counter' }, { name: 'Nobody' }] });
  assert.equal(answer.body.breakpoints[0].verified, true);
  assert.equal(answer.body.breakpoints[1].verified, false);
  await haltAfter(() => client.continueRequest({ threadId: 1 }), 'function breakpoint', COUNTS);
});

test('a data breakpoint halts behind the write', async () => {
  await entered();
  const info = await client.dataBreakpointInfoRequest({ name: 'Main.b.total' });
  assert.equal(info.body.dataId, 'Main.b.total');
  await client.setDataBreakpointsRequest({ breakpoints: [{ dataId: info.body.dataId, accessType: 'write' }] });
  await haltAfter(() => client.continueRequest({ threadId: 1 }), 'data breakpoint', LAST);
  assert.equal(await value('Main.b.total'), '2');
});

test('pause halts a program that runs', async () => {
  await Promise.all([client.configurationSequence(), client.launch({ program: PROGRAM })]);
  const [event] = await Promise.all([client.waitForEvent('stopped'), client.pauseRequest({ threadId: 1 })]);
  assert.equal(event.body.reason, 'pause');
  assert.equal(event.body.allThreadsStopped, true);
});

test('restart begins at scan 0, with its breakpoints', async () => {
  await entered();
  await breakAt(LAST, { condition: 'n = 2' });
  await haltAfter(() => client.continueRequest({ threadId: 1 }), 'breakpoint', LAST);
  await haltAfter(() => client.restartRequest({}), 'entry', FIRST);
  assert.equal(await value('Main.n'), '0');
  await haltAfter(() => client.continueRequest({ threadId: 1 }), 'breakpoint', LAST);
  assert.equal(await value('Main.n'), '2');
});

test('our own requests: force, single scan, run to a line', async () => {
  await entered();
  await client.customRequest('scanbench/force', { path: 'Main.n', value: '100' });
  await haltAfter(() => client.customRequest('scanbench/singleScan', {}), 'step', FIRST);
  const place = { source: { path: PROGRAM }, line: 21 };
  await haltAfter(() => client.customRequest('scanbench/runTo', place), 'goto', LAST);
  assert.equal(await value('Main.n'), '101'); // forced in front of the program, which counts on
  await client.customRequest('scanbench/release', {});
});

test('terminate ends the program', async () => {
  await entered();
  const ended = client.waitForEvent('terminated');
  await client.terminateRequest({});
  await ended;
});
