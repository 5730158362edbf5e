import { expect, it } from 'vitest';
import { pageTest } from './page_test';

const test = pageTest();

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
