import { defineConfig } from 'vitest/config';

export default defineConfig({
  test: {
    fileParallelism: false,
    projects: [
      { test: { name: 'unit', include: ['src/**/*.test.ts', 'test/contract/*.test.ts'], testTimeout: 60_000 } },
      // A real browser against a server.
      { test: { name: 'page', include: ['test/page/*.test.ts'], testTimeout: 120_000, hookTimeout: 120_000 } },
    ],
  },
});
