import { expect, test } from '../fixtures/test';

test('who last wrote a variable: a person, then a statement, and going to it', { tag: '@nightly' }, async ({
  openAs,
}) => {
  const ann = await openAs('Ann');
  await ann.runs();
  await ann.watch.set('start', 'TRUE');
  await expect.poll(() => ann.watch.number('Main.parts.total')).toBeGreaterThan(1);
  await ann.top.press('Pause');
  const { writer } = ann.past;

  await test.step('for a command the dialog says who entered it', async () => {
    await ann.watch.fromMenu('start', 'Who last wrote this');
    await expect(writer).toContainText('Written by a command');
    await expect(writer).toContainText('Ann');
    await expect(writer).toContainText('TRUE');
    await writer.getByRole('button', { name: 'Close' }).first().click();
  });

  await test.step('for a statement the dialog says in which file, line and instance', async () => {
    await ann.watch.fromMenu('Main.parts.total', 'Who last wrote this');
    await expect(writer).toContainText('Written by the program');
    await expect(writer).toContainText('PartCounter.st:');
    await expect(writer).toContainText('Main.parts');
    await expect(writer).toContainText('total');
  });

  await test.step('the previous write came from the previous part', async () => {
    const total = await ann.watch.number('Main.parts.total');
    await writer.getByRole('button', { name: 'Previous write' }).click();
    await expect(writer.getByRole('definition').last()).toHaveText(String(total - 1));
  });

  await test.step('it goes to the moment before the write, and shows the statement', async () => {
    const before = (await ann.watch.number('Main.parts.total')) - 2;
    await writer.getByRole('button', { name: 'Go there' }).click();
    await expect(writer).toBeHidden();
    await expect(ann.timeline.banner).toBeVisible();
    await ann.watch.shows('Main.parts.total', String(before));
    await expect(ann.page.getByRole('tab', { name: 'PartCounter.st' })).toBeVisible();
  });
});

test('what changed in a range of scans that is selected by keyboard', { tag: '@nightly' }, async ({ openAs }) => {
  const ann = await openAs('Ann');
  await ann.runs();
  await ann.watch.set('start', 'TRUE');
  await expect.poll(() => ann.watch.number('Main.parts.total')).toBeGreaterThan(1);
  await ann.top.press('Pause');
  const mark = ann.timeline.mark(/Write: .*start/);
  const written = numberIn(/before scan ([\d,]+)/, await mark.getAttribute('aria-label'));
  await mark.click();
  await expect(ann.timeline.banner).toBeVisible();
  await expect.poll(() => ann.timeline.position()).toBe(written);
  const before = written - 1;

  await ann.timeline.axis.focus();
  await ann.page.keyboard.press('ArrowLeft');
  await expect.poll(() => ann.timeline.position()).toBe(before);
  await ann.page.keyboard.press('Shift+PageDown');
  await ann.page.keyboard.press('Enter');
  await ann.page.getByRole('menuitem', { name: /^What changed in scans / }).click();

  const { changes } = ann.past;
  await expect(ann.past.changed('motor')).toContainText('TRUE');
  await expect(changes.getByRole('region', { name: 'Commands in between' })).toContainText('start');
  await expect(changes.getByRole('region', { name: 'Commands in between' })).toContainText('Ann');
  await changes.getByRole('searchbox').fill('parts.total');
  await expect(ann.past.changed('motor')).toHaveCount(0);
  await expect(ann.past.changed('Main.parts.total')).toBeVisible();

  await changes
    .getByRole('button', { name: /^Go to scan / })
    .last()
    .click();
  await expect.poll(() => ann.timeline.position()).toBe(before + 101);
});

test('go back, branch, raise an error there, and compare the runs', async ({ openAs }) => {
  const ann = await openAs('Ann');
  await ann.runs();
  await ann.watch.set('start', 'TRUE');
  await expect.poll(() => ann.watch.number('Main.parts.total')).toBeGreaterThan(1);
  await ann.timeline.mark(/Write: .*start/).click();
  await expect(ann.timeline.banner).toBeVisible();
  const from = (await ann.timeline.position()) + 50;
  await ann.timeline.goTo(from);
  await ann.watch.shows('motor', 'TRUE');

  await test.step('in the branch a basic I/O unit fails', async () => {
    await ann.timeline.branch('what-if');
    await expect(ann.top.picker).toContainText('what-if');
    await expect.poll(() => ann.top.scan()).toBe(from);
    await ann.simulator.generate('Basic I/O Unit error');
    await ann.top.runScans(100);
    await ann.watch.shows('motor', 'FALSE');
    await expect(ann.top.state).toContainText('Paused');
  });

  await test.step('the runs diverge in the scan before which the error was raised', async () => {
    await ann.past.compareWith('line-1');
    const { comparison } = ann.past;
    await expect(comparison).toContainText('The runs diverge in scan');
    await expect(comparison).toContainText(`in scan ${grouped(from)}`);
    await expect(comparison).toContainText('A command was entered in one of them only.');
    const entered = comparison.getByRole('region', { name: 'Commands in one run only' });
    await expect(entered).toContainText('what-if');
    await expect(entered).toContainText('Basic I/O Unit error');
    await expect(comparison.getByRole('row').filter({ hasText: 'basicIoError' }).first()).toContainText('TRUE');
  });

  await test.step('the timeline shows where they differ, and leads there in both runs', async () => {
    await expect(ann.timeline.mark(/Difference/)).toHaveCount(1);
    const [other] = await Promise.all([
      ann.page.context().waitForEvent('page'),
      ann.past.comparison.getByRole('link', { name: /^Open line-1 at scan / }).click(),
    ]);
    await expect(other.getByRole('button', { name: 'Project and instance' })).toContainText('line-1');
    await expect(other.getByRole('region', { name: 'In the past' })).toContainText(grouped(from));
  });
});

