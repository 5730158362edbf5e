import { request } from 'node:http';
import { expect, it } from 'vitest';
import { pageTest } from './page_test';

const watchToken = 'only-to-look-at-it';
const commandToken = 'to-change-things-too';
const test = pageTest({ tokens: { [watchToken]: 'watch', [commandToken]: 'command' } });

it('asks for a token, refuses a wrong one, and takes a right one', async () => {
  const page = await test.open();
  await page.getByLabel('Token').fill('a-guess-at-the-token');
  await page.getByRole('button', { name: 'Sign in' }).click();
  await page.getByRole('alert').waitFor();
  await page.getByLabel('Token').fill(commandToken);
  await page.getByRole('button', { name: 'Sign in' }).click();
  await page.locator('.dli-side .hex-bytes').waitFor();
  expect(await page.getByRole('switch', { name: 'Convert' }).isEnabled()).toBe(true);
  expect(await page.evaluate(() => document.cookie)).toBe('');
});

it('lets a watcher look and not touch, until he has a better token', async () => {
  const page = await test.open({ path: `#token=${watchToken}` });
  await page.locator('.dli-side .hex-bytes').waitFor();
  expect(new URL(page.url()).hash).toBe('');
  expect(await page.getByRole('switch', { name: 'Convert' }).isDisabled()).toBe(true);
  expect(
    await page.evaluate(
      async () => (await fetch('/api/v1/conversion', { method: 'PUT', body: '{"on":false}' })).status,
    ),
  ).toBe(403);
  await page.getByRole('button', { name: 'Links' }).click();
  await page.getByLabel('Token').fill(commandToken);
  await page.getByRole('button', { name: 'Sign in' }).click();
  await page.getByText('✓ You may command.').waitFor();
  await page.getByRole('button', { name: 'Sign out' }).click();
  await page.getByText('This server wants a token.', { exact: false }).waitFor();
});

it('refuses what comes from elsewhere', async () => {
  const headers = { Origin: 'http://elsewhere.example' };
  const answer = await fetch(`${test.server.url}api/v1/session`, {
    method: 'POST',
    headers,
    body: JSON.stringify({ token: commandToken }),
  });
  expect(answer.status).toBe(403);
  expect(await answer.json()).toMatchObject({ code: 'foreign_origin' });
});

it('opens no stream for a page from elsewhere, whatever its cookie', async () => {
  const page = await test.open({ path: `#token=${watchToken}` });
  await page.getByText('● Live').waitFor();
  const Cookie = (await page.context().cookies()).map(({ name, value }) => `${name}=${value}`).join('; ');
  const opening = {
    Cookie,
    Connection: 'Upgrade',
    Upgrade: 'websocket',
    'Sec-WebSocket-Version': 13,
    'Sec-WebSocket-Key': Buffer.alloc(16).toString('base64'),
  };
  const statusFor = (Origin: string) =>
    new Promise((done, fail) => {
      const asked = request(`${test.server.url}api/v1/stream`, { headers: { ...opening, Origin } });
      asked.on('upgrade', ({ statusCode }, socket) => {
        socket.destroy();
        done(statusCode);
      });
      asked.on('response', ({ statusCode }) => done(statusCode));
      asked.on('error', fail).end();
    });
  expect(await statusFor(new URL(test.server.url).origin)).toBe(101);
  expect(await statusFor('http://elsewhere.example')).toBe(403);
});
