// Parts 1 and 2: the study, beside the printed one, and what its settings change.
import type uPlot from "uplot";
import { Chart, colour, mark, write, type Line } from "./charts";
import { deviation, digits, download, element, escape, mean, plain, rowsOf } from "./dom";
import type { Page, Shown } from "./part";
import type { ExactPosterior, StudyProgress } from "./protocol";
import { covOf, defaults, wordsOf, type State } from "./state";

declare const PUBLISHED: Record<string, string>;
declare const REPLICATED: { sampler: number[]; force: number[]; frequency: number[] };

const floor = 0.0075; // N, of 50 sets of 1000 independent draws: data/generated/pbox_floor_summary.csv

const printedAreas = rowsOf(PUBLISHED["data/published/table3_pbox_area.csv"]!);
const printedCounts = rowsOf(PUBLISHED["data/published/table4_iteration_counts.csv"]!);

interface Tried {
  key: string;
  label: string;
  evaluations: number;
  area: number;
  stages: number;
  evidence: number;
}

const boxLines: Line[] = [
  { label: "TMCMC", colour: "tmcmc" }, { label: "", colour: "tmcmc", legend: false },
  { label: "TMCMC-II", colour: "tmcmc2", dash: [7, 4] }, { label: "", colour: "tmcmc2", dash: [7, 4], legend: false },
  { label: "exact posterior", colour: "exact", dash: [2, 3] },
  { label: "both, with the paper's settings", colour: "muted", width: 1.2 }, { label: "", colour: "muted", width: 1.2, legend: false },
];

function interpolate(x: ArrayLike<number>, y: ArrayLike<number>, at: number): number {
  if (at <= x[0]!) return 0;
  const last = x.length - 1;
  if (at >= x[last]!) return 1;
  const i = Math.min(last - 1, Math.floor((at - x[0]!) / (x[last]! - x[0]!) * last));
  const share = (at - x[i]!) / (x[i + 1]! - x[i]!);
  return y[i]! + share * (y[i + 1]! - y[i]!);
}

function describe(state: State): string {
  const moves = state.moves === "paper" ? (state.reading === "as_worded" ? "growing chains" : `${state.steps} steps`)
    : state.moves === "waste-free" ? `${state.chains} long chains` : "recommended";
  const seed = state.seed === defaults.seed ? "" : `, seed ${state.seed}`;
  const reading = state.reading === defaults.reading ? "" : `, ${state.reading.replace("_", " ")}`;
  const runs = state.runs === defaults.runs ? "" : `, ${state.runs} runs`;
  return `N_eff/N ${Number(state.ess).toFixed(2)}, ${moves}${reading}${runs}${seed}`;
}

function hasPapersSettings(words: string[]): boolean {
  return words.every((word, i) => i % 2 === 1 || word === "--seed");
}

