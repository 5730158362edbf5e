// What only the mock server's invented data shows.
import { expect, it } from 'vitest';
import { pageTest } from './page_test';

const test = pageTest({ invented: { wrongRoll: false } });

it('changes between vehicles', async () => {
  const page = await test.open();
  await page.getByRole('button', { name: /14:40:00:02/ }).click();
  await page.locator('.dli-side p', { hasText: '14:40:00:02 →' }).waitFor();
  await page.locator('.mavlink-side p', { hasText: '2/1' }).waitFor();
});

it('shows losses and why something was rejected', async () => {
  const page = await test.open();
  await page.getByRole('button', { name: 'Inspector' }).click();
  await page.getByRole('row', { name: /bad checksum/ }).waitFor();
  expect(await page.getByRole('row', { name: '1/1/1', exact: false }).last().textContent()).toContain('▲ 2');
});

it('connects to a serial port at a baud rate, and disconnects', async () => {
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
