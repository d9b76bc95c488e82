/** Where a program halts, and which values can be read and set there. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { breakAt, COUNTS, client, entered, FIRST, haltAfter, LAST, PROGRAM, value } from './session.mjs';

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

test('a conditional breakpoint halts when its condition holds; reverse continue returns to it', async () => {
  await entered();
  await breakAt(LAST, { condition: 'n = 5' });
  const frames = await haltAfter(() => client.continueRequest({ threadId: 1 }), 'breakpoint', LAST);
  assert.equal(await value('n', frames[0].id), '5');
  await haltAfter(() => client.nextRequest({ threadId: 1 }), 'step', FIRST);
  const back = await haltAfter(() => client.reverseContinueRequest({ threadId: 1 }), 'breakpoint', LAST);
  assert.equal(await value('n', back[0].id), '5');
});

test('a breakpoint with a wrong condition is not verified, with the reason', async () => {
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

test('a logpoint writes a message and does not halt', async () => {
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

test('a data breakpoint halts after the write', async () => {
  await entered();
  const info = await client.dataBreakpointInfoRequest({ name: 'Main.b.total' });
  assert.equal(info.body.dataId, 'Main.b.total');
  await client.setDataBreakpointsRequest({ breakpoints: [{ dataId: info.body.dataId, accessType: 'write' }] });
  await haltAfter(() => client.continueRequest({ threadId: 1 }), 'data breakpoint', LAST);
  assert.equal(await value('Main.b.total'), '2');
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
