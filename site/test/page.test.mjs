// The page in a headless Chromium, driven as a reader would. node --test site/test/page.test.mjs, after make site and tools/build.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { address, finished, open } from "./browser.mjs";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const file = join(root, "build/site/index.html");
const bin = (name) => join(root, "build/release/bin", name);
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const directory = mkdtempSync(join(tmpdir(), "page-"));
const parts = ["study", "knobs", "run", "rig", "data", "verdicts"];

let browser, page, complaints;
before(async () => {
  ({ browser, page, complaints } = await open());
});
after(async () => {
  await browser.close();
  rmSync(directory, { recursive: true });
});
const quiet = () => assert.deepEqual(complaints, [], "the console");

/** Opens the page anew at an address. */
async function visit(hash, target = page) {
  await target.goto("about:blank");
  await target.goto(address(file, hash));
}

async function downloaded(name) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click(`[data-csv=${name}]`)]);
  assert.equal(download.suggestedFilename(), name + ".csv");
  return readFileSync(await download.path(), "utf8");
}

function native(words) {
  const paths = Object.fromEntries(["samples", "runs", "stages"].map((name) => [name, join(directory, name + ".csv")]));
  execFileSync(bin("sampling_study"), [...words, "--quiet", "--output", paths.samples, "--runs-output", paths.runs, "--stages-output", paths.stages], { cwd: root });
  return (name) => readFileSync(paths[name], "utf8");
}

/** The one line of an executable that refuses its input. */
function refusal(words) {
  const result = spawnSync(bin("sampling_study"), ["--quiet", ...words], { cwd: directory, encoding: "utf8" });
  assert.equal(result.status, 2, result.stderr);
  return result.stderr.trim().replace(/^sampling_study: error: /, "").replace(/ \(see --help\)$/, "");
}

for (const [hash, words] of [
  ["", []], ["#reading=corrected", ["--reading", "corrected"]], ["#moves=recommended", ["--sampler", "recommended"]],
  ["#seed=3&steps=5&runs=7", ["--seed", "3", "--move-steps", "5", "--runs", "7"]],
  ["#reading=as_worded&runs=5", ["--reading", "as_worded", "--runs", "5"]],
  ["#moves=waste-free&chains=20&ess=0.8&runs=4", ["--move", "waste-free", "--chains", "20", "--cov-target", "0.5", "--ess-fraction", "0.8", "--runs", "4"]],
]) {
  test(`the same bytes as sampling_study ${words.join(" ")}`, async () => {
    await visit(hash);
    await finished(page);
    const expected = native(words);
    for (const name of ["runs", "stages", "samples"]) {
      const bytes = await downloaded(name);
      assert.ok(bytes.length > 1000);
      assert.ok(bytes === expected(name), `${name}.csv differs`);
    }
    quiet();
  });
}

