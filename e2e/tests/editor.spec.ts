import { expect, test } from '../fixtures/test';

test(
  'a syntax error is shown during typing, prevents the build, and does not stop the PLC',
  { tag: '@nightly' },
  async ({ openAs }, info) => {
    const mika = await openAs('Mika');
    await mika.runs();
    await mika.watch.set('start', 'TRUE');
    await expect.poll(() => mika.watch.number('Main.parts.total')).toBeGreaterThan(0);
    const main = mika.editor('Main.st');

    await test.step('squiggle and problem appear without a build', async () => {
      await mika.problems.show();
      await main.caretAfter('heartbeat := NOT heartbeat;');
      await expect(main.squiggles).toHaveCount(0);
      const measured = await mika.problems.measureFromKeyToShown();
      await main.type(')');
      const { squiggle, problem } = await measured();
      const figures = `squiggle ${squiggle.toFixed(0)} ms, problem ${problem.toFixed(0)} ms after the key`;
      info.annotations.push({ type: 'measured', description: figures });
      console.log(`    ${figures}`);
      await expect(mika.problems.entries).toContainText([/Main\.st:17:\d+/]);
    });

    await test.step('the build is refused with the position, and the old program continues', async () => {
      await main.build();
      await expect(main.outcome).toContainText('Build refused');
      await expect(mika.problems.entries).toContainText([/Main\.st:17:\d+/]);
      await expect(mika.top.state).toContainText('Running');
      await mika.top.scansGoOn();
      await expect(mika.statusBar).toContainText('Program version 1');
    });

    await test.step('a click on the problem goes to its place', async () => {
      await main.caretAfter('errors  : ErrorHandler;');
      await expect(mika.statusBar).toContainText('Ln 3,');
      await mika.problems.entries.first().click();
      await expect(mika.statusBar).toContainText('Ln 17,');
    });

    let parts = 0;
    await test.step('corrected and built, the new program runs with the old values', async () => {
      await mika.showPanel('Watch');
      await mika.watch.shows('motor', 'TRUE');
      parts = await mika.watch.number('Main.parts.total');
      await main.caretAfter('heartbeat := NOT heartbeat;)');
      await mika.page.keyboard.press('Backspace');
      await expect(main.squiggles).toHaveCount(0);
      await main.addBelow('uptime : TIME;', '  extra     : DINT;');
      await main.addBelow('uptime := TIME();', '  extra := extra + 1;');
      const before = await mika.top.scan();
      await main.build();
      await expect(main.outcome).toContainText('Built');
      await expect(mika.statusBar).toContainText('Program version 2');
      await mika.watch.add('Main.extra');
      await expect.poll(() => mika.watch.number('Main.extra')).toBeGreaterThan(0);
      await mika.watch.shows('motor', 'TRUE');
      expect(await mika.watch.number('Main.parts.total')).toBeGreaterThanOrEqual(parts);
      expect(await mika.top.scan()).toBeGreaterThan(before);
    });
  },
);

const FAST_MS = 25;
const TYPED = `FUNCTION_BLOCK Fill (* a tank *)
VAR_IN_OUT
  tank : ARRAY[0..3] OF INT;
END_VAR
VAR
  t : TON; // a 'timer'
END_VAR

IF tank[0] > 3 THEN
  t(IN := TRUE,
    PT := T#5s);
ELSE
  tank[1] := t.E;
END_IF;
END_FUNCTION_BLOCK
`;

for (const { delay, tag } of [
  { delay: FAST_MS, tag: [] },
  { delay: 110, tag: ['@nightly'] },
]) {
  test(`the text is exactly what was typed at ${delay} ms a key, also with Enter after a keyword`, { tag }, async ({
    openAs,
    server,
  }) => {
    const mika = await openAs('Mika');
    const late: (() => void)[] = [];
    const answer = () => {
      for (const go of late.splice(0)) go();
    };
    let asked = 0;
    let holding = true;
    await mika.page.routeWebSocket(/\/lsp$/, (page) => {
      const languageServer = page.connectToServer();
      page.onMessage((message) => {
        if (String(message).includes('textDocument/completion')) asked += 1;
        languageServer.send(message);
      });
      languageServer.onMessage((message) => {
        if (holding && asked > 0) late.push(() => page.send(message));
        else page.send(message);
      });
    });
    await mika.page.reload();
    await mika.runs();
    const main = mika.editor('Main.st');
    await main.replaceWith('');
    for (const line of TYPED.trimEnd().split('\n')) {
      // Only the word before Enter is typed slowly; the text before it is inserted at once.
      const [, before = '', last = ''] = delay > FAST_MS ? (/^(.*?)(\S*)$/.exec(line) ?? []) : ['', '', line];
      if (before) await mika.page.keyboard.insertText(before);
      await mika.page.keyboard.type(last, { delay });
      // The completions of the typed text arrive while Enter is pressed.
      answer();
      await mika.page.keyboard.press('Enter', { delay });
    }
    answer();
    expect(await main.stored(server)).toBe(TYPED);
    expect(asked).toBeGreaterThan(0);
    // The window is used by later stories, too.
    holding = false;
    answer();
  });
}

test('a completion is inserted only when it is chosen: with an arrow and Enter, or with Tab', {
  tag: '@nightly',
}, async ({ openAs, server }) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const main = mika.editor('Main.st');
  const { keyboard } = mika.page;
  await main.caretAfter('uptime := TIME();');
  await keyboard.press('Enter');
  await main.type('heartb');
  await expect(main.suggestions).toContainText('heartbeat');
  await keyboard.press('Tab');
  await main.type(' := NOT beat.');
  await expect(main.suggestions).toContainText('Q');
  await keyboard.press('ArrowDown');
  await keyboard.press('Enter');
  await main.type(';');
  await keyboard.press('Enter');
  await main.type('upt');
  await expect(main.suggestions).toContainText('uptime');
  await keyboard.press('Enter');
  expect(await main.stored(server)).toContain('TIME();\n  heartbeat := NOT beat.ET;\n  upt\n');
});
