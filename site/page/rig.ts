// Part 4: the phase of the rig over the frequency ratio, and its motion.
import type uPlot from "uplot";
import { Chart, colour } from "./charts";
import { element, plain } from "./dom";
import type { Page, Shown } from "./part";
import type { Observations, SteadyMotion } from "./protocol";
import type { State } from "./state";

const drivingForce = 2.5; // N, Section 3 of the paper
const ratios = Array.from({ length: 117 }, (_, i) => 0.2 + 0.0155 * i + 0.0007);

export function rigPart(page: Page): Shown {
  const { engine } = page;
  const input = (id: string) => element<HTMLInputElement>(id);
  let observations: Observations | null = null;
  let wanted = "";
  let busy = false;
  let motion: SteadyMotion | null = null;

  const phase = new Chart(element("phase"), {
    title: "Phase lag of the mass behind the base", x: "frequency ratio r = ω_b/ω_n", y: "phase angle (deg)",
    lines: [{ label: "closed form (continuous motion)", colour: "tmcmc", width: 2.4 }, { label: "integrated in time (also sticking)", colour: "tmcmc2", dash: [7, 4] }, { label: "Table 1", colour: "printed", points: "circle" }],
    xRange: [0.2, 2.02], yRange: [0, 180], height: 320, ySplits: [0, 30, 60, 90, 120, 150, 180],
    draw: (u: uPlot) => {
      const ratio = Number(page.state.ratio);
      const x = u.valToPos(ratio, "x", true);
      u.ctx.save();
      u.ctx.strokeStyle = colour("muted");
      u.ctx.lineWidth = devicePixelRatio || 1;
      u.ctx.setLineDash([]);
      u.ctx.beginPath(); u.ctx.moveTo(x, u.bbox.top); u.ctx.lineTo(x, u.bbox.top + u.bbox.height); u.ctx.stroke();
      u.ctx.restore();
    },
  });
  const shade = (u: uPlot) => {
    if (!motion) return;
    u.ctx.save();
    u.ctx.fillStyle = colour("stick");
    u.ctx.globalAlpha = 0.2;
    for (let i = 0; i + 1 < motion.tau.length; ++i) {
      if (motion.sticks[i]) {
        const from = u.valToPos(motion.tau[i]!, "x", true);
        u.ctx.fillRect(from, u.bbox.top, u.valToPos(motion.tau[i + 1]!, "x", true) - from, u.bbox.height);
      }
    }
    u.ctx.restore();
  };
  const moved = new Chart(element("motion"), {
    title: "Motion over two periods of the base", x: "time (periods of the base)", y: "displacement (base amplitudes)",
    lines: [{ label: "base", colour: "muted", dash: [2, 3] }, { label: "mass", colour: "tmcmc", width: 2.4 }, { label: "mass, sticking (shaded)", colour: "stick", width: 4.5 }],
    xRange: [0, 2], height: 320, draw: shade,
  });

  async function compute(): Promise<void> {
    if (busy) return;
    busy = true;
    try {
      while (true) {
        const { friction, ratio } = page.state;
        const key = friction + " " + ratio;
        observations ??= await engine.call("observations", "data/published/table1_observations.csv");
        const force = Number(friction) / drivingForce;
        motion = await engine.call("steadyMotion", Number(ratio), force);
        draw(Number(ratio), force);
        const curve = await engine.call("phaseCurve", force, ratios, true);
        const x = [...ratios, ...observations.measuredRatio].map((r, i) => ({ r, i })).sort((a, b) => a.r - b.r);
        const n = ratios.length;
        const of = (values: ArrayLike<number>) => {
          // A measured ratio lies between two of the curve: the line goes on across it.
          return x.map(({ r, i }) => {
            if (i < n) return Number.isNaN(values[i]!) ? null : values[i]!;
            const k = ratios.findIndex((v) => v > r);
            if (k < 1) return null;
            const [a, b] = [values[k - 1]!, values[k]!];
            return Number.isNaN(a) || Number.isNaN(b) ? null : a + (b - a) * (r - ratios[k - 1]!) / (ratios[k]! - ratios[k - 1]!);
          });
        };
        const points = x.map(({ i }) => (i < n ? null : observations!.phaseDeg[i - n]!));
        const continuous = ratios.filter((_, i) => !Number.isNaN(curve.closed[i]!)).length;
        phase.set([x.map(({ r }) => r), of(curve.closed), of(curve.integrated), points],
          `Friction ${plain(Number(friction))} N: motion is continuous at ${Math.round(100 * continuous / n)} % of the frequency ratios shown. Points: the ten phase angles of Table 1.`);
        element("part-rig").dataset.shown = key;
        if (key === page.state.friction + " " + page.state.ratio) break;
      }
    } catch (error) {
      element("rig-says").textContent = (error as Error).message;
    } finally {
      busy = false;
    }
  }

  function draw(ratio: number, force: number): void {
    const m = motion!;
    const says = m.atRest ? `The friction force of ${plain(force * drivingForce)} N holds the mass: the base drives it with only ${drivingForce} N. It never moves.`
      : !m.periodic ? `At r = ${ratio.toFixed(2)} no periodic motion is found: at resonance it grows without bound.`
      : m.continuous ? `At r = ${ratio.toFixed(2)} the mass slides all the time, ${plain(m.phaseDeg)}° behind the base, with ${plain(m.amplitude)} times its amplitude.`
      : `At r = ${ratio.toFixed(2)} the mass sticks ${m.stops} times a period, for ${Math.round(100 * m.stickingFraction)} % of the time (shaded). Its first harmonic lags by ${plain(m.phaseDeg)}°.`;
    element("rig-says").textContent = says;
    const tau: number[] = [], x: (number | null)[] = [], sticking: (number | null)[] = [];
    const add = (t: number, at: number | null, sticks: boolean) => {
      tau.push(t);
      x.push(at);
      sticking.push(sticks ? at : null);
    };
    if (m.periodic) {
      for (let i = 0; i < m.tau.length; ++i) {
        add(m.tau[i]!, m.x[i]!, !!m.sticks[i] || (i > 0 && !!m.sticks[i - 1]));
        // The library gives a time of sticking by its ends; the base moves on.
        const step = (m.tau[i + 1]! - m.tau[i]!) / 20;
        for (let k = 1; m.sticks[i] && k < 20; ++k) add(m.tau[i]! + k * step, m.x[i]!, true);
      }
    } else {
      for (let i = 0; i < 200; ++i) add(i / 99.5, m.atRest ? 0 : null, m.atRest);
    }
    moved.set([tau, tau.map((t) => Math.cos(2 * Math.PI * t)), x, sticking], says);
  }

  const outputs = (friction: string, ratio: string) => {
    element("friction-out").textContent = Number(friction).toFixed(3) + " N";
    element("ratio-out").textContent = Number(ratio).toFixed(2);
    input("friction").setAttribute("aria-valuetext", Number(friction).toFixed(3) + " newtons");
  };
  let settle = 0;
  const change = (settings: Partial<State>) => {
    page.change(settings, true);
    clearTimeout(settle);
    settle = window.setTimeout(() => void compute(), 0);
  };
  input("friction").addEventListener("input", () => change({ friction: String(Number(input("friction").value)) }));
  input("ratio").addEventListener("input", () => change({ ratio: String(Number(input("ratio").value)) }));
  document.querySelectorAll<HTMLButtonElement>("[data-friction]").forEach((b) => b.addEventListener("click", () => page.change({ friction: b.dataset.friction! })));

  return {
    show(state) {
      input("friction").value = state.friction;
      input("ratio").value = state.ratio;
      outputs(state.friction, state.ratio);
      const key = state.friction + " " + state.ratio;
      if (key !== wanted) {
        wanted = key;
        void compute();
      }
    },
  };
}
