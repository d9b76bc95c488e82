import { expect, test } from '../fixtures/test';
import { zipOf } from '../fixtures/zip';

const MAIN = `<?xml version="1.0" encoding="utf-8"?>
<TcPlcObject Version="1.1.0.1">
  <POU Name="MAIN" Id="{00000000-0000-0000-0000-000000000001}" SpecialFunc="None">
    <Declaration><![CDATA[PROGRAM MAIN
VAR
  sent : DINT;
  count : DINT;
  text : Tc2_System.T_MaxString;
END_VAR]]></Declaration>
    <Implementation>
      <ST><![CDATA[sent := Tc2_System.ADSLOGSTR(ADSLOG_MSGTYPE_ERROR, text, text);
IF sent <> 0 THEN
  count := count + 1;
END_IF]]></ST>
    </Implementation>
  </POU>
</TcPlcObject>
`;
const PROJECT = `<Project><PropertyGroup><Name>Line</Name></PropertyGroup>
<ItemGroup><Compile Include="POUs\\MAIN.TcPOU"><SubType>Code</SubType></Compile></ItemGroup>
<ItemGroup><PlaceholderReference Include="Tc2_System"><Namespace>Tc2_System</Namespace></PlaceholderReference></ItemGroup>
</Project>`;

test('a TwinCAT project comes in, its report is read, it runs with stubs whose results are set, and is debugged in its own file', {
  tag: '@nightly',
}, async ({ openAs }) => {
  const jo = await openAs('Jo');
  const page = jo.page;

  await test.step('it comes in with the library that it uses', async () => {
    await jo.top.picker.click();
    await page.getByRole('menuitem', { name: 'New project…' }).click();
    const dialog = page.getByRole('dialog', { name: 'New project' });
    await dialog.getByLabel(/^Program files/).setInputFiles({
      name: 'Line.zip',
      mimeType: 'application/zip',
      buffer: zipOf({ 'Line/Line.plcproj': PROJECT, 'Line/POUs/MAIN.TcPOU': MAIN }),
    });
    await dialog.getByRole('textbox', { name: 'Name' }).fill('From TwinCAT');
    await dialog.getByRole('button', { name: 'Create' }).click();
    await expect(jo.top.picker).toContainText('From TwinCAT');
    await jo.runs();
    await expect(page.getByLabel('Dialect')).toHaveValue('twincat');
  });

  await test.step('the report names the stub', async () => {
    await page.getByRole('button', { name: 'Libraries and report' }).click();
    const dialog = page.getByRole('dialog', { name: 'Libraries' });
    await expect(dialog.getByRole('button', { name: 'Show Tc2_System' })).toBeVisible();
    const opened = page.waitForEvent('popup');
    await dialog.getByRole('link', { name: /^Report/ }).click();
    const report = await opened;
    await expect(report.locator('body')).toContainText('1 of 1 POUs (100.0 %) run');
    await expect(report.locator('body')).toContainText('1 of these 1 use stubs');
    await expect(report.locator('body')).toContainText('ADSLOGSTR');
    await report.close();
    await dialog.getByRole('button', { name: 'Close' }).last().click();
  });

  await test.step("the result of the stub is set, and the program's own file is debugged", async () => {
    for (const path of ['Stub_ADSLOGSTR', 'MAIN.count']) await jo.watch.add(path);
    await jo.watch.shows('MAIN.count', '0');
    await jo.debug.clickGutter('POUs/MAIN.TcPOU', 'count := count + 1;');
    await jo.watch.set('Stub_ADSLOGSTR', '7');
    await expect(jo.debug.glyph('POUs/MAIN.TcPOU', 'gl-here')).toBeVisible();
    await page.keyboard.press('F5');
    await expect(jo.debug.glyph('POUs/MAIN.TcPOU', 'gl-here')).toBeVisible();
    await jo.watch.shows('MAIN.count', '1');
  });
});
