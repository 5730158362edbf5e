import type { Browser, BrowserContextOptions, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, expect } from 'vitest';
import { launchBrowser } from './browser.mjs';
import { PageServer, type Options } from './server';

export interface OpenOptions extends BrowserContextOptions {
  path?: string; // with the part behind #
  prepare?: (page: Page) => Promise<void>; // before the page is loaded
}

/** What a test file works with: a server, and pages in a browser that all have to stay free of errors. */
export interface PageTest {
  server: PageServer;
  open: (options?: OpenOptions) => Promise<Page>;
}

/** Prepares the tests of the calling file. */
export function pageTest(options: Options = {}): PageTest {
  const test = {} as PageTest;
  let browser: Browser;
  let complaints: string[] = [];

  beforeAll(async () => {
    test.server = await PageServer.start(options);
    browser = await launchBrowser();
  });
  afterAll(async () => {
    await browser?.close();
    await test.server?.close();
  });
  afterEach(async () => {
    for (const context of browser.contexts()) await context.close();
    const seen = complaints;
    complaints = [];
    expect(seen).toEqual([]);
  });

  test.open = async ({ path = '', prepare, ...contextOptions } = {}) => {
    const page = await browser.newPage({ viewport: { width: 1280, height: 900 }, ...contextOptions });
    page.setDefaultTimeout(50_000);
    page.on('pageerror', (error) => complaints.push(String(error)));
    page.on('request', (request) => {
      if (!request.url().startsWith(test.server.url)) complaints.push(`asked elsewhere: ${request.url()}`);
    });
    page.on('console', (message) => {
      if (message.text().includes('Content Security Policy')) complaints.push(message.text());
    });
    await prepare?.(page);
    await page.goto(test.server.url + path);
    return page;
  };
  return test;
}
