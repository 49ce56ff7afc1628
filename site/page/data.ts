// Part 5: the reader's own measurements.
import { Chart } from "./charts";
import { digits, element, plain } from "./dom";
import type { Page, Shown } from "./part";

declare const PUBLISHED: Record<string, string>;

const names = ["friction force F<sub>μ</sub>", "natural frequency ω<sub>n</sub>", "phase noise σ<sub>phase</sub>", "ratio noise σ<sub>r</sub>"];
const axes = ["friction force (N)", "natural frequency (Hz)", "noise of the phase (deg)", "noise of the ratio (1)"];
const units = ["N", "Hz", "deg", ""];
const table1 = PUBLISHED["data/published/table1_observations.csv"]!;
const table2 = PUBLISHED["data/published/table2_prior.csv"]!;
const bins = 40;

export function dataPart(page: Page): Shown {
  const { engine } = page;
  const text = (id: string) => element<HTMLTextAreaElement>(id);
  let fileName = "measurements.csv";
  let charts: Chart[] = [];
  text("csv").value = table1;
  text("prior").value = table2;

  function makeCharts(): void {
    if (charts.length) return;
    charts = names.map((name, p) => new Chart(element("marginal-" + p), {
      title: name[0]!.toUpperCase() + name.slice(1), x: axes[p]!, y: "density" + (units[p] ? ` (1/${units[p]})` : ""), height: 230,
      lines: [{ label: "exact posterior", colour: "exact", width: 2.4 }, { label: "samples of one run", colour: "tmcmc", width: 1.4, fill: "fill1" }, { label: "least squares", colour: "printed", points: "diamond" }],
    }));
  }

  async function analyse(): Promise<void> {
    const refusal = element("data-refusal");
    const warning = element("data-warning");
    const results = element("data-results");
    refusal.hidden = warning.hidden = true;
    element("part-data").dataset.state = "busy";
    engine.takeWarnings();
    try {
      await engine.call("writeFile", fileName, text("csv").value);
      const words = ["--observations", fileName, "--reading", "corrected", "--sampler", "recommended", "--runs", "1", "--driving-force", element<HTMLInputElement>("force").value.trim()];
      if (text("prior").value.trim() !== table2.trim()) {
        await engine.call("writeFile", "prior.csv", text("prior").value);
        words.push("--prior", "prior.csv");
      }
      await engine.call("begin", 2, words);
      const observations = await engine.call("observations", fileName);
      const warnings = [...new Set(engine.takeWarnings())];
      const exact = await engine.call("exactPosterior", words, 400);
      const fit = await engine.call("leastSquares", words);
      await engine.call("run", 2, 1);
      const samples = await Promise.all([0, 1, 2, 3].map((p) => engine.call("samples", 2, 1, p)));
      engine.takeWarnings();
      results.hidden = false;
      makeCharts();
      if (warnings.length) {
        warning.textContent = warnings.join(" ");
        warning.hidden = false;
      }
      const fits = [fit.frictionForce.estimate, fit.naturalFrequency.estimate, fit.frictionForce.noise, fit.naturalFrequency.noise];
      const errors = [fit.frictionForce.standardError, fit.naturalFrequency.standardError, NaN, NaN];
      let rows = "";
      exact.marginals.forEach((m, p) => {
        const s = samples[p]!;
        const mean = s.reduce((a, b) => a + b, 0) / s.length;
        const sd = Math.sqrt(s.reduce((a, b) => a + (b - mean) ** 2, 0) / (s.length - 1));
        rows += `<tr><th scope="row">${names[p]}${units[p] ? ` (${units[p]})` : ""}</th><td>${digits(fits[p]!, 4)}${Number.isNaN(errors[p]!) ? "" : " ± " + digits(errors[p]!, 2)}</td>
          <td>${digits(m.mean, 4)} ± ${digits(m.sd, 2)}</td><td>${digits(m.low, 4)} to ${digits(m.high, 4)}</td><td>${digits(mean, 4)} ± ${digits(sd, 2)}</td></tr>`;
        // Bins of the samples on the range of the exact posterior; bounds of a bin are places of the chart.
        const [low, high] = [m.x[0]!, m.x[m.x.length - 1]!];
        const counts = new Array<number>(bins).fill(0);
        for (const v of s) {
          const k = Math.floor((v - low) / (high - low) * bins);
          if (k >= 0 && k < bins) counts[k]!++;
        }
        const density = counts.map((c) => c / s.length * bins / (high - low));
        const at = Array.from(m.x, (x) => density[Math.min(bins - 1, Math.floor((x - low) / (high - low) * bins))]!);
        const nearest = m.x.findIndex((x) => x >= fits[p]!);
        charts[p]!.set([m.x, m.density, at, Array.from(m.x, (_, i) => (i === nearest ? 0 : null))],
          `Exact posterior ${plain(m.mean, 4)} ± ${plain(m.sd, 2)} ${units[p]}, samples ${plain(mean, 4)} ± ${plain(sd, 2)}, least squares ${plain(fits[p]!, 4)}.`);
      });
      element("estimates").innerHTML = `<thead><tr><td></td><th scope="col">least squares</th><th scope="col">exact mean ± sd</th><th scope="col">exact 95 %</th><th scope="col">samples of one run</th></tr></thead><tbody>${rows}</tbody>`;
      element("data-says").textContent = `${observations.phaseDeg.length} observations; log-evidence ${plain(exact.logEvidence, 5)} (exact). Correct mathematics, ${fit.frictionForce.atBound ? "the best friction force lies at the end of its range: the least-squares error means little. " : ""}prior of ${words.includes("--prior") ? "yours" : "Table 2"}.`;
      element("part-data").dataset.state = "done";
    } catch (error) {
      results.hidden = true;
      refusal.textContent = (error as Error).message;
      refusal.hidden = false;
      element("part-data").dataset.state = "refused";
    }
  }

  async function take(file: File): Promise<void> {
    text("csv").value = await file.text();
    fileName = file.name.replace(/[/\\]/g, "_") || "measurements.csv";
    element("file-name").textContent = fileName;
    await analyse();
  }
  const drop = element("drop");
  drop.addEventListener("dragover", (event) => {
    event.preventDefault();
    drop.classList.add("over");
  });
  drop.addEventListener("dragleave", () => drop.classList.remove("over"));
  drop.addEventListener("drop", (event) => {
    event.preventDefault();
    drop.classList.remove("over");
    const file = event.dataTransfer?.files[0];
    if (file) void take(file);
  });
  element<HTMLInputElement>("file").addEventListener("change", (event) => {
    const file = (event.target as HTMLInputElement).files?.[0];
    if (file) void take(file);
  });
  element("table1").addEventListener("click", () => {
    text("csv").value = table1;
    text("prior").value = table2;
    fileName = "measurements.csv";
    element("file-name").textContent = "";
    void analyse();
  });
  element("own").addEventListener("submit", (event) => {
    event.preventDefault();
    void analyse();
  });

  let first = true;
  return {
    show() {
      if (first) void analyse();
      first = false;
    },
  };
}