export function studyParts(page: Page): Shown {
  const { engine } = page;
  const input = (id: string) => element<HTMLInputElement>(id);
  const select = (id: string) => element<HTMLSelectElement>(id);
  let progress: StudyProgress | null = null;
  let shownWords = ""; // of the study that was asked for last
  let exact: ExactPosterior | null = null;
  let exactOf = "";
  const tried: Tried[] = [];
  /** The hull of both boxes at the paper's settings, whatever the seed: what others are seen against. */
  let paper: { x: ArrayLike<number>; lower: number[]; upper: number[] }[] = [];

  const boxBands = [{ between: [2, 1] as [number, number], colour: "fill1" }, { between: [4, 3] as [number, number], colour: "fill2" }];
  const boxes = [
    new Chart(element("box-force"), { title: "p-box of the friction force F<sub>μ</sub>", x: "friction force (N)", y: "share of samples below", lines: boxLines, bands: boxBands, yRange: [0, 1] }),
    new Chart(element("box-frequency"), { title: "p-box of the natural frequency ω<sub>n</sub>", x: "natural frequency (Hz)", y: "share of samples below", lines: boxLines, bands: boxBands, yRange: [0, 1] }),
  ];

  // Where a study lies in 1000 of each sampler.
  const sorted = [0, 1].map((s) => REPLICATED.force.filter((_, i) => REPLICATED.sampler[i] === s).sort((a, b) => a - b));
  const all = [...REPLICATED.force].sort((a, b) => a - b);
  const below = (value: number) => 100 * all.filter((a) => a < value).length / all.length;
  const marks = (u: uPlot) => {
    const { ctx } = u;
    const ratio = devicePixelRatio || 1;
    const entries: { value: number; y: number; name: string; arm: number; mine: boolean }[] = [];
    printedAreas.forEach((row, arm) => entries.push({ value: Number(row.friction_force_n), y: 0.2 + 0.14 * arm, name: "printed", arm, mine: false }));
    if (progress?.finished) progress.areas.forEach((area, arm) => entries.push({ value: area[0]!, y: 0.52 + 0.14 * arm, name: "yours", arm, mine: true }));
    ctx.save();
    ctx.font = `${12 * ratio}px system-ui, sans-serif`;
    ctx.textBaseline = "middle";
    for (const e of entries) {
      const x = u.valToPos(Math.min(e.value, u.scales.x!.max!), "x", true);
      const y = u.bbox.top + u.bbox.height * (1 - e.y);
      ctx.fillStyle = ctx.strokeStyle = colour(e.arm ? "tmcmc2" : "tmcmc");
      ctx.lineWidth = 1.2 * ratio;
      ctx.setLineDash([2 * ratio, 3 * ratio]);
      ctx.beginPath(); ctx.moveTo(x, y); ctx.lineTo(x, u.bbox.top + u.bbox.height); ctx.stroke();
      ctx.setLineDash([]);
      mark(ctx, e.mine ? "dot" : "diamond", x, y, 4.5 * ratio);
      const text = `${e.name}, ${e.arm ? "TMCMC-II" : "TMCMC"}`;
      const right = x + ctx.measureText(text).width + 12 * ratio < u.bbox.left + u.bbox.width;
      ctx.textAlign = right ? "left" : "right";
      write(ctx, text, x + (right ? 9 : -9) * ratio, y);
    }
    ctx.restore();
  };
  const nullChart = new Chart(element("null-force"), {
    title: "Area of F<sub>μ</sub> in 1000 replicated studies of each sampler", x: "p-box area of the friction force (N)", y: "share of studies below",
    lines: [{ label: "TMCMC", colour: "tmcmc" }, { label: "TMCMC-II", colour: "tmcmc2", dash: [7, 4] }, { label: "printed", colour: "printed", points: "diamond", legend: true }],
    yRange: [0, 1], xRange: [0, 0.32], draw: marks,
  });
  const showNull = () => {
    const x = Array.from({ length: 321 }, (_, i) => i / 1000);
    const curve = (s: number) => x.map((v) => sorted[s]!.filter((a) => a < v).length / sorted[s]!.length);
    nullChart.set([x, curve(0), curve(1), x.map(() => null)],
      "The distributions of both samplers coincide. Printed: 0.0815 N for TMCMC and 0.171 N for TMCMC-II.");
  };
  showNull();

  const cost = new Chart(element("cost"), {
    title: "What each setting costs and gives", x: "likelihood evaluations a run", y: "area of F_μ (N)",
    lines: [{ label: "a setting you tried", colour: "tmcmc", points: "circle" }, { label: "this one", colour: "tmcmc2", points: "diamond" }, { label: "floor of independent draws", colour: "exact", dash: [2, 3] }],
    xLog: true, yLog: true, xRange: [8000, 800000], yRange: [0.005, 1], height: 300,
    xSplits: [10000, 20000, 50000, 100000, 200000, 500000], ySplits: [0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1],
    values: (v) => (v >= 1000 ? `${v / 1000}k` : String(v)),
  });

  async function showExact(state: State): Promise<void> {
    if (exactOf === state.reading) return;
    exactOf = state.reading;
    const words = state.reading === defaults.reading ? [] : ["--reading", state.reading];
    try {
      exact = await engine.call("exactPosterior", words, 800);
      if (progress) drawBoxes(progress);
    } catch { exact = null; }
  }

  function drawBoxes(p: StudyProgress): void {
    p.boxes.forEach((box, parameter) => {
      const m = exact?.marginals[parameter];
      const cdf = Array.from(box[0]!, (x) => (m ? interpolate(m.x, m.cdf, x) : null));
      const tidy = (line: Float64Array) => Array.from(line, (v) => (Number.isNaN(v) ? null : v));
      const unit = parameter ? "Hz" : "N";
      const old = page.state.part === "knobs" ? paper[parameter] : undefined;
      const ghost = (side: "lower" | "upper") => Array.from(box[0]!, (x) => (old ? interpolate(old.x, old[side], x) : null));
      boxes[parameter]!.set([box[0]!, tidy(box[1]!), tidy(box[2]!), tidy(box[3]!), tidy(box[4]!), cdf, ghost("lower"), ghost("upper")],
        p.arms.map((a, i) => `${a}: area ${plain(p.areas[i]![parameter]!)} ${unit} after ${p.done[i]} runs`).join("; ") + ".");
    });
  }

  function table(p: StudyProgress): void {
    const count = (arm: number, iterations: number) => p.iterations[arm]!.filter((n) => n === iterations).length;
    const stages = new Set([...printedCounts.map((row) => Number(row.iterations)), ...p.iterations.flat()]);
    let body = "";
    (["friction_force_n", "natural_frequency_hz"] as const).forEach((name, i) => {
      const label = i ? "area of ω<sub>n</sub> (Hz)" : "area of F<sub>μ</sub> (N)";
      body += `<tr><th scope="row">${label}</th>${[0, 1].map((arm) => `<td>${printedAreas[arm]![name]}</td><td class="mine">${digits(p.areas[arm]![i], 4)}</td>`).join("")}</tr>`;
    });
    for (const n of [...stages].sort((a, b) => a - b)) {
      const row = printedCounts.find((r) => Number(r.iterations) === n);
      body += `<tr><th scope="row">runs of ${n} iterations</th>${["TMCMC", "TMCMC-II"].map((arm, a) => `<td>${row?.[arm] ?? "–"}</td><td class="mine">${count(a, n)}</td>`).join("")}</tr>`;
    }
    element("beside").innerHTML = `<thead><tr><td></td><th scope="colgroup" colspan="2">TMCMC</th><th scope="colgroup" colspan="2">TMCMC-II</th></tr>
      <tr><td></td><th scope="col">printed</th><th scope="col">yours</th><th scope="col">printed</th><th scope="col">yours</th></tr></thead><tbody>${body}</tbody>`;
    const ratio = p.areas[1]![0]! / p.areas[0]![0]!;
    element("beside-note").textContent = `Ratio of the two areas of F_μ: printed 2.1, yours ${plain(ratio)}. Log-evidence of a run: ${plain(mean(p.logEvidence[0]!), 4)} ± ${plain(deviation(p.logEvidence[0]!), 2)} (TMCMC).`;
  }

  function percentiles(p: StudyProgress): void {
    const place = (v: number) => {
      const share = below(v);
      return share < 0.1 ? "below all but 0.1 %" : share > 99.9 ? "above 99.9 %" : `above ${share.toFixed(share > 98 || share < 2 ? 1 : 0)} %`;
    };
    const own = hasPapersSettings(p.words);
    element("percentile").innerHTML = p.finished
      ? `<strong>Your areas of F<sub>μ</sub> lie ${place(p.areas[0]![0]!)} (TMCMC) and ${place(p.areas[1]![0]!)} (TMCMC-II) of the 2000 replicated ones.</strong>
        The printed ones lie ${place(0.08151)} and ${place(0.1714)}: each is possible, their ratio of 2.1 is unlikely.
        ${own ? "Try another seed: the two change places at random." : "The replicated studies have the published settings; yours differ."}`
      : "";
  }

  function record(p: StudyProgress): void {
    const evaluations = mean([...p.evaluations[0]!, ...p.evaluations[1]!]);
    const entry: Tried = {
      key: p.words.join(" "), label: describe(page.state), evaluations, area: (p.areas[0]![0]! + p.areas[1]![0]!) / 2,
      stages: mean([...p.iterations[0]!, ...p.iterations[1]!]), evidence: deviation(p.logEvidence[0]!),
    };
    const old = tried.findIndex((t) => t.key === entry.key);
    if (old >= 0) tried.splice(old, 1);
    tried.push(entry);
    if (tried.length > 12) tried.shift();
    drawTried();
  }

  function drawTried(): void {
    element("tried").innerHTML = `<thead><tr><th scope="col">setting</th><th scope="col">stages</th><th scope="col">evaluations</th><th scope="col">area (N)</th></tr></thead><tbody>` +
      [...tried].reverse().map((t, i) => `<tr${i === 0 ? ' class="latest"' : ""}><th scope="row">${escape(t.label).replace("N_eff", "N<sub>eff</sub>")}</th><td>${t.stages.toFixed(1)}</td><td>${Math.round(t.evaluations).toLocaleString("en").replace(/,/g, " ")}</td><td>${digits(t.area)}</td></tr>`).join("") + "</tbody>";
    const last = tried[tried.length - 1];
    const points = tried.map((t) => ({ x: t.evaluations, old: t === last ? null : t.area, now: t === last ? t.area : null }));
    const ends = [8000, 800000].map((x) => ({ x, old: null, now: null }));
    const rows = [ends[0]!, ...points.sort((a, b) => a.x - b.x), ends[1]!];
    cost.set([rows.map((r) => r.x), rows.map((r) => r.old), rows.map((r) => r.now), rows.map(() => floor)],
      last ? `Latest: ${last.label}: ${Math.round(last.evaluations)} evaluations a run, area ${plain(last.area)} N; floor 0.0075 N.` : "");
  }

  function buttons(): void {
    element<HTMLButtonElement>("cancel").disabled = !engine.running;
    const complete = !!progress?.finished && !engine.running;
    document.querySelectorAll<HTMLButtonElement>("[data-csv]").forEach((b) => (b.disabled = !complete));
  }

  engine.onProgress((p) => {
    progress = p;
    const done = p.done.reduce((a, b) => a + b, 0);
    const bar = element<HTMLProgressElement>("progress");
    bar.max = p.runs * p.arms.length;
    bar.value = done;
    element("status").textContent = p.finished ? `${done} runs in ${(p.milliseconds / 1000).toFixed(2)} s of this browser` : `${done} of ${bar.max} runs`;
    document.body.dataset.done = String(done);
    document.body.dataset.firstPicture ??= String(performance.now());
    drawBoxes(p);
    table(p);
    percentiles(p);
    nullChart.redraw();
    if (p.finished) {
      if (hasPapersSettings(p.words)) {
        paper = p.boxes.map((box) => ({
          x: box[0]!, lower: Array.from(box[1]!, (v, i) => Math.min(v, box[3]![i]!)), upper: Array.from(box[2]!, (v, i) => Math.max(v, box[4]![i]!)),
        }));
      }
      record(p);
      document.body.dataset.finished = p.words.join(" ") || "default";
      document.body.dataset.milliseconds = String(p.milliseconds);
    }
    buttons();
  });
  engine.onRefusal((message) => {
    element("refusal").textContent = message;
    element("refusal").hidden = false;
    element("status").textContent = "";
    buttons();
  });

  function start(state: State): void {
    element("refusal").hidden = true;
    delete document.body.dataset.finished;
    element("status").textContent = "the library starts …";
    progress = null;
    const words = wordsOf(state);
    shownWords = words.join(" ");
    element("command").textContent = `build/release/bin/sampling_study${words.length ? " " + shownWords : ""} \\\n  --output samples.csv --runs-output runs.csv --stages-output stages.csv`;
    void engine.study(words);
    void showExact(state);
    buttons();
  }

  element<HTMLFormElement>("settings").addEventListener("submit", (event) => {
    event.preventDefault();
    const settings = { seed: input("seed").value.trim(), reading: select("reading").value, runs: input("runs").value.trim() };
    const before = wordsOf(page.state).join(" ");
    page.change(settings);
    if (wordsOf(page.state).join(" ") === before) start(page.state);
  });
  element("another").addEventListener("click", () => page.change({ seed: String((Number(page.state.seed) || 0) + 1) }));
  select("reading").addEventListener("change", () => page.change({ reading: select("reading").value }));
  element("cancel").addEventListener("click", () => {
    engine.cancel();
    element("status").textContent = `cancelled after ${document.body.dataset.done ?? 0} runs`;
    buttons();
  });
  document.querySelectorAll<HTMLButtonElement>("[data-csv]").forEach((button) => button.addEventListener("click", async () => {
    const name = button.dataset.csv!;
    download(name + ".csv", await engine.call("csv", 0, name));
  }));

  const showKnobs = (state: State) => {
    const ess = Number(state.ess);
    element("ess-out").textContent = ess.toFixed(2);
    element("cov-out").textContent = `CoV = √(N/N_eff − 1) = ${(100 * covOf(ess)).toFixed(0)} %`;
    input("ess").setAttribute("aria-valuetext", `N_eff/N ${ess.toFixed(2)}, CoV ${(100 * covOf(ess)).toFixed(0)} %`);
    element("steps-out").textContent = state.steps;
    element("steps-box").hidden = state.moves !== "paper";
    element("chains-box").hidden = state.moves !== "waste-free";
  };
  // While a slider moves its numbers follow; the study starts when it is let go.
  input("ess").addEventListener("input", () => showKnobs({ ...page.state, ess: String(Number(input("ess").value)) }));
  input("ess").addEventListener("change", () => page.change({ ess: String(Number(input("ess").value)) }));
  input("steps").addEventListener("input", () => showKnobs({ ...page.state, steps: input("steps").value }));
  input("steps").addEventListener("change", () => page.change({ steps: input("steps").value }));
  select("moves").addEventListener("change", () => page.change({ moves: select("moves").value }));
  select("chains").addEventListener("change", () => page.change({ chains: select("chains").value }));
  drawTried();

  let first = true;
  return {
    show(state) {
      if (document.activeElement !== input("seed")) input("seed").value = state.seed;
      input("runs").value = state.runs;
      select("reading").value = state.reading;
      input("ess").value = state.ess;
      input("steps").value = state.steps;
      select("moves").value = state.moves;
      select("chains").value = state.chains;
      showKnobs(state);
      if (first || wordsOf(state).join(" ") !== shownWords) start(state);
      else if (progress) drawBoxes(progress);
      first = false;
    },
  };
}
