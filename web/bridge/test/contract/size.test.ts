import { readdirSync, readFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { expect, it } from 'vitest';

const folder = new URL('../../../../build/web/bridge/', import.meta.url);
const budget = 250_000;

it('loads in less than 250 kB of compressed bytes, charts included', () => {
  const files = readdirSync(folder, { recursive: true, encoding: 'utf8' }).filter((name) =>
    /\.(html|js|css|svg)$/.test(name),
  );
  const sizes = files.map((name) => gzipSync(readFileSync(new URL(name, folder))).length);
  expect(files.length).toBeGreaterThanOrEqual(5);
  expect(sizes.reduce((sum, size) => sum + size, 0)).toBeLessThan(budget);
});

it('has nothing inline that the Content-Security-Policy would refuse', () => {
  const html = readFileSync(new URL('index.html', folder), 'utf8');
  expect(html).not.toMatch(/<style|style=|\son\w+=|<script(?![^>]*\ssrc=)/);
});
