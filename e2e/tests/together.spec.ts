import type { WebSocketRoute } from '@playwright/test';
import type { Server } from '../fixtures/server';
import { expect, test } from '../fixtures/test';
import type { Editor } from '../pages/editor';
import type { Ide } from '../pages/ide';

test.use({ ownServer: true });

const FILE = 'Shared.st';
const BEGUN = ['FUNCTION_BLOCK Shared', '(* Mika *)', '(* middle *)', '(* Jo *)', 'END_FUNCTION_BLOCK', ''].join('\n');

/** Only a failure takes this long: the page waits longer before each attempt to connect. */
const LONG = 90_000;

interface Cable {
  pull(): Promise<void>;
  plugIn(): void;
}

/** The connection of one browser to the server, which can be pulled out; what is sent meanwhile is lost. */
async function cableOf({ page }: Ide): Promise<Cable> {
  let pulled = false;
  const open = new Set<WebSocketRoute>();
  await page.routeWebSocket('**/socket', (socket) => {
    if (pulled) {
      void socket.close();
      return;
    }
    socket.connectToServer();
    open.add(socket);
    socket.onClose(() => open.delete(socket));
  });
  await page.reload();
  return {
    pull: async () => {
      pulled = true;
      await Promise.all([...open].map((socket) => socket.close()));
    },
    plugIn: () => {
      pulled = false;
    },
  };
}

async function open(ide: Ide): Promise<Editor> {
  await ide.explorer.item('Shared').click();
  const editor = ide.editor(FILE);
  await expect(editor.line('END_FUNCTION_BLOCK')).toBeVisible();
  return editor;
}

/** All that is to be seen, for a file that fits. */
const textOf = (editor: Editor) =>
  editor.region.locator('.view-line').evaluateAll((lines) =>
    lines
      .map((line) => ({
        top: line.getBoundingClientRect().top,
        text: (line.textContent ?? '').replaceAll('\u00a0', ' '),
      }))
      .sort((a, b) => a.top - b.top)
      .map(({ text }) => text)
      .join('\n'),
  );

const savedText = async (server: Server) =>
  (await server.get<{ text: string }>(`/projects/${server.project}/files/${FILE}`)).text;

test('two people type in one file at once; one loses the connection, the server is killed: nothing is lost', async ({
  openAs,
  server,
}) => {
  await server.put(`/projects/${server.project}/files/${FILE}`, { text: BEGUN, version: 0 });
  const [mika, jo] = [await openAs('Mika'), await openAs('Jo')];
  const cable = await cableOf(jo);
  const [mine, theirs] = [await open(mika), await open(jo)];

  await test.step('both type, each in their own line, and see what the other types', async () => {
    await mine.caretAfter('(* Mika *)');
    await theirs.caretAfter('(* Jo *)');
    await Promise.all([mine.type('\n(* from Mika, 1 *)'), theirs.type('\n(* from Jo, 1 *)')]);
    for (const editor of [mine, theirs])
      for (const name of ['Mika', 'Jo']) await expect(editor.line(`(* from ${name}, 1 *)`)).toBeVisible();
    await expect(mika.statusBar).toContainText('Not saved');
    await expect(jo.statusBar).toContainText('Not saved');
  });

  await test.step('without a connection Jo goes on typing, and so does Mika; then the server is killed', async () => {
    await cable.pull();
    await expect(jo.banner).toContainText('No connection');
    await Promise.all([mine.type('\n(* from Mika, 2 *)'), theirs.type('\n(* from Jo, 2 *)')]);
    await server.kill();
    await expect(mika.banner).toContainText('No connection');
    await Promise.all([mine.type('\n(* from Mika, 3 *)'), theirs.type('\n(* from Jo, 3 *)')]);
  });

  await test.step('connected again, both have all of it', async () => {
    await server.startAgain();
    cable.plugIn();
    for (const editor of [mine, theirs])
      for (const name of ['Mika', 'Jo'])
        for (const turn of [1, 2, 3])
          await expect(editor.line(`(* from ${name}, ${turn} *)`)).toBeVisible({ timeout: LONG });
    expect(await textOf(mine)).toBe(await textOf(theirs));
  });

  await test.step('each takes back only their own; what one saves is saved for both', async () => {
    await mine.type(' ');
    await theirs.caretAfter('(* from Jo, 3 *)');
    await theirs.type('x');
    await expect(mine.line('(* from Jo, 3 *)x')).toBeVisible();
    await jo.page.keyboard.press('Control+z');
    await expect(mine.line('(* from Jo, 3 *)x')).toHaveCount(0);
    await expect(mine.line('(* from Mika, 3 *)')).toBeVisible();
    await mine.save();
    for (const ide of [mika, jo]) await expect(ide.statusBar).not.toContainText('Not saved');
    expect((await savedText(server)).trimEnd()).toBe((await textOf(theirs)).trimEnd());
  });

  await test.step('a save from elsewhere comes into what is being typed', async () => {
    await theirs.type('\n(* from Jo, 4 *)');
    const { version } = await server.get<{ version: number }>(`/projects/${server.project}/files/${FILE}`);
    const text = `(* from a tool *)\n${await savedText(server)}`;
    await server.put(`/projects/${server.project}/files/${FILE}`, { text, version });
    for (const editor of [mine, theirs]) {
      await expect(editor.line('(* from a tool *)')).toBeVisible();
      await expect(editor.line('(* from Jo, 4 *)')).toBeVisible();
    }
    await expect(jo.statusBar).toContainText('Not saved');
  });
});

