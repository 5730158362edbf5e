import { expect, it } from 'vitest';
import { pageTest } from './page_test';
import { usesPonte } from './server';

const test = pageTest();

it.skipIf(usesPonte)('connects to a serial port at a baud rate, and disconnects', async () => {
  const page = await test.open();
  await page.getByRole('button', { name: 'Links' }).click();
  await page.locator('select', { hasText: '/dev/ttyACM0' }).selectOption('/dev/ttyACM0');
  await page.getByLabel('Baud rate').selectOption('115200');
  expect(await page.getByLabel('Endpoint').inputValue()).toBe('serial:///dev/ttyACM0:115200');
  await page.getByRole('button', { name: 'Connect', exact: true }).click();
  await page.locator('.links li', { hasText: 'serial:///dev/ttyACM0:115200' }).waitFor();
  await page.getByRole('button', { name: 'Disconnect: serial:///dev/ttyACM0:115200' }).click();
  await page.locator('.links li', { hasText: 'serial:///dev/ttyACM0' }).waitFor({ state: 'detached' });
  await page.locator('.events li', { hasText: 'Link down' }).first().waitFor();
});

it('says why an endpoint is refused', async () => {
  const page = await test.open();
  await page.getByRole('button', { name: 'Links' }).click();
  await page.getByLabel('Endpoint').fill('carrier-pigeon');
  await page.getByRole('button', { name: 'Connect', exact: true }).click();
  expect(await page.getByRole('alert').textContent()).toContain('carrier-pigeon');
});

it('finds the server again after it was restarted', async () => {
  const page = await test.open();
  await page.getByText('● Live').waitFor();
  await test.server.close();
  await page.getByText('▲ Lost, trying again').waitFor();
  await test.server.restart();
  await page.getByText('● Live').waitFor();
  await page.locator('.dli-side .hex-bytes').waitFor();
});
