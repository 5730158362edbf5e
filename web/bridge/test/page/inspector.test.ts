import { expect, it } from 'vitest';
import { pageTest } from './page_test';

const test = pageTest();

it('counts, filters, pauses', async () => {
  const page = await test.open();
  await page.getByRole('button', { name: 'Inspector' }).click();
  await page.locator('.opener', { hasText: 'HEARTBEAT' }).first().waitFor();
  await page.getByLabel('Filter').fill('attitude roll');
  await page.locator('.opener', { hasText: 'HEARTBEAT' }).first().waitFor({ state: 'detached' });
  const count = page
    .getByRole('row', { name: /ATTITUDE/ })
    .first()
    .getByRole('cell')
    .nth(1);
  const before = await count.textContent();
  await page.waitForFunction(
    (text) => document.querySelector('.messages tbody td:nth-child(3)')?.textContent !== text,
    before,
  );
  await page.getByRole('button', { name: 'Pause' }).click();
  const held = await count.textContent();
  await page.getByRole('button', { name: 'Resume' }).click();
  await page.waitForFunction(
    (text) => document.querySelector('.messages tbody td:nth-child(3)')?.textContent !== text,
    held,
  );
});

it('plots an element of an array', async () => {
  const page = await test.open();
  await page.getByRole('button', { name: 'Inspector' }).click();
  await page.locator('.opener', { hasText: 'BATTERY_STATUS id=0' }).first().click();
  await page.getByRole('button', { name: /^Plot: BATTERY_STATUS 0 voltages\[1\]/ }).click();
  const figure = page.locator('.charts figure');
  await figure.locator('canvas').waitFor();
  await expect
    .poll(async () => Number(await figure.locator('figcaption .number').textContent()), { timeout: 50_000 })
    .toBeGreaterThan(1000);
  await figure.getByRole('button', { name: /^Remove/ }).click();
  await figure.waitFor({ state: 'detached' });
});