test("the page is one file of at most 3 MB, that asks nothing of the network", async (t) => {
  const bytes = statSync(file).size;
  t.diagnostic(`${(bytes / 1e6).toFixed(2)} MB`);
  assert.ok(bytes <= 3e6);
  assert.doesNotMatch(readFileSync(file, "utf8"), /<(script|link|img)[^>]+(src|href)="(?!data:)/);
});

test("what 100 runs and the first picture take is shown", async (t) => {
  const pictures = [], runs = [];
  for (let i = 0; i < 5; ++i) {
    await visit("#seed=" + (i + 1));
    await page.waitForFunction(() => document.body.dataset.done !== undefined);
    pictures.push(await page.evaluate(() => Number(document.body.dataset.firstPicture)));
    await finished(page);
    runs.push(await page.evaluate(() => Number(document.body.dataset.milliseconds)));
  }
  t.diagnostic(`first picture after ${Math.min(...pictures).toFixed(0)} ms, 100 runs in ${Math.min(...runs).toFixed(0)} ms (best of 5)`);
  assert.ok(Math.min(...runs) > 0 && Math.min(...pictures) > 0);
});

test("part 1: the boxes grow, the printed tables stand beside, another seed is another address, back goes back", async () => {
  await visit("");
  await finished(page);
  const area = () => page.locator("#beside tbody tr:first-child td.mine").first().textContent();
  const first = await area();
  assert.equal(first, "0.08504");
  assert.match(await page.locator("#beside").textContent(), /0\.08151/);
  assert.match(await page.locator("#percentile").textContent(), /of the 2000 replicated/);
  await page.click("#another");
  await finished(page);
  assert.match(page.url(), /seed=2/);
  assert.notEqual(await area(), first);
  await page.goBack();
  await finished(page);
  assert.equal(await page.inputValue("#seed"), "1");
  assert.equal(await area(), first);
  assert.match(await page.locator("#box-force .plot").getAttribute("aria-label"), /area .* N after 50 runs/);
  quiet();
});

test("part 1: a long study is cancelled, and what the library refuses is said as on the command line", async () => {
  await visit("#runs=3000");
  await page.waitForFunction(() => Number(document.body.dataset.done) > 2);
  await page.click("#cancel");
  assert.match(await page.locator("#status").textContent(), /^cancelled after/);
  const done = await page.evaluate(() => document.body.dataset.done);
  await page.waitForTimeout(500);
  assert.equal(await page.evaluate(() => document.body.dataset.done), done);
  assert.ok(await page.locator("[data-csv=runs]").isDisabled());
  await page.fill("#seed", "abc");
  await page.press("#seed", "Enter");
  await page.locator("#refusal").waitFor();
  assert.equal(await page.locator("#refusal").textContent(), refusal(["--seed", "abc", "--runs", "3000"]));
  await visit("#reading=as_worded&steps=5");
  await page.locator("#refusal").waitFor();
  assert.equal(await page.locator("#refusal").textContent(), refusal(["--reading", "as_worded", "--move-steps", "5"]));
  quiet();
});

test("part 2: the criterion changes the cost, the moves change the area", async () => {
  await visit("#part=knobs&runs=20");
  await finished(page);
  await page.locator("#ess").fill("0.8");
  await finished(page);
  assert.match(page.url(), /ess=0\.8/);
  assert.match(await page.locator("#cov-out").textContent(), /50 %/);
  assert.match(await page.locator("#command").textContent(), /--cov-target 0\.5 --ess-fraction 0\.8/);
  await page.locator("#ess").fill("0.5");
  await finished(page);
  await page.locator("#steps").fill("20");
  await finished(page);
  const rows = await page.locator("#tried tbody tr").evaluateAll((all) => all.map((row) => [...row.cells].map((c) => c.textContent)));
  const row = (label) => rows.find((r) => r[0].startsWith(label)).slice(1).map((s) => Number(s.replace(/[\s ]/g, "")));
  const [stages, , area] = row("Neff/N 0.50, 3 steps");
  const [more] = row("Neff/N 0.80, 3 steps");
  const [, , small] = row("Neff/N 0.50, 20 steps");
  assert.ok(more > 1.5 * stages, `${more} stages`);
  assert.ok(small < 0.6 * area, `${small} N`);
  await page.selectOption("#moves", "waste-free");
  await finished(page);
  assert.match(page.url(), /moves=waste-free/);
  await page.goBack();
  await finished(page);
  assert.equal(await page.inputValue("#moves"), "paper");
  assert.equal(await page.inputValue("#steps"), "20");
  quiet();
});

test("part 3: a run goes forward, back and by itself, with the stages of the command line", async () => {
  await visit("#part=run&run=4&sampler=1");
  const stage = () => page.evaluate(() => document.getElementById("part-run").dataset.stage);
  await page.waitForFunction(() => document.getElementById("part-run").dataset.stage === "0");
  await page.click("#forward");
  await page.click("#forward");
  await page.click("#forward");
  assert.equal(await stage(), "3");
  const rows = native([])("stages").split("\n").map((line) => line.split(","));
  const expected = rows.find((r) => r[0] === "TMCMC-II" && r[1] === "4" && r[2] === "3");
  const shown = await page.locator("#stage-table tr").first().locator("td").textContent();
  assert.ok(Math.abs(Number(shown) / Number(expected[3]) - 1) < 0.01, `${shown} is ${expected[3]}`);
  await page.click("#back");
  assert.equal(await stage(), "2");
  await page.focus("#stage");
  await page.keyboard.press("End");
  assert.equal(await stage(), await page.getAttribute("#stage", "max"));
  assert.match(await page.locator("#stage-table").textContent(), /the posterior/);
  await page.click("#first");
  await page.click("#play");
  await page.waitForFunction(() => Number(document.getElementById("part-run").dataset.stage) >= 2);
  await page.click("#play");
  const paused = await stage();
  await page.waitForTimeout(1300);
  assert.equal(await stage(), paused);
  assert.match(page.url(), /stage=\d/);
  quiet();
});

test("part 4: friction bends the phase, and beyond the limit the mass sticks", async () => {
  await visit("#part=rig&ratio=0.5");
  await page.waitForFunction(() => document.getElementById("part-rig").dataset.shown === "0.98 0.5");
  const says = () => page.locator("#rig-says").textContent();
  await page.locator("#friction").fill("0.2");
  await page.waitForFunction(() => document.getElementById("part-rig").dataset.shown === "0.2 0.5");
  assert.match(await says(), /slides all the time/);
  await page.click("[data-friction='1.8']");
  await page.waitForFunction(() => document.getElementById("part-rig").dataset.shown === "1.8 0.5");
  assert.match(await says(), /sticks 2 times a period, for [1-9]\d % of the time/);
  assert.match(page.url(), /friction=1\.8/);
  await page.locator("#friction").fill("2.6");
  await page.waitForFunction(() => document.getElementById("part-rig").dataset.shown === "2.6 0.5");
  assert.match(await says(), /never moves/);
  quiet();
});

async function drop(name, text) {
  await page.evaluate(([name, text]) => {
    document.getElementById("part-data").dataset.state = "";
    const data = new DataTransfer();
    data.items.add(new File([text], name, { type: "text/csv" }));
    document.getElementById("drop").dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
  }, [name, text]);
  await page.waitForFunction(() => ["done", "refused"].includes(document.getElementById("part-data").dataset.state));
}

test("part 5: a CSV that is dropped gives least squares, exact posterior and samples; a bad one the command line's message", async () => {
  await visit("#part=data");
  await page.waitForFunction(() => document.getElementById("part-data").dataset.state === "done");
  const lines = readFileSync(join(root, "data/published/table1_observations.csv"), "utf8").trim().split("\n");
  const good = lines.filter((_, i) => i !== 4).join("\n") + "\n";
  writeFileSync(join(directory, "mine.csv"), good);
  await drop("mine.csv", good);
  const output = join(directory, "exact.csv");
  execFileSync(bin("exact_posterior"), ["--observations", "mine.csv", "--reading", "corrected", "--quiet", "--output", output], { cwd: directory });
  const expected = readFileSync(output, "utf8").trim().split("\n").slice(1).map((l) => l.split(",").slice(1).map(Number));
  const rows = await page.locator("#estimates tbody tr").evaluateAll((all) => all.map((row) => [...row.cells].slice(1).map((c) => Number.parseFloat(c.textContent))));
  rows.forEach(([squares, mean, low, sampled], p) => {
    const [exactMean, sd, q025] = expected[p];
    assert.ok(Math.abs(squares - expected[p].at(-1)) <= 1e-3 * squares, `least squares ${squares}`);
    assert.ok(Math.abs(mean - exactMean) <= 1e-3 * mean, `mean ${mean}`);
    assert.ok(Math.abs(low - q025) <= 1e-3 * low, `quantile ${low}`);
    assert.ok(Math.abs(sampled - exactMean) < 0.5 * sd, `samples ${sampled}`);
  });
  assert.match(await page.locator("#data-says").textContent(), /^9 observations/);
  for (const [name, text] of [
    ["bad.csv", lines.map((l, i) => (i === 3 ? l.replace("27.739", "abc") : l)).join("\n")],
    ["singular.csv", lines.map((l, i) => (i === 3 ? "3,1.0,1.0,2.945,27.739" : l)).join("\n")],
    ["semicolons.csv", lines.join("\n").replaceAll(",", ";")], ["empty.csv", ""],
    ["ragged.csv", lines.join("\n") + "\n11,2.0"], ["huge.csv", lines.join("\n").replace("149.947", "1e400")],
  ]) {
    writeFileSync(join(directory, name), text);
    await drop(name, text);
    assert.equal(await page.locator("#data-refusal").textContent(), refusal(["--observations", name]), name);
  }
  assert.ok(await page.locator("#data-results").isHidden());
  await page.click("#table1");
  await page.locator("#data-results").waitFor();
  quiet();
});

test("part 6: each verdict leads to what shows it", async () => {
  await visit("#part=verdicts");
  const claims = readFileSync(join(root, "data/generated/verdicts.csv"), "utf8").trim().split("\n").length - 1;
  assert.equal(await page.locator(".verdict").count(), claims);
  const links = await page.locator("#part-verdicts a[href^='..']").evaluateAll((all) => all.map((a) => a.getAttribute("href")));
  assert.ok(links.length > 5);
  for (const link of links) assert.ok(existsSync(join(dirname(file), link)), link);
  await page.getByRole("link", { name: "See the curve at 1.086 N" }).click();
  await page.waitForFunction(() => document.getElementById("part-rig").dataset.shown === "1.086 0.79");
  assert.equal(await page.evaluate(() => document.activeElement.id), "h-rig");
  await page.goBack();
  assert.ok(await page.locator("#part-verdicts").isVisible());
  quiet();
});

test("the keyboard alone goes through the parts", async () => {
  await visit("#part=rig");
  await page.keyboard.press("Tab");
  assert.equal(await page.evaluate(() => document.activeElement.id), "skip");
  for (let i = 0; i < 2; ++i) await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");
  assert.ok(await page.locator("#part-knobs").isVisible());
  quiet();
});

async function settled(target, part) {
  if (part === "study" || part === "knobs") await finished(target);
  if (part === "run") await target.waitForFunction(() => document.getElementById("part-run").dataset.stage !== undefined);
  if (part === "rig") await target.waitForFunction(() => document.getElementById("part-rig").dataset.shown !== undefined);
  if (part === "data") await target.waitForFunction(() => document.getElementById("part-data").dataset.state === "done");
}

for (const colorScheme of ["light", "dark"]) {
  test(`axe finds nothing serious, and nothing is wider than a phone of 360 px (${colorScheme})`, async (t) => {
    const phone = await open({ colorScheme, viewport: { width: 360, height: 740 } });
    for (const part of parts) {
      await visit(`#part=${part}&runs=5`, phone.page);
      await settled(phone.page, part);
      const width = await phone.page.evaluate(() => document.scrollingElement.scrollWidth);
      assert.ok(width <= 360, `${part}: ${width} px`);
      await phone.page.evaluate(axe);
      const { violations } = await phone.page.evaluate(() => axe.run());
      const serious = violations.filter((v) => v.impact === "serious" || v.impact === "critical");
      assert.deepEqual(serious.map((v) => [part, v.id, v.nodes.map((n) => n.html.slice(0, 120))]), []);
      for (const v of violations) t.diagnostic(`${part}: ${v.impact}: ${v.id}`);
    }
    assert.deepEqual(phone.complaints, []);
    await phone.browser.close();
  });
}
