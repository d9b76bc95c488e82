import { expect, test } from '../fixtures/test';
import { run } from '../pages/everywhere';

/** POUs in their layout, whose lines end with names, keywords and half of a name that a longer one begins with: what a list of completions could take. */
const POUS = [
  `FUNCTION_BLOCK Valve
VAR_INPUT
  open : BOOL;
  wait : TIME := T#2s;
END_VAR
VAR_OUTPUT
  isOpen, failed : BOOL;
END_VAR
VAR
  late : TON;
END_VAR
  late(IN := open AND NOT isOpen,
    PT := wait);
  IF late.Q THEN
    failed := TRUE;
  ELSIF NOT open THEN
    failed := FALSE;
  END_IF
  isOpen := open AND NOT
    failed;
END_FUNCTION_BLOCK
`,
  `FUNCTION Clamp : INT
VAR_INPUT
  value, low, high : INT;
END_VAR
  IF value < low THEN
    Clamp := low;
  ELSE
    Clamp := MIN(value,
      high);
  END_IF;
END_FUNCTION
`,
  `TYPE
  Phase : (idle, filling, draining);
  Recipe : STRUCT
    name   : STRING[20] := 'water $'hot$'';
    amount : REAL;
    steps : ARRAY[1..4] OF
    Phase;
  END_STRUCT;
END_TYPE
`,
  `FUNCTION_BLOCK Counter
VAR_IN_OUT
  total : DINT;
END_VAR
VAR
  edge : R_TRIG;
  i    : INT;
END_VAR
  (* counts
   in two lines *)
  FOR i := 1 TO 3 DO
    total := total
      + 1;
  END_FOR;
  WHILE i > 0 DO
    i := i - 1;
    EXIT
  END_WHILE;
END_FUNCTION_BLOCK
`,
  `PROGRAM Typed
VAR
  valve          : Valve;
  count          : Counter;
  sum   AT %MD10 : DINT;
  phase          : Phase;
END_VAR
  valve(open := phase = Phase#filling);
  CASE phase OF
    Phase#idle:
      phase := Phase#filling
      ;
    Phase#filling:
      IF valve.isOpen THEN
        phase := Phase#draining;
      END_IF;
  ELSE
    phase := Phase#idle;
  END_CASE;
  count(total := sum);
END_PROGRAM
`,
];
const QUICK_MS = 25;
const SLOW_MS = 110;

for (const { name, texts, delay, formatting } of [
  { name: 'five POUs typed quickly', texts: POUS, delay: QUICK_MS, formatting: false },
  { name: 'five POUs typed slowly', texts: POUS, delay: SLOW_MS, formatting: false },
  { name: 'five POUs typed quickly and formatted meanwhile', texts: POUS, delay: QUICK_MS, formatting: true },
  { name: 'one POU typed slowly and formatted meanwhile', texts: POUS.slice(1, 2), delay: SLOW_MS, formatting: true },
]) {
  test(`${name}, with Enter at every line end, are stored as they were typed`, { tag: '@nightly' }, async ({
    openAs,
    server,
  }) => {
    const mika = await openAs('Mika');
    await mika.runs();
    const { keyboard } = mika.page;
    const main = mika.editor('Main.st');
    await main.replaceWith('');
    if (formatting) {
      await run(mika.page, 'Format while typing');
      await main.text.focus();
      await keyboard.type('program  Ugly\nvar\nn:INT;', { delay });
      await expect(main.line('n : INT;').first()).toBeVisible();
      await expect(main.line('PROGRAM Ugly').first()).toBeVisible();
      await main.replaceWith('');
    }
    // The list of completions is on: it is there for a word that is not finished.
    await keyboard.type('PROG', { delay });
    await expect(main.suggestions).toBeVisible();
    await keyboard.press('Escape');
    await main.replaceWith('');
    for (const line of texts.join('\n').split('\n').slice(0, -1)) {
      await keyboard.type(line, { delay });
      await keyboard.press('Enter', { delay });
    }
    // What was typed last may be formatted a moment later.
    await expect(async () => {
      await keyboard.press('Control+S');
      const { text } = await server.get<{ text: string }>(`/projects/${server.project}/files/Main.st`);
      expect(text).toBe(texts.join('\n'));
    }).toPass();
  });
}

test('lines typed without blanks are indented by their blocks, and the keywords of a block are marked', {
  tag: '@nightly',
}, async ({ openAs, server }) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const { keyboard } = mika.page;
  const main = mika.editor('Main.st');
  await main.replaceWith('');
  await keyboard.type(
    'PROGRAM Main\nVAR\nn : INT;\nEND_VAR\nn := n + 1;\nIF n > 2 THEN\nn := 0;\n\nELSE\nCASE n OF\n1:\nn := 2;\nEND_CASE;\nelsewhere := 1;\nEND_IF;\nEND_PROGRAM\n',
  );
  await expect(main.stored(server)).resolves.toBe(
    'PROGRAM Main\nVAR\n  n : INT;\nEND_VAR\nn := n + 1;\nIF n > 2 THEN\n  n := 0;\n\nELSE\n  CASE n OF\n    1:\n      n := 2;\n' +
      '  END_CASE;\n  elsewhere := 1;\nEND_IF;\nEND_PROGRAM\n',
  );
  await main
    .line('END_IF')
    .first()
    .click({ position: { x: 20, y: 8 } });
  await expect(main.region.locator('.wordHighlightText')).toHaveCount(3);
});
