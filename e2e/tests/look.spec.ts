import { expect, test } from '../fixtures/test';
import type { Ide } from '../pages/ide';

test('at 1024 x 700 everything is in reach', async ({ openAs }) => {
  const mika = await openAs('Mika');
  await mika.page.setViewportSize({ width: 1024, height: 700 });
  await mika.page.reload();
  await mika.runs();
  await mika.simulator.generate('Basic I/O Unit error');

  await test.step('the page does not scroll sideways', async () => {
    const wide = await mika.page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    expect(wide).toBeLessThanOrEqual(0);
  });

  await test.step('every control of the bars is in the window', async () => {
    for (const bar of [mika.page.getByRole('banner'), mika.statusBar]) {
      for (const control of await bar.getByRole('button').or(bar.getByRole('radio')).all()) {
        if (await control.isVisible()) await expect(control).toBeInViewport({ ratio: 1 });
      }
    }
    await expect(mika.top.state).toBeInViewport({ ratio: 1 });
    await expect(mika.top.mode('RUN')).toBeInViewport({ ratio: 1 });
  });

  await test.step('every panel can be opened and used', async () => {
    await expect(mika.explorer.tree).toBeHidden();
    await mika.page.getByRole('toolbar', { name: 'Left panels' }).getByRole('button', { name: 'Explorer' }).click();
    await mika.explorer.item('Belt').click();
    await expect(mika.editor('Belt.st').line('FUNCTION_BLOCK Belt').first()).toBeInViewport();
    await expect(mika.explorer.tree).toBeHidden();
    await mika.showPanel('History');
    await mika.history('Basic I/O Unit error').scrollIntoViewIfNeeded();
    await expect(mika.history('Basic I/O Unit error')).toBeInViewport();
    for (const column of await mika.page
      .getByRole('table', { name: 'Error history' })
      .getByRole('columnheader')
      .all()) {
      await expect(column).toBeInViewport({ ratio: 1 });
    }
    await mika.showPanel('Error simulator');
    await expect(mika.page.getByRole('button', { name: 'Recover', exact: true })).toBeInViewport({ ratio: 1 });
    await expect(mika.simulator.word('A402')).toBeInViewport({ ratio: 1 });
    const seen = await mika.simulator.tree.locator('.name .cut').evaluateAll((names) =>
      names.map((name) => {
        const length = name.textContent?.length ?? 0;
        return {
          text: name.textContent,
          whole: (name.clientWidth / name.scrollWidth) * length,
          least: Math.min(24, length),
        };
      }),
    );
    expect(seen.length).toBeGreaterThan(8);
    expect(seen.filter(({ whole, least }) => whole < least)).toEqual([]);
    await mika.problems.show();
    await expect(mika.page.getByText('No problems.')).toBeInViewport();
    await mika.showPanel('Events');
    await expect(mika.page.getByRole('table', { name: 'Events' })).toBeInViewport();
    await mika.showPanel('Watch');
    await mika.watch.set('start', 'TRUE');
    await expect(mika.watch.value('motor')).toBeInViewport({ ratio: 1 });
  });
});

test('by keyboard alone', { tag: '@nightly' }, async ({ openAs }) => {
  const mika = await openAs('Mika');
  await mika.runs();
  await expect(mika.editor('Main.st').line('PROGRAM Main').first()).toBeVisible();
  const press = (key: string) => mika.page.keyboard.press(key);

  await test.step('F6 goes through the panes and returns to the first', async () => {
    const round = await roundOfPanes(mika, 'F6');
    expect(round.slice().sort()).toEqual([
      'debug',
      'editor',
      'errors',
      'explorer',
      'status',
      'timeline',
      'topbar',
      'watch',
    ]);
    const back = await roundOfPanes(mika, 'Shift+F6');
    expect(back.slice().sort()).toEqual(round.slice().sort());
  });

  await test.step('in the editor F6 moves the focus into the text', async () => {
    await mika.goToPane('editor');
    await mika.page.keyboard.type('x');
    await expect(mika.statusBar).toContainText('Not saved');
    await press('Control+Z');
  });

  await test.step('a value is written from the watch table', async () => {
    await mika.goToPane('watch');
    await mika.watch.name('start').click();
    await expect(mika.watch.table).toBeFocused();
    await press('Enter');
    await expect(mika.watch.entry('start')).toBeFocused();
    await mika.page.keyboard.type('TRUE');
    await press('Enter');
    await mika.watch.shows('motor', 'TRUE');
  });

  await test.step('F5 pauses, F8 runs one scan, F5 continues', async () => {
    await press('F5');
    await expect(mika.top.state).toContainText('Paused');
    const scan = await mika.top.scan();
    await press('F8');
    await expect.poll(() => mika.top.scan()).toBe(scan + 1);
    await press('F5');
    await mika.runs();
  });
});

/** The panes that a key visits until it comes back to one already seen. */
async function roundOfPanes(ide: Ide, key: string): Promise<string[]> {
  const seen: string[] = [];
  for (;;) {
    await ide.page.keyboard.press(key);
    const pane = await ide.focusedPane();
    if (seen.includes(pane) || seen.length > 20) return seen;
    seen.push(pane);
  }
}
