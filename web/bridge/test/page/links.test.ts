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

it('says how much telemetry this client was too slow for', async () => {
  const page = await test.open({
    prepare: (opened) =>
      opened.routeWebSocket('**/api/v1/stream', (socket) => {
        const server = socket.connectToServer();
        server.onMessage((message) => {
          socket.send(message);
          if (String(message).startsWith('{"kind":"timing"')) socket.send('{"kind":"dropped","count":17}');
        });
      }),
  });
  await page.getByText('▲ 17 telemetry messages dropped', { exact: false }).waitFor();
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
