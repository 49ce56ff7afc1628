// Part 3: one run, stage by stage.
import type uPlot from "uplot";
import { Chart, colour, mark } from "./charts";
import { digits, element, plain } from "./dom";
import type { Page, Shown } from "./part";
import type { Stage } from "./protocol";
import { wordsOf, type State } from "./state";

const lowest = -1e9; // log-likelihoods below stand for impossible motion

export function runPart(page: Page): Shown {
  const { engine } = page;
  const input = (id: string) => element<HTMLInputElement>(id);
  let stages: Stage[] = [];
  let at = 0;
  let traced = "";
  let timer = 0;

  const scatter = (u: uPlot) => {
    const stage = stages[at];
    if (!stage) return;
    const { ctx, bbox } = u;
    const ratio = devicePixelRatio || 1;
    const n = stage.logLikelihood.length;
    ctx.save();
    ctx.beginPath(); ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height); ctx.clip();
    ctx.lineWidth = ratio;
    ctx.setLineDash([]);
    const largest = stage.weights ? Math.max(...stage.weights) : 1;
    for (let i = 0; i < n; ++i) {
      const x = u.valToPos(stage.points[i]!, "x", true);
      const y = u.valToPos(stage.points[2 * n + i]!, "y", true);
      if (stage.logLikelihood[i]! < lowest) {
        ctx.strokeStyle = colour("muted");
        mark(ctx, "cross", x, y, 2.2 * ratio);
      } else {
        const w = stage.weights ? stage.weights[i]! / largest : 0.4;
        ctx.strokeStyle = ctx.fillStyle = colour("tmcmc");
        ctx.globalAlpha = 0.75;
        if (w < 0.02) mark(ctx, "circle", x, y, 1.6 * ratio);
        else mark(ctx, "dot", x, y, (1.3 + 3.2 * Math.sqrt(w)) * ratio);
        ctx.globalAlpha = 1;
      }
    }
    ctx.restore();
  };
  const plane = new Chart(element("plane"), {
    title: "The population in the whole prior", x: "friction force F_μ (N)", y: "noise σ_phase (deg)",
    lines: [{ label: "sample; its area is its weight in the next step", colour: "tmcmc", points: "circle" }, { label: "no continuous motion", colour: "muted", points: "cross" }],
    xRange: [0, 10], yRange: [0, 10], height: 300, draw: scatter,
  });
  const funnel = new Chart(element("funnel"), {
    title: "The same, near the posterior: the funnel", x: "friction force F_μ (N)", y: "noise σ_phase (deg)",
    lines: [{ label: "sample; nearly weightless ones are hollow", colour: "tmcmc", points: "circle" }], xRange: [0.6, 1.3], yRange: [0, 10], height: 300, draw: scatter,
  });
  const betas = new Chart(element("betas"), {
    title: "The power β of the likelihood", x: "stage", y: "β",
    lines: [{ label: "β after each stage", colour: "tmcmc" }, { label: "this stage", colour: "tmcmc2", points: "diamond" }], yLog: true, yRange: [1e-11, 2], height: 260,
    ySplits: [1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1], values: (v) => (v === 1 ? "1" : "10" + String(Math.round(Math.log10(v))).replace(/[-\d]/g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]!)),
  });

  function draw(): void {
    const stage = stages[at];
    if (!stage) return;
    const n = stage.logLikelihood.length;
    const possible = stage.logLikelihood.filter((l) => l >= lowest).length;
    const corners: [ArrayLike<number>, (number | null)[], (number | null)[]] = [[0, 10], [null, null], [null, null]];
    const forces = Array.from(stage.points.subarray(0, n)).sort((a, b) => a - b);
    const says = `Stage ${at}, β = ${plain(stage.beta)}: ${n} samples, ${possible} with continuous motion; half of the friction forces lie between ${plain(forces[Math.floor(n / 4)]!)} and ${plain(forces[Math.floor(3 * n / 4)]!)} N.`;
    plane.set(corners, says);
    funnel.set([[0.6, 1.3], [null, null]], says);
    const x = stages.map((_, i) => i);
    betas.set([x, stages.map((s) => s.beta || null), x.map((i) => (i === at ? stages[i]!.beta || 1e-11 : null))], `β = ${plain(stage.beta)} after stage ${at} of ${stages.length - 1}.`);
    element("stage-out").textContent = `${at} of ${stages.length - 1}`;
    input("stage").max = String(stages.length - 1);
    input("stage").value = String(at);
    input("stage").setAttribute("aria-valuetext", says);
    element("stage-title").textContent = at === 0 ? "Draws from the prior" : `After stage ${at}`;
    const r = stage.record;
    const sum = stage.weights?.reduce((a, b) => a + b, 0) ?? 0;
    const squares = stage.weights?.reduce((a, b) => a + b * b, 0) ?? 0;
    const rows: [string, string][] = [["β", digits(stage.beta)], ["samples with continuous motion", `${possible} of ${n}`],
      ["middle half of F<sub>μ</sub>", `${digits(forces[Math.floor(n / 4)]!)} to ${digits(forces[Math.floor(3 * n / 4)]!)} N`]];
    if (r) rows.push(["N<sub>eff</sub> of the step that led here", digits(r.effectiveSampleSize, 4)], ["CoV of its weights", (100 * r.coefficientOfVariation).toFixed(1) + " %"],
      ["different samples among the starts", String(r.distinctAncestors)], ["proposals accepted", (100 * r.acceptanceRate).toFixed(1) + " %"]);
    if (stage.weights) rows.push(["N<sub>eff</sub> of the next step", digits(sum * sum / squares, 4)]);
    else rows.push(["next step", "none: β = 1, the posterior"]);
    element("stage-table").innerHTML = "<tbody>" + rows.map(([a, b]) => `<tr><th scope="row">${a}</th><td>${b}</td></tr>`).join("") + "</tbody>";
    element<HTMLButtonElement>("back").disabled = element<HTMLButtonElement>("first").disabled = at === 0;
    element<HTMLButtonElement>("forward").disabled = at === stages.length - 1;
    element("part-run").dataset.stage = String(at);
  }

  function go(stage: number): void {
    page.change({ stage: String(Math.max(0, Math.min(stages.length - 1, stage))) }, true);
  }
  function stop(): void {
    clearInterval(timer);
    timer = 0;
    element("play").textContent = "Play";
    element("play").setAttribute("aria-pressed", "false");
  }
  element("play").addEventListener("click", () => {
    if (timer) return stop();
    if (at === stages.length - 1) go(0);
    element("play").textContent = "Pause";
    element("play").setAttribute("aria-pressed", "true");
    timer = window.setInterval(() => {
      go(at + 1);
      if (at >= stages.length - 1) stop();
    }, 900);
  });
  for (const [id, step] of [["first", -Infinity], ["back", -1], ["forward", 1]] as const) {
    element(id).addEventListener("click", () => {
      stop();
      go(step === -Infinity ? 0 : at + step);
    });
  }
  input("stage").addEventListener("input", () => {
    stop();
    go(Number(input("stage").value));
  });
  element<HTMLSelectElement>("trace-arm").addEventListener("change", (event) => page.change({ sampler: (event.target as HTMLSelectElement).value, stage: "0" }));
  input("trace-run").addEventListener("change", () => page.change({ run: input("trace-run").value, stage: "0" }));

  async function trace(state: State): Promise<void> {
    const words = wordsOf(state);
    traced = [...words, state.sampler, state.run].join(" ");
    const mine = traced;
    element("trace-refusal").hidden = true;
    try {
      if (!/^\d{1,9}$/.test(state.run) || !/^[01]$/.test(state.sampler)) throw new Error(`run: value '${state.run}': expected a whole number from 0`);
      await engine.call("begin", 1, words);
      const result = await engine.call("trace", 1, Number(state.sampler), Number(state.run));
      if (mine !== traced) return;
      stages = result;
      at = Math.min(stages.length - 1, Math.max(0, Number(page.state.stage) || 0));
      draw();
    } catch (error) {
      element("trace-refusal").textContent = (error as Error).message;
      element("trace-refusal").hidden = false;
    }
  }

  return {
    show(state) {
      element<HTMLSelectElement>("trace-arm").value = state.sampler;
      input("trace-run").value = state.run;
      if ([...wordsOf(state), state.sampler, state.run].join(" ") !== traced) void trace(state);
      else if (stages.length) {
        at = Math.min(stages.length - 1, Math.max(0, Number(state.stage) || 0));
        draw();
      }
    },
    hide: stop,
  };
}
