import { expect, test } from '../fixtures/test';

const SPECIAL = 'Special I/O Unit error';
const INPUTS = `${SPECIAL}, Analog inputs, Unit number 3`;
const OUTPUTS = `${SPECIAL}, Analog outputs, Unit number 20`;
const HARDWARE = `{
  "version": 1,
  "fitted": [
    {"kind": "fal", "number": 42, "name": "pump overpressure"},
    {"kind": "special-io-unit", "number": 3, "name": "Analog inputs"},
    {"kind": "special-io-unit", "number": 20, "name": "Analog outputs"}
  ]
}
`;

test('two units are fitted: both are raised, with a row each; one is recovered, the other stays', {
  tag: '@nightly',
}, async ({ openAs, server }) => {
  const mika = await openAs('Mika');
  await mika.runs();
  const { simulator } = mika;
  await expect(simulator.error(SPECIAL)).toContainText('Never');
  await expect(simulator.box(INPUTS)).toHaveCount(0);

  await test.step('with the hardware configuration the tree has the units below their kind', async () => {
    await server.put(`/projects/${server.project}/files/hardware.json`, { text: HARDWARE, version: 0 });
    await server.post(`/projects/${server.project}/build`, {});
    await expect(simulator.error(INPUTS)).toContainText('Never');
    await expect(simulator.error(OUTPUTS)).toContainText('Never');
    await expect(simulator.error('CPU Bus Unit error')).toContainText('not fitted');
    await expect(simulator.error('FAL error, pump overpressure, FAL number 42')).toBeVisible();
  });

  await test.step('both are raised at once', async () => {
    await simulator.box(INPUTS).check();
    await simulator.box(OUTPUTS).check();
    await simulator.generateButton.click();
    await expect(simulator.error(INPUTS)).toContainText('Generated');
    await expect(simulator.error(OUTPUTS)).toContainText('Generated');
    await expect(simulator.error(INPUTS)).toContainText('0303');
    await expect(simulator.error(OUTPUTS)).toContainText('0314');
  });

  await test.step('one is recovered, the other stays', async () => {
    await simulator.box(OUTPUTS).uncheck();
    await mika.page.getByRole('button', { name: 'Recover', exact: true }).click();
    await expect(simulator.error(INPUTS)).toContainText('Cleared');
    await expect(simulator.error(OUTPUTS)).toContainText('Generated');
    await expect(simulator.error(SPECIAL)).toContainText('Generated');
  });
});
