// Bundles the page into one file: node site/build.mjs WASM_DIRECTORY OUTPUT
import { build } from "esbuild";
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const [wasmDirectory, output] = process.argv.slice(2);
const site = dirname(fileURLToPath(import.meta.url));
const page = join(site, "page");
const data = join(site, "..", "data");
const common = { bundle: true, minify: true, write: false, format: "iife", target: "es2022", charset: "utf8", legalComments: "inline" };

const published = Object.fromEntries(readdirSync(join(data, "published")).filter((f) => f.endsWith(".csv"))
  .map((f) => ["data/published/" + f, readFileSync(join(data, "published", f), "utf8")]));

// Of the replicated studies the two areas and the runs by their number of iterations are all that the page shows.
const [header, ...rows] = readFileSync(join(data, "generated", "replicated_study.csv"), "utf8").trim().split("\n").map((l) => l.split(","));
const column = (name) => rows.map((row) => row[header.indexOf(name)]);
const replicated = {
  sampler: column("sampler").map((s) => (s === "TMCMC" ? 0 : 1)),
  force: column("area_friction_force_n").map((x) => Number(Number(x).toPrecision(5))),
  frequency: column("area_natural_frequency_hz").map((x) => Number(Number(x).toPrecision(5))),
};
const verdicts = readFileSync(join(data, "generated", "verdicts.csv"), "utf8");

const worker = await build({ ...common, entryPoints: [join(page, "worker.ts")] });
const workerSource = readFileSync(join(wasmDirectory, "tmcmc_study.js"), "utf8") + "\n" + worker.outputFiles[0].text;
const main = await build({
  ...common, entryPoints: [join(page, "main.ts")],
  define: {
    WORKER_SOURCE: JSON.stringify(workerSource), PUBLISHED: JSON.stringify(published), REPLICATED: JSON.stringify(replicated),
    VERDICTS: JSON.stringify(verdicts),
  },
});
const style = readFileSync(join(site, "node_modules", "uplot", "dist", "uPlot.min.css"), "utf8") + readFileSync(join(page, "style.css"), "utf8");
const wasm = gzipSync(readFileSync(join(wasmDirectory, "tmcmc_study.wasm")), { level: 9 }).toString("base64");
const fill = (text, place, content) => {
  if (!text.includes(place)) throw new Error("no place " + place);
  return text.replace(place, () => content);
};
let html = readFileSync(join(page, "index.html"), "utf8");
html = fill(html, "/*STYLE*/", style);
html = fill(html, "<!--WASM-->", wasm);
html = fill(html, "/*SCRIPT*/", main.outputFiles[0].text.replace(/<\/script/g, "<\\/script").replace(/<!--/g, "<\\!--"));
writeFileSync(output, html);
console.log(`${output}: ${(html.length / 1e6).toFixed(2)} MB`);
