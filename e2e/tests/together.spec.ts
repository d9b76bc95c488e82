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
  editor.region
    .locator('.view-line')
    .evaluateAll((lines) =>
      lines
        .map((line) => ({ top: line.getBoundingClientRect().top, text: (line.textContent ?? '').replaceAll('\u00a0', ' ') }))
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
