import { expect, it } from 'vitest';
import { pageTest } from './page_test';

const test = pageTest({ invented: { wrongRoll: true } });

it('sees a wrong mapping, and only that', async () => {
  const page = await test.open();
  await page.locator('[data-instrument=roll]', { hasText: '≠ differ' }).waitFor();
  for (const instrument of ['pitch', 'heading', 'altitude'])
    expect(await page.locator(`[data-instrument=${instrument}]`).textContent()).toContain('✓ agree');
});
