// Takes pictures of the page: npm run screenshots -- FOLDER [ADDRESS], without an address with the mock server's data
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { launchBrowser } from './page/browser.mjs';
import { startServer } from './mock/server.mjs';

const folder = process.argv[2] ?? 'screenshots';
const web = fileURLToPath(new URL('../../../build/web/bridge', import.meta.url));
const views = { 1: 'bridge', 2: 'inspector', 3: 'timing', 4: 'links' };
const screens = { desk: { width: 1440, height: 900 }, phone: { width: 360, height: 740 } };

mkdirSync(folder, { recursive: true });
const server = process.argv[3] === undefined ? await startServer({ port: 0, web }) : undefined;
const address = process.argv[3] ?? `http://127.0.0.1:${server.port}/`;
const browser = await launchBrowser();
for (const [screen, viewport] of Object.entries(screens))
  for (const colorScheme of ['light', 'dark']) {
    const page = await browser.newPage({ viewport, colorScheme });
    await page.goto(address);
    await page.locator('.traveller').nth(1).waitFor({ state: 'attached' });
    for (const [key, view] of Object.entries(views)) {
      await page.keyboard.press(key);
      if (view === 'inspector') await openAndPlot(page);
      if (view === 'timing') await runStudy(page);
      await page.screenshot({ path: join(folder, `${view}-${screen}-${colorScheme}.png`), fullPage: true });
    }
    await page.close();
  }
await browser.close();
await server?.close();

async function openAndPlot(page) {
  await page.locator('.opener', { hasText: 'ATTITUDE' }).first().click();
  await page
    .getByRole('button', { name: /^Plot: ATTITUDE roll / })
    .first()
    .click();
  await page.locator('.charts canvas').waitFor();
  // A few seconds of curve.
  await page.waitForTimeout(4000);
}

async function runStudy(page) {
  await page.getByRole('button', { name: 'Run' }).click();
  await page.getByText('Within the limit').waitFor();
}
