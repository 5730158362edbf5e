// The page of `ponte demo`, judged by readers that know nothing of Ponte's code.
import { spawnSync } from 'node:child_process';
import { createSocket } from 'node:dgram';
import { once } from 'node:events';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Page } from 'playwright-core';
import { afterAll, describe, expect, it, onTestFinished } from 'vitest';
import { pageTest } from './page_test';
import { program, run } from './server';

const reader = fileURLToPath(new URL('independent_reader.py', import.meta.url));
const python = fileURLToPath(new URL('../../../../build/venv/bin/python', import.meta.url));

/** What a ground station hears. */
const heard: string[] = [];
const station = createSocket('udp4', (datagram) => heard.push(datagram.toString('hex')));
station.bind(0, '127.0.0.1');
await once(station, 'listening');
afterAll(() => void station.close());

type Side = 'mavlink' | 'dli';

/** A message as one side of the page shows it. */
interface Pane {
  side: Side;
  hex: string;
  rows: Row[];
}
interface Row {
  field: string;
  aside: string; // the unit, or the bit of the presence vector
  isAbsent: boolean;
  raw: string;
  angle: string; // a binary angle's explanation
  value: string;
}

async function paneOf(page: Page, side: Side): Promise<Pane> {
  const pane = page.locator(`.${side}-side`);
  const hex = (await pane.locator('.hex-bytes').textContent())!.replaceAll(' ', '');
  const rows = await pane.locator('.fields tbody tr').evaluateAll((elements) =>
    elements.map((row) => {
      const [, raw, value] = row.querySelectorAll('td');
      const text = (selector: string) => row.querySelector(selector)?.textContent ?? '';
      return {
        field: row.querySelector('.field-button')!.lastChild!.textContent!,
        aside: text('.aside'),
        isAbsent: row.classList.contains('absent'),
        raw: raw!.firstChild?.textContent ?? '',
        angle: text('.binary-angle'),
        value: value!.textContent!,
      };
    }),
  );
  return { side, hex, rows };
}

/** What the independent readers say of each. */
function judged(panes: Pane[]): Judgement[] {
  const input = panes.map(({ side, hex }) => `${side} ${hex}\n`).join('');
  const { status, stdout, stderr } = spawnSync(python, [reader], { input, encoding: 'utf8' });
  expect(status, stderr).toBe(0);
  // Python's NaN is no JSON.
  return stdout
    .trim()
    .split('\n')
    .map((line) => JSON.parse(line.replaceAll('NaN', '"NaN"')) as Judgement);
}
interface Judgement {
  fields: Record<string, MavlinkValue> & Record<string, DliValue>;
}
type MavlinkValue = number | string | number[];
interface DliValue {
  raw: number | string;
  value: number | null;
  unit: string | null;
}

/** A text with a number says that number, to its last digit. */
function expectNumber(text: string, wanted: number, where: string): void {
  const digits = /^-?\d*\.?(\d*)/.exec(text)!;
  const slack = 0.5001 * 10 ** -digits[1]!.length + Math.abs(wanted) * 1e-12;
  expect(Math.abs(Number(digits[0]) - wanted), `${where}: ${text} and ${wanted}`).toBeLessThanOrEqual(slack);
}

function compareMavlink({ rows }: Pane, { fields }: Judgement): void {
  // Ponte's definitions have extension fields that the package of pymavlink has not.
  expect(rows.map(({ field }) => field)).toEqual(expect.arrayContaining(Object.keys(fields)));
  for (const { field, raw } of rows.filter(({ field }) => field in fields)) {
    const wanted: MavlinkValue = fields[field]!;
    // A float is shown with the digits that tell it from its neighbours.
    if (typeof wanted === 'number') expect([Number(raw), Math.fround(Number(raw))], field).toContain(wanted);
    else expect(raw, field).toBe(typeof wanted === 'string' ? wanted : `[${wanted.join(', ')}]`);
  }
}

