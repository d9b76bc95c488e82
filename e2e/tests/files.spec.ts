import { expect, test } from '../fixtures/test';

const BLOCK = `<?xml version="1.0" encoding="utf-8"?>
<TcPlcObject Version="1.1.0.1">
  <POU Name="FB_Ramp" Id="{1}">
    <Declaration><![CDATA[FUNCTION_BLOCK FB_Ramp
VAR_OUTPUT
  count : DINT;
END_VAR]]></Declaration>
    <Implementation><ST><![CDATA[count := count + 1;]]></ST></Implementation>
  </POU>
</TcPlcObject>
`;

/** As an old tool writes it: the umlaut is one byte. */
const LATIN1 = Buffer.from("FUNCTION Name : STRING\nName := 'Tür';\nEND_FUNCTION\n", 'latin1');

test('files of other tools are added and run; refused files have a reason', { tag: '@nightly' }, async ({ openAs }) => {
  const jo = await openAs('Jo');
  await jo.runs();
  await jo.top.newProject('Brought in');
  const main = jo.editor('Main.st');
  await expect(main.region).toBeVisible();

  await test.step('a block of TwinCAT and a function in Latin-1', async () => {
    await jo.explorer.addFiles({ name: 'FB_Ramp.TcPOU', text: BLOCK }, { name: 'Name.st', text: LATIN1 });
    await expect(jo.explorer.item('FB_Ramp')).toBeVisible();
    await expect(jo.explorer.item('Name')).toBeVisible();
    await jo.explorer.item('Name').click();
    await expect(jo.editor('Name.st').line("Name := 'Tür';")).toBeVisible();
  });

  await test.step('the program uses both files', async () => {
    await main.open();
    const body = 'VAR ramp : FB_Ramp; text : STRING; END_VAR\nramp();\ntext := Name();';
    await main.replaceWith(`PROGRAM Main\n${body}\nEND_PROGRAM\n`);
    await main.build();
    await expect(main.outcome).toContainText('Built');
    await jo.watch.add('Main.ramp.count');
    await jo.watch.add('Main.text');
    await expect.poll(() => jo.watch.number('Main.ramp.count')).toBeGreaterThan(0);
    await jo.watch.shows('Main.text', /^'T.*r'$/);
  });

  await test.step('a name that already exists is refused', async () => {
    await jo.explorer.addFiles({ name: 'fb_ramp.tcpou', text: BLOCK });
    const dialog = jo.page.getByRole('dialog', { name: 'Not added' });
    await expect(dialog).toContainText('fb_ramp.tcpou: A file of this name already exists.');
    await jo.page.keyboard.press('Escape');
    await expect(dialog).toBeHidden();
  });

  await test.step('a second project gets an instance of its own without a question', async () => {
    await jo.top.newProject('One more');
    await jo.runs();
  });
});
