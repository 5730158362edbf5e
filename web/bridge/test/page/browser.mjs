import { chromium } from 'playwright-core';

/** Debian's Chromium, without anything that would look for a network. */
export function launchBrowser() {
  return chromium.launch({
    executablePath: process.env.PONTE_CHROMIUM ?? '/usr/bin/chromium',
    args: [
      '--headless',
      '--no-sandbox',
      '--disable-gpu',
      '--disable-quic',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
    ],
  });
}
