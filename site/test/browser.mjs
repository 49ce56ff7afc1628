// Debian's Chromium with the page open, and what it complains of.
import { chromium } from "playwright-core";
import { pathToFileURL } from "node:url";

export async function open(options = {}) {
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"],
  });
  const context = await browser.newContext({ viewport: { width: 1180, height: 900 }, acceptDownloads: true, ...options });
  const page = await context.newPage();
  const complaints = [];
  page.on("console", (message) => {
    if (message.type() === "error" || message.type() === "warning") complaints.push(message.text());
  });
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("request", (request) => {
    if (/^https?:/.test(request.url())) complaints.push("a request to the network: " + request.url());
  });
  page.setDefaultTimeout(120000);
  return { browser, context, page, complaints };
}

export const address = (file, hash = "") => pathToFileURL(file).href + hash;

/** Waits until the study of the page is complete. */
export async function finished(page, timeout = 180000) {
  await page.waitForFunction(() => document.body.dataset.finished !== undefined, undefined, { timeout });
}