test('what was typed without a connection survives a reload of the page and a restart of the server', {
  tag: '@nightly',
}, async ({ openAs, server }) => {
  await server.put(`/projects/${server.project}/files/${FILE}`, { text: BEGUN, version: 0 });
  const [mika, jo] = [await openAs('Mika'), await openAs('Jo')];
  const cable = await cableOf(jo);
  const [mine, theirs] = [await open(mika), await open(jo)];
  await cable.pull();
  await expect(jo.banner).toContainText('No connection');
  await theirs.addBelow('(* Jo *)', '(* kept in the browser *)');
  await mine.addBelow('(* Mika *)', '(* kept by the server *)');
  await expect(mika.statusBar).toContainText('Not saved');
  await server.kill();
  await server.startAgain();
  cable.plugIn();
  await jo.page.reload();
  for (const editor of [mine, theirs])
    for (const part of ['(* kept in the browser *)', '(* kept by the server *)'])
      await expect(editor.line(part)).toHaveCount(1, { timeout: LONG });
  expect(await textOf(mine)).toBe(await textOf(theirs));
});

test('ten turns of typing, cutting off and killing end with one text', { tag: '@nightly' }, async ({
  openAs,
  server,
}) => {
  await server.put(`/projects/${server.project}/files/${FILE}`, { text: BEGUN, version: 0 });
  const people = [await openAs('Mika'), await openAs('Jo')] as const;
  const cables = [await cableOf(people[0]), await cableOf(people[1])] as const;
  const editors = [await open(people[0]), await open(people[1])] as const;
  const deeds = ['type', 'cut', 'type', 'kill', 'type', 'plug', 'type', 'cut', 'type', 'kill'] as const;
  const all: string[] = [];
  await editors[0].caretAfter('(* Mika *)');
  await editors[1].caretAfter('(* Jo *)');
  for (const [turn, deed] of deeds.entries()) {
    const who = turn % 3 === 0 ? 0 : 1;
    if (deed === 'cut') await cables[who].pull();
    else if (deed === 'plug') for (const cable of cables) cable.plugIn();
    else if (deed === 'kill') {
      await server.kill();
      await server.startAgain();
    } else {
      const words = [`(* Mika ${turn} *)`, `(* Jo ${turn} *)`];
      all.push(...words);
      await Promise.all(editors.map((editor, at) => editor.type(`\n${words[at]}`)));
    }
  }
  for (const cable of cables) cable.plugIn();
  for (const editor of editors)
    for (const word of all) await expect(editor.line(word)).toHaveCount(1, { timeout: LONG });
  expect(await textOf(editors[0])).toBe(await textOf(editors[1]));
});

test('people see where the others are, follow them, and look at the past alone', { tag: '@nightly' }, async ({
  openAs,
}) => {
  const [mika, jo] = [await openAs('Mika'), await openAs('Jo')];
  await mika.runs();
  const main = mika.editor('Main.st');
  await jo.editor('Main.st').caretAfter('END_VAR');

  await test.step('Jo has a caret with her name', async () => {
    await expect(main.region.getByText('Jo', { exact: true })).toBeVisible();
  });

  await test.step('Mika follows Jo to a different file, until he moves', async () => {
    await mika.page.getByRole('button', { name: /^People/ }).click();
    await mika.page.getByRole('menuitem', { name: 'Follow Jo' }).click();
    await expect(mika.page.getByRole('region', { name: 'Following somebody' })).toBeVisible();
    await jo.explorer.item('Belt').click();
    await expect(mika.editor('Belt.st').region).toBeVisible();
    await mika.page.keyboard.press('Escape');
    await expect(mika.page.getByRole('region', { name: 'Following somebody' })).toBeHidden();
  });

  await test.step('Jo looks at the past alone: for Mika the PLC goes on', async () => {
    await mika.top.scansGoOn(50);
    await jo.timeline.want(20);
    await jo.page.getByRole('button', { name: 'Look alone' }).click();
    const alone = jo.page.getByRole('region', { name: 'Looking alone' });
    await expect(alone).toContainText('scan 20');
    await expect.poll(() => jo.top.scan()).toBe(20);
    await mika.top.scansGoOn(await mika.top.scan());
    await expect(mika.top.state).toContainText('Running');
    await alone.getByRole('button', { name: 'Return to line-1' }).click();
    await expect(alone).toBeHidden();
    await jo.runs();
  });
});
