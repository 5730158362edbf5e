// For bench/page.py: opens the page at an address and goes round its views, with a plot and the curves of the times.
// For each line of stdin, one of stdout: {"bytes": what the page's script holds after a garbage collection}.
import { createInterface } from 'node:readline';
import { launchBrowser } from './page/browser.mjs';

const browser = await launchBrowser();
const page = await browser.newPage();
await page.goto(process.argv[2]);
const devtools = await page.context().newCDPSession(page);
await devtools.send('Performance.enable');
await page.locator('.dli-side .hex-bytes').waitFor();
await page.keyboard.press('2');
await page.locator('.opener', { hasText: 'ATTITUDE' }).first().click();
await page
  .getByRole('button', { name: /^Plot: ATTITUDE roll / })
  .first()
  .click();

let turn = 0;
let isMeasuring = false;
const tour = setInterval(() => {
  if (!isMeasuring) void page.keyboard.press(String(1 + (turn++ % 4)));
}, 5000);

for await (const _ of createInterface({ input: process.stdin })) {
  isMeasuring = true;
  await page.keyboard.press('1');
  // What the view before has left is let go of.
  await page.waitForTimeout(2000);
  for (let pass = 0; pass < 2; ++pass) await devtools.send('HeapProfiler.collectGarbage');
  const { metrics } = await devtools.send('Performance.getMetrics');
  console.log(JSON.stringify({ bytes: metrics.find(({ name }) => name === 'JSHeapUsedSize').value }));
  isMeasuring = false;
}
clearInterval(tour);
await browser.close();
