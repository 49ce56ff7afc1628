// The pictures in docs/site: node site/test/screenshots.mjs, after make site.
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { address, finished, open } from "./browser.mjs";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const file = join(root, "build/site/index.html");
const { browser, page } = await open({ viewport: { width: 1080, height: 800 } });
const state = (id, name) => page.waitForFunction(([id, name]) => document.getElementById(id).dataset[name] !== undefined, [id, name]);
const views = {
  study: ["", () => finished(page)],
  knobs: ["#part=knobs&runs=10", async () => {
    await finished(page);
    for (const [id, value] of [["ess", "0.8"], ["ess", "0.5"], ["steps", "20"]]) {
      await page.locator("#" + id).fill(value);
      await finished(page);
    }
    await page.selectOption("#moves", "recommended");
    await finished(page);
  }],
  run: ["#part=run&run=3&stage=6", () => page.waitForFunction(() => document.getElementById("part-run").dataset.stage === "6")],
  rig: ["#part=rig&friction=1.25&ratio=0.5", () => state("part-rig", "shown")],
  data: ["#part=data", () => page.waitForFunction(() => document.getElementById("part-data").dataset.state === "done")],
  verdicts: ["#part=verdicts", () => page.waitForTimeout(100)],
};
const wanted = process.argv.slice(2);
for (const [name, [hash, ready]] of Object.entries(views)) {
  if (wanted.length && !wanted.includes(name)) continue;
  await page.goto("about:blank");
  await page.goto(address(file, hash));
  await ready();
  await page.waitForTimeout(400);
  await page.screenshot({ path: join(root, "docs/site", name + ".png"), fullPage: name !== "verdicts" });
}
await browser.close();
