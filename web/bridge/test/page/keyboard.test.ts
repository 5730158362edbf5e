import type { Locator, Page } from 'playwright-core';
import { expect, it } from 'vitest';
import { pageTest } from './page_test';

const test = pageTest();

async function tabTo(page: Page, wanted: Locator): Promise<void> {
  const isReached = () => wanted.evaluate((element) => element === document.activeElement);
  for (let stops = 0; !(await isReached()); ++stops) {
    expect(stops, 'controls before it').toBeLessThan(50);
    await page.keyboard.press('Tab');
  }
}

it('does everything by single keys', async () => {
  const page = await test.open();
  await page.locator('.dli-side .hex-bytes').waitFor();
  const current = () => page.locator('nav [aria-current=page]').textContent();
  await page.keyboard.press('2');
  expect(await current()).toBe('Inspector');
  await page.keyboard.press('3');
  expect(await current()).toBe('Timing');
  await page.keyboard.press('4');
  expect(await current()).toBe('Links');
  await page.keyboard.press('1');
  await page.keyboard.press('p');
  await page.getByRole('button', { name: 'Resume' }).waitFor();
  await page.keyboard.press('p');
  await page.keyboard.press('c');
  await page.getByText('conversion is off', { exact: true }).waitFor();
  await page.keyboard.press('c');
  await page.keyboard.press('u');
  expect(await page.getByLabel('Units').inputValue()).toBe('aviation');
  await page.keyboard.press('t');
  expect(await page.evaluate(() => document.documentElement.dataset.theme)).toBe('light');
  await page.keyboard.press('l');
  await page.getByRole('button', { name: 'Inspetor' }).waitFor();
  expect(await page.evaluate(() => document.documentElement.lang)).toBe('pt-PT');
  await page.keyboard.press('/');
  await page.waitForFunction(() => document.activeElement?.id === 'inspector-filter');
  await page.keyboard.type('2');
  expect(await page.getByLabel('Filtro').inputValue()).toBe('2');
});

it('lists the keys, and closes the list with Escape or its button', async () => {
  const page = await test.open();
  await page.keyboard.press('?');
  const help = page.getByRole('dialog', { name: 'Keys' });
  await help.waitFor();
  expect(await help.locator('kbd').count()).toBe(14);
  await page.keyboard.press('2');
  await page.keyboard.press('Escape');
  await help.waitFor({ state: 'hidden' });
  // The browser tells the page a moment later that the list is closed; until then, keys belong to the list.
  await expect.poll(() => page.keyboard.press('?').then(() => help.isVisible()), { timeout: 20_000 }).toBe(true);
  await help.getByRole('button', { name: 'Close' }).click();
  await help.waitFor({ state: 'hidden' });
  expect(await page.locator('nav [aria-current=page]').textContent()).toBe('Bridge');
});

it('leaves single keys alone when they are switched off', async () => {
  const page = await test.open();
  await page.keyboard.press('?');
  await page.getByLabel('Single keys act at once').uncheck();
  await page.keyboard.press('Escape');
  await page.keyboard.press('2');
  expect(await page.locator('nav [aria-current=page]').textContent()).toBe('Bridge');
});

it('moves through fields with Tab and arrows, and marks what has the focus', async () => {
  const page = await test.open();
  await page
    .getByRole('button', { name: /ATTITUDE/ })
    .first()
    .focus();
  await page.keyboard.press('Enter');
  const side = page.locator('.mavlink-side');
  await side.getByRole('button', { name: 'roll', exact: true }).waitFor();
  await page.keyboard.press('Tab');
  const focused = () => page.evaluate(() => document.activeElement?.textContent?.trim());
  expect(await focused()).toContain('roll');
  await page.keyboard.press('ArrowDown');
  expect(await focused()).toContain('pitch');
  await page.locator('.rule-side', { hasText: 'ATTITUDE pitch' }).waitFor();
});

it('connects and runs the study without a mouse, in Portuguese, in high contrast, on a phone', async () => {
  const page = await test.open({ viewport: { width: 360, height: 740 } });
  await page.locator('.dli-side .hex-bytes').waitFor();
  await page.keyboard.press('l');
  for (const _ of ['light', 'dark', 'contrast']) await page.keyboard.press('t');
  expect(await page.getByLabel('Cores').inputValue()).toBe('contrast');
  await page.keyboard.press('4');
  await tabTo(page, page.getByLabel('Endereço'));
  await page.keyboard.type('pombo-correio');
  await page.keyboard.press('Enter');
  expect(await page.getByRole('alert').textContent()).toContain('pombo-correio');
  await tabTo(page, page.getByRole('button', { name: 'Ligar', exact: true }));
  await page.keyboard.press('3');
  await tabTo(page, page.getByLabel('Amostras'));
  await page.keyboard.press('Control+A');
  await page.keyboard.type('5');
  await page.keyboard.press('Enter');
  await page.getByText('✓ Dentro do limite (500 ms)').waitFor();
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(360);
});
