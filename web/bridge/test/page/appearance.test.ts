import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import type { Page } from 'playwright-core';
import { expect, it } from 'vitest';
import { pageTest } from './page_test';

const test = pageTest();
const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

async function violations(page: Page): Promise<string[]> {
  await page.evaluate(axe);
  return page.evaluate(async () => {
    const run = (globalThis as unknown as { axe: { run: () => Promise<{ violations: AxeViolation[] }> } }).axe.run;
    return (await run()).violations.map(
      ({ id, impact, nodes }) => `${impact} ${id}: ${nodes.map(({ html }) => html).join(' ')}`,
    );
  });
}
interface AxeViolation {
  id: string;
  impact: string;
  nodes: { html: string }[];
}

for (const theme of ['light', 'dark', 'contrast'])
  for (const [key, view] of [
    ['1', 'bridge'],
    ['2', 'inspector'],
    ['3', 'timing'],
    ['4', 'links'],
  ] as const)
    it(`has no barrier that axe knows: ${view}, ${theme}`, async () => {
      const page = await test.open({ reducedMotion: 'reduce' });
      await page.locator('.dli-side .hex-bytes').waitFor();
      await page.getByLabel('Colours').selectOption(theme);
      await page.locator('body').click({ position: { x: 2, y: 2 } });
      await page.keyboard.press(key);
      if (view === 'inspector') await page.locator('.opener').first().click();
      await page.keyboard.press('p');
      expect(await violations(page)).toEqual([]);
    });

for (const key of ['1', '2', '3', '4'])
  it(`fits a phone: view ${key}`, async () => {
    const page = await test.open({ viewport: { width: 360, height: 740 } });
    await page.locator('.dli-side .hex-bytes').waitFor();
    await page.keyboard.press(key);
    await page.locator('main h2').first().waitFor();
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(360);
  });

it('follows the system between light and dark', async () => {
  const paper = async (colorScheme: 'light' | 'dark') => {
    const page = await test.open({ colorScheme });
    return page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
  };
  expect(await paper('light')).not.toBe(await paper('dark'));
});

it('keeps still for those who want that', async () => {
  const page = await test.open({ reducedMotion: 'reduce' });
  await page.locator('.traveller').first().waitFor({ state: 'attached' });
  expect(await page.locator('.traveller').first().isVisible()).toBe(false);
});

it('remembers language, units and colours', async () => {
  const page = await test.open();
  await page.getByLabel('Units').selectOption('nautical');
  await page.getByLabel('Colours').selectOption('dark');
  await page.getByLabel('Language').selectOption('pt');
  await page.reload();
  expect(await page.getByLabel('Unidades').inputValue()).toBe('nautical');
  expect(await page.getByLabel('Cores').inputValue()).toBe('dark');
});
