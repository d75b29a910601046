// Draws docs/viewer.png and the like: opens a page, presses keys, saves what is seen.
// usage: node screenshot.mjs PAGE.html PICTURE.png [KEY]...
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [page_path, picture, ...keys] = process.argv.slice(2);
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const page = await browser.newPage({ viewport: { width: 1200, height: 675 }, deviceScaleFactor: 2 });
await page.goto(pathToFileURL(resolve(page_path)).href);
for (const key of keys) await page.keyboard.press(key);
await page.waitForTimeout(3000);
await page.screenshot({ path: picture, scale: "css" });
await browser.close();