test('a replay of the run, with the error one scan later', { tag: '@nightly' }, async ({ openAs }) => {
  const ann = await openAs('Ann');
  await ann.runs();
  await ann.watch.set('start', 'TRUE');
  await ann.watch.shows('motor', 'TRUE');
  await ann.simulator.generate('Basic I/O Unit error');
  await ann.watch.shows('motor', 'FALSE');
  await ann.top.scansGoOn();
  await ann.top.press('Pause');

  await test.step('the menu of the error’s mark begins it', async () => {
    await ann.timeline.mark(/^Error: .*Basic I\/O Unit error/).click({ button: 'right' });
    await ann.page.getByRole('menuitem', { name: 'Replay with it one scan later…' }).click();
    await ann.past.replay.getByRole('textbox', { name: 'Name of the new instance' }).fill('later');
    await ann.past.replay.getByRole('button', { name: 'Replay', exact: true }).click();
    await expect(ann.past.replay).toBeHidden();
  });

  await test.step('the result is compared with the original', async () => {
    const banner = ann.page.getByRole('region', { name: 'later is ready:' });
    await banner.getByRole('button', { name: 'Compare with the original' }).click();
    const bar = ann.page.getByRole('toolbar', { name: 'Compare runs' });
    await expect(bar.getByRole('combobox')).toContainText('later');
    await bar.getByRole('button', { name: 'Compare', exact: true }).click();
    await expect(ann.past.comparison).toContainText('The runs diverge in scan');
    await expect(ann.past.comparison).toContainText('They differ in');
    await banner.getByRole('button', { name: 'Open later' }).click();
    await expect(ann.top.picker).toContainText('later');
  });
});

test('a colleague opens the address of a scan', { tag: '@nightly' }, async ({ openAs }) => {
  const ann = await openAs('Ann');
  await ann.runs();
  await ann.watch.set('start', 'TRUE');
  await ann.watch.shows('motor', 'TRUE');
  await ann.timeline.mark(/Write: .*start/).click();
  await expect(ann.timeline.banner).toBeVisible();
  const scan = await ann.timeline.position();
  await expect(ann.page).toHaveURL(new RegExp(`/i/\\d+/scan/${scan}$`));
  const path = new URL(ann.page.url()).pathname;

  await test.step('while that scan is shown, it opens at once, with the panel', async () => {
    const bob = await openAs('Bob', `${path}?panel=history`);
    await expect(bob.timeline.banner).toContainText('shown by Ann');
    await expect.poll(() => bob.timeline.position()).toBe(scan);
    await expect(bob.page.getByRole('tab', { name: 'History' })).toHaveAttribute('aria-selected', 'true');
  });

  await test.step('while the PLC runs and others look at it, the page asks first', async () => {
    await ann.timeline.returnToLive();
    await expect(ann.page).toHaveURL(/\/i\/\d+$/);
    await ann.runs();
    const cid = await openAs('Cid', path);
    await expect(cid.past.question).toContainText('everybody at this PLC sees the past');
    await expect(cid.top.state).toContainText('Running');
    await cid.past.question.getByRole('button', { name: /^Show scan / }).click();
    await expect(ann.timeline.banner).toContainText('shown by Cid');
    await expect.poll(() => ann.timeline.position()).toBe(scan);
    await expect(cid.past.question).toBeHidden();
    await cid.timeline.returnToLive();
  });

  await test.step('a scan that does not exist is reported in words', async () => {
    const dan = await openAs('Dan', '/i/4711/scan/3');
    await expect(dan.page.getByRole('alert').filter({ hasText: 'This server has no instance 4711' })).toBeVisible();
    await dan.runs();
    const eve = await openAs('Eve', path.replace(/\d+$/, '999999999'));
    await expect(eve.page.getByRole('alert').filter({ hasText: 'cannot be shown' })).toBeVisible();
    const fay = await openAs('Fay', '/i/here');
    await expect(fay.page.getByRole('alert').filter({ hasText: 'names no instance' })).toBeVisible();
  });
});

