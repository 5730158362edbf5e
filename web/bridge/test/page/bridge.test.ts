import { expect, it } from 'vitest';
import { pageTest } from './page_test';

const test = pageTest();

const bytesOf = (text: string) => Buffer.from(text.replaceAll(' ', ''), 'hex');

it('shows both sides, and both move', async () => {
  const page = await test.open();
  for (const side of ['.mavlink-side', '.dli-side']) {
    const bytes = page.locator(`${side} .hex-bytes`);
    const before = await bytes.textContent();
    await page.waitForFunction(
      ([selector, text]) => document.querySelector(`${selector} .hex-bytes`)?.textContent !== text,
      [side, before] as const,
    );
  }
});

it('marks the bytes of a field and of its partner, and they say the same', async () => {
  const page = await test.open();
  await page
    .getByRole('button', { name: /ATTITUDE/ })
    .first()
    .click();
  await page.locator('.dli-side h3', { hasText: '#4000' }).waitFor();
  await page.locator('.mavlink-side').getByRole('button', { name: 'roll', exact: true }).hover();
  // A message may leave an unchanged roll out: wait for one that has it, of the same
  // event (there is no note that says otherwise), and read both sides at one moment.
  const marks = await page.waitForFunction(() => {
    const mark = (side: string) => document.querySelector(`${side} mark`)?.textContent;
    const [mavlink, dli] = [mark('.mavlink-side'), mark('.dli-side')];
    const isSameEvent = document.querySelector('.dli-side .note') === null;
    return mavlink && dli && isSameEvent ? { mavlink, dli } : undefined;
  });
  const { mavlink, dli } = (await marks.jsonValue())!;
  const difference = bytesOf(mavlink).readFloatLE() - (bytesOf(dli).readInt16BE() * Math.PI) / 32768;
  expect(Math.abs(difference)).toBeLessThan(Math.PI / 32768);
  expect(await page.locator('.bits .marked').textContent()).toContain('Roll');
  expect(await page.locator('.rule-side').textContent()).toMatch(
    /ATTITUDE roll.*fact roll rad.*#4000 Roll.*Confidence.*standard/s,
  );
});

it('shows presence bits, wrapper and binary angles', async () => {
  const page = await test.open();
  await page
    .getByRole('button', { name: /ATTITUDE/ })
    .first()
    .click();
  const side = page.locator('.dli-side');
  await side.getByText('BAM 0x').first().waitFor();
  expect(await side.locator('.bits li').count()).toBe(24);
  expect(await side.getByRole('row', { name: /Message Type/ }).textContent()).toContain('0f a04000');
  expect(await side.locator('.bits .set').first().textContent()).toMatch(/^1bit \d+: .+, present$/);
});

it('finds that both sides agree', async () => {
  const page = await test.open();
  for (const instrument of ['roll', 'pitch', 'heading', 'altitude', 'speed', 'climb'])
    await page.locator(`[data-instrument=${instrument}]`, { hasText: '✓ agree' }).waitFor();
});

it('opens and closes the bridge with the switch', async () => {
  const page = await test.open();
  const convert = page.getByRole('switch', { name: 'Convert' });
  await page.locator('.dli-side .hex-bytes').waitFor();
  await convert.click();
  await page.locator('.bridge-drawing.is-open').waitFor({ state: 'attached' });
  await page.getByText('Conversion is off.').waitFor();
  expect(await convert.getAttribute('aria-checked')).toBe('false');
  await convert.click();
  await page.locator('.bridge-drawing:not(.is-open)').waitFor({ state: 'attached' });
  await page.getByText('Conversion is off.').waitFor({ state: 'detached' });
});
