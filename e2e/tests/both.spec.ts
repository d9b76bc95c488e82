import { drawing } from '../fixtures/drawing';
import { expect, test } from '../fixtures/test';

const RUNGS = Array.from({ length: 30 }, (_, index) => `RUNG "Rung of q${index}"\n    [go] (q${index})\nEND_RUNG\n`);
const BLOCK = `FUNCTION_BLOCK Latch
VAR_INPUT go, halt : BOOL; END_VAR
VAR_OUTPUT on : BOOL; END_VAR
VAR ${RUNGS.map((_, index) => `q${index}`).join(', ')} : BOOL; END_VAR
RUNG "The motor holds itself as long as nobody halts it"
    // Why it does so is a comment that is longer than its line
    [go] [/halt] (on)
END_RUNG
RUNG "A second rung that writes the same variable"
    [undeclared] (on)
END_RUNG
RUNG "Nothing is written"
    [go]
END_RUNG
${RUNGS.join('')}END_FUNCTION_BLOCK
`;

test('beside its text a drawing is followed by it, and follows its caret', async ({ openAs, server }) => {
  const mika = await openAs('Mika');
  const { page } = mika;
  const sheet = await drawing(mika, server, {
    block: 'Latch',
    text: BLOCK,
    variables: 'latch : Latch;',
    calls: 'latch(go := start);',
  });
  const editor = mika.editor('Latch.st');
  const marked = editor.region.locator('.elementline');
  /** Each word of a line is drawn by itself. */
  const here = async () => (await editor.region.locator('.elementhere').allTextContents()).join('');
  const selected = sheet.getByRole('option', { selected: true });
  await page.getByRole('radio', { name: 'Both' }).click();
  await expect(editor.line('RUNG "Nothing')).toBeVisible();

  await test.step('what is said of rungs is in sight beside their titles, and whole below the drawing', async () => {
    await expect(sheet.getByText('no coil yet')).toBeVisible();
    const heads = await sheet.evaluate((element) => {
      const right = element.getBoundingClientRect().left + element.clientWidth;
      return [...element.querySelectorAll('.hd')].map((head) => {
        const boxes = [...head.children].map((each) => each.getBoundingClientRect()).filter(({ width }) => width > 0);
        const over = boxes.filter((box, index) => index > 0 && box.left < (boxes[index - 1]?.right ?? 0) - 1);
        return { over: over.length, outside: boxes.filter((box) => box.right > right + 1).length };
      });
    });
    expect(heads.length).toBeGreaterThan(2);
    for (const head of heads) expect(head).toEqual({ over: 0, outside: 0 });
    await sheet.getByText('A second rung').click();
    const said = page.getByRole('status').filter({ hasText: 'Rungs 1, 2 write on; the last one counts' });
    await expect(said).toBeVisible();
    expect(await said.evaluate(({ scrollWidth, clientWidth }) => scrollWidth - clientWidth)).toBeLessThanOrEqual(0);
  });

  await test.step('the text shows what the cursor of the drawing is at', async () => {
    await sheet.getByRole('option', { name: 'Closed contact halt' }).click();
    await expect.poll(here).toBe('[/halt]');
    for (let rungs = 0; rungs < 12; rungs += 1) await page.keyboard.press('Control+ArrowDown');
    await page.keyboard.press('End');
    await expect(selected).toHaveAccessibleName('Coil q9');
    const name = ((await selected.getAttribute('aria-label')) ?? '').replace('Coil ', '');
    await expect.poll(here).toBe(`(${name})`);
    await expect(marked).toBeVisible();
    await expect(sheet).toBeFocused();
  });

  await test.step('an edit of the drawing leaves its cursor where it is', async () => {
    const name = await selected.getAttribute('aria-label');
    await page.keyboard.press('!');
    await expect(selected).toHaveAccessibleName(/, negated$/);
    await page.keyboard.press('Control+Z');
    await expect(selected).toHaveAccessibleName(name ?? '');
  });

  await test.step('the drawing shows where the caret of the text is, which keeps the focus', async () => {
    // The text may still scroll to the element under the pointer.
    await expect(async () => {
      await editor.caretAfter('RUNG "Rung of q1');
      await expect(sheet.locator('.net.cur')).toContainText('Rung of q1', { timeout: 5_000 });
    }).toPass();
    await expect(editor.text).toBeFocused();
    await expect(marked).toHaveCount(0);
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('End');
    await expect(selected).toHaveAccessibleName(/^Coil q1/);
    await expect(editor.text).toBeFocused();
    await page.keyboard.type(' ');
    await expect(editor.text).toBeFocused();
  });
});