test('the past before a build shows the text, the values and the version of its scan', { tag: '@nightly' }, async ({
  openAs,
}) => {
  const ann = await openAs('Ann');
  await ann.runs();
  await expect.poll(() => ann.top.scan()).toBeGreaterThan(20);
  const main = ann.editor('Main.st');
  await main.addBelow('uptime    : TIME;', '  extra     : DINT := 7;');
  await main.addBelow('uptime := TIME();', '  extra := extra + 1;');
  await main.build();
  await expect(ann.statusBar).toContainText('Program version 2');
  await ann.watch.add('Main.extra');
  await ann.watch.add('Main.uptime');
  await ann.watch.add('Main.parts.total');
  await expect.poll(() => ann.watch.number('Main.extra')).toBeGreaterThan(7);
  await expect(main.inlineValue('extra')).toBeVisible();
  await main.caretAfter('extra := extra + 1;');
  await main.type(' // mine');

  await test.step('text, values and version are those of version 1, and the text is read-only', async () => {
    await ann.timeline.goTo(10);
    await expect(ann.timeline.banner).toBeVisible();
    await expect(ann.statusBar).toContainText('Program version 1');
    await expect(ann.top.picker).toContainText('version 1');
    await expect(main.pastNote).toContainText('Program version 1');
    await expect(main.pastNote).toContainText('Your unsaved text is kept');
    await expect(main.line('uptime := TIME();')).toBeVisible();
    await expect(main.line('extra')).toHaveCount(0);
    await expect(ann.watch.row('Main.extra')).toContainText('not in version 1');
    await expect(main.inlineValue('uptime')).toHaveText((await ann.watch.value('Main.uptime').textContent()) ?? '');
    await expect(main.inlineValue('extra')).toHaveCount(0);
    await main.caretAfter('uptime := TIME();');
    await main.type('typed');
    await expect(main.line('typed')).toHaveCount(0);
  });

  await test.step('live again, the edited text is back, including unsaved changes', async () => {
    await ann.timeline.returnToLive();
    await expect(ann.statusBar).toContainText('Program version 2');
    await expect(ann.top.picker).toContainText('version 2');
    await expect(main.pastNote).toHaveCount(0);
    await expect(main.line('extra := extra + 1; // mine')).toBeVisible();
    await expect(main.saveButton).toBeEnabled();
    await expect.poll(() => ann.watch.number('Main.extra')).toBeGreaterThan(7);
    await expect(main.inlineValue('extra')).toBeVisible();
  });
});

test('the past across three versions: each scan with its text, its values and the name of its version', {
  tag: '@nightly',
}, async ({ openAs }) => {
  const ann = await openAs('Ann');
  await ann.runs();
  const main = ann.editor('Main.st');
  const scans: number[] = [];
  const live = async (version: number) => {
    await expect(ann.statusBar).toContainText(`Program version ${version}`);
    await ann.top.scansGoOn();
    scans.push(await ann.top.scan());
  };
  await live(1);
  await main.addBelow('uptime    : TIME;', '  second    : DINT := 2000;');
  await main.addBelow('uptime := TIME();', '  second := second + 1;');
  await main.build();
  await live(2);
  await main.addBelow('second    : DINT := 2000;', '  third     : DINT := 3000;');
  await main.addBelow('second := second + 1;', '  third := third + 1;');
  await main.build();
  await live(3);
  for (const path of ['Main.uptime', 'Main.second', 'Main.third']) await ann.watch.add(path);

  const names = ['uptime', 'second', 'third'];
  for (const version of [1, 3, 2, 1]) {
    await test.step(`in a scan of version ${version}`, async () => {
      await ann.timeline.goTo(scans[version - 1] ?? 0);
      await expect(ann.statusBar).toContainText(`Program version ${version}`);
      await expect(ann.top.picker).toContainText(`version ${version}`);
      // The newest version is also that of the text that is edited: nothing is to be said then.
      if (version < 3) await expect(main.pastNote).toContainText(`Program version ${version}`);
      else await expect(main.pastNote).toHaveCount(0);
      for (const [index, name] of names.entries()) {
        const known = index < version;
        if (known) await main.reveal(`${name} :=`);
        await expect(main.line(`${name} :=`)).toHaveCount(known ? 1 : 0);
        if (!known) {
          await expect(ann.watch.row(`Main.${name}`)).toContainText(`not in version ${version}`);
          continue;
        }
        await expect(ann.watch.row(`Main.${name}`)).not.toContainText('not in version');
        await expect(ann.watch.value(`Main.${name}`)).toHaveText(/[0-9]/);
        await expect(main.inlineValue(name)).toHaveText((await ann.watch.value(`Main.${name}`).textContent()) ?? '');
      }
    });
  }

  await test.step('live again, in the newest version', async () => {
    await ann.timeline.returnToLive();
    await expect(ann.statusBar).toContainText('Program version 3');
    await expect(ann.top.picker).toContainText('version 3');
    await expect(main.pastNote).toHaveCount(0);
    await expect(ann.watch.value('Main.third')).toHaveText(/[0-9]/);
  });
});

/** A number as the page shows it, with thin gaps. */
const grouped = (scan: number) => String(scan).replace(/\B(?=(\d{3})+(?!\d))/g, ',');

/** The number that a text names, which is grouped for people. */
function numberIn(pattern: RegExp, text: string | null): number {
  return Number(pattern.exec(text ?? '')?.[1]?.replaceAll(',', ''));
}