function compareDli({ rows }: Pane, { fields }: Judgement): void {
  const present = rows.filter(({ isAbsent }) => !isAbsent);
  expect(present.map(({ aside }) => aside).sort()).toEqual(
    Object.keys(fields)
      .map((bit) => `bit ${bit}`)
      .sort(),
  );
  for (const { field, aside, raw, angle, value } of present) {
    const wanted: DliValue = fields[aside.slice('bit '.length)]!;
    expect(raw, field).toBe(String(wanted.raw));
    if (angle !== '') expectNumber(angle.split('= ')[1]!, (wanted.value! * 180) / Math.PI, field);
    if (wanted.unit === null || wanted.value === null) continue;
    expectNumber(value, wanted.value, field);
    expect(value, field).toContain(wanted.unit.replace('^2', '²'));
  }
}

describe.skipIf(program === undefined)('the program', () => {
  const test = pageTest({ dli: `udpout://127.0.0.1:${station.address().port}` });

  it('shows on both sides what the independent readers find in the bytes that were sent', async () => {
    const page = await test.open();
    // From then on the simulated vehicle knows where it is, and most fields are in use.
    await page.locator('.dli-side .fields tr:not(.absent)', { hasText: 'Latitude' }).waitFor();
    await page.keyboard.press('p');
    await page.getByRole('button', { name: 'Resume' }).waitFor();

    const panes: Pane[] = [];
    for (const flow of await page.getByRole('group', { name: 'Messages that cross' }).locator('.chip').all()) {
      await flow.click();
      await expect.poll(() => flow.getAttribute('aria-pressed')).toBe('true');
      if ((await page.locator('.mavlink-side .fields').count()) > 0) panes.push(await paneOf(page, 'mavlink'));
      const isOwn = (await page.locator('.dli-side .note').count()) === 0;
      if (isOwn && (await page.locator('.dli-side .fields').count()) > 0) panes.push(await paneOf(page, 'dli'));
    }
    const messages = panes.filter(({ side }) => side === 'dli');
    expect(messages.length).toBeGreaterThan(3);
    expect(panes.length - messages.length).toBeGreaterThan(10);
    for (const { hex } of messages) expect(heard.some((datagram) => datagram.includes(hex))).toBe(true);
    judged(panes).forEach((judgement, index) => {
      const pane = panes[index]!;
      (pane.side === 'mavlink' ? compareMavlink : compareDli)(pane, judgement);
    });
  });

  it('connects to a pseudo terminal, shows its vehicle, and disconnects', async () => {
    const folder = mkdtempSync(join(tmpdir(), 'ponte-page-'));
    const serialPort = join(folder, 'tty');
    const sim = run(program!, ['sim', '--pty', serialPort, '--system', '7']);
    onTestFinished(async () => {
      await sim.end();
      rmSync(folder, { recursive: true });
    });
    const page = await test.open();
    await page.getByRole('button', { name: 'Links' }).click();
    await page.getByLabel('Endpoint').fill(`serial://${serialPort}:57600`);
    await page.getByRole('button', { name: 'Connect', exact: true }).click();
    await page.locator('.links li', { hasText: serialPort }).waitFor();
    await page.getByRole('button', { name: 'Bridge' }).click();
    await page.getByRole('button', { name: /14:40:00:07/ }).click();
    await page.locator('.mavlink-side p', { hasText: '7/1' }).waitFor();
    await page.locator('.dli-side p', { hasText: '14:40:00:07 →' }).waitFor();
    await page.getByRole('button', { name: 'Links' }).click();
    await page.getByRole('button', { name: `Disconnect: serial://${serialPort}:57600` }).click();
    await page.locator('.links li', { hasText: serialPort }).waitFor({ state: 'detached' });
    await page.locator('.events li', { hasText: 'Link down' }).filter({ hasText: serialPort }).waitFor();
  });
});
