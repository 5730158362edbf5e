import { readFile } from 'node:fs/promises';
import { expect, it } from 'vitest';
import { pageTest } from './page_test';

const test = pageTest();

it('shows stages, percentiles, histogram and the live chart', async () => {
  const page = await test.open();
  await page.getByRole('button', { name: 'Timing' }).click();
  await page.locator('.chart canvas').waitFor();
  await page.locator('.histogram rect').first().waitFor();
  for (const stage of ['Decode', 'Translate', 'Send', 'Total'])
    expect(
      await page
        .locator('.stages')
        .getByRole('row', { name: new RegExp(`^${stage}`) })
        .textContent(),
    ).toMatch(/\d.[nµm]s/);
});

it('runs the latency study and downloads it', async () => {
  const page = await test.open();
  await page.getByRole('button', { name: 'Timing' }).click();
  await page.getByLabel('Samples').fill('10');
  await page.getByRole('button', { name: 'Run' }).click();
  await page.getByText('✓ Within the limit (500 ms)').waitFor();
  expect(await page.getByRole('row', { name: /^Mean/ }).textContent()).toMatch(/\d/);
  for (const format of ['JSON', 'CSV', 'HTML']) {
    const [download] = await Promise.all([
      page.waitForEvent('download'),
      page.getByRole('link', { name: format }).click(),
    ]);
    expect(download.suggestedFilename()).toBe(`ponte-latency.${format.toLowerCase()}`);
    const text = await readFile(await download.path(), 'utf8');
    expect(text.length).toBeGreaterThan(0);
    if (format === 'JSON') expect(JSON.parse(text).samples).toHaveLength(10);
  }
});
