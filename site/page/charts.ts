// Charts by uPlot, which redraws thousands of points in a millisecond and brings nothing else with it. Colours are those of the style
// sheet, in light and dark; no meaning is carried by colour alone: lines differ in dashes, points in shape.
import uPlot from "uplot";

export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
}

export interface Line {
  label: string;
  colour: string;
  dash?: number[];
  width?: number;
  /** Instead of a line: "circle" or "cross". */
  points?: "circle" | "cross" | "diamond";
  /** Shown in the legend. */
  legend?: boolean;
  /** Colour of the area below it. */
  fill?: string;
}

export interface ChartOptions {
  title: string;
  x: string;
  y: string;
  lines: Line[];
  /** Pairs of lines, from 1, between which the area is filled. */
  bands?: { between: [number, number]; colour: string }[];
  xRange?: [number, number] | ((min: number, max: number) => [number, number]);
  yRange?: [number, number];
  xLog?: boolean;
  yLog?: boolean;
  height?: number;
  draw?: (u: uPlot) => void;
  /** Places of the labels, where the axis shall not choose them. */
  xSplits?: number[];
  ySplits?: number[];
  values?: (value: number) => string;
}

const font = "12px system-ui, 'Helvetica Neue', Arial, sans-serif";

function sample(line: Line): string {
  const dash = line.dash ? ` stroke-dasharray="${line.dash.join(" ")}"` : "";
  const mark = line.points === "circle"
    ? `<circle cx="14" cy="6" r="3.5" fill="none" stroke="currentColor" stroke-width="1.8"/>`
    : line.points === "diamond" ? `<path d="M14 1 19 6 14 11 9 6z" fill="currentColor"/>`
    : line.points === "cross" ? `<path d="M10 2 18 10 M10 10 18 2" stroke="currentColor" stroke-width="1.8"/>`
    : `<line x1="0" y1="6" x2="28" y2="6" stroke="currentColor" stroke-width="${line.width ?? 2}"${dash}/>`;
  return `<span class="key"><svg aria-hidden="true" width="28" height="12" style="color:var(--${line.colour})">${mark}</svg>${line.label}</span>`;
}

/** Draws marks of one shape at positions in pixels of the canvas. */
export function mark(ctx: CanvasRenderingContext2D, shape: "circle" | "cross" | "diamond" | "dot", x: number, y: number, r: number): void {
  ctx.beginPath();
  if (shape === "cross") {
    ctx.moveTo(x - r, y - r); ctx.lineTo(x + r, y + r); ctx.moveTo(x - r, y + r); ctx.lineTo(x + r, y - r);
    ctx.stroke();
  } else if (shape === "diamond") {
    ctx.moveTo(x, y - r * 1.3); ctx.lineTo(x + r * 1.3, y); ctx.lineTo(x, y + r * 1.3); ctx.lineTo(x - r * 1.3, y); ctx.closePath();
    ctx.fill();
  } else {
    ctx.arc(x, y, r, 0, 2 * Math.PI);
    if (shape === "dot") ctx.fill(); else ctx.stroke();
  }
}

/** Text that is legible on lines. */
export function write(ctx: CanvasRenderingContext2D, text: string, x: number, y: number): void {
  ctx.lineJoin = "round";
  ctx.lineWidth = 4 * (devicePixelRatio || 1);
  ctx.strokeStyle = colour("card");
  ctx.strokeText(text, x, y);
  ctx.fillStyle = colour("text");
  ctx.fillText(text, x, y);
}

const charts = new Set<Chart>();

export class Chart {
  readonly plot: uPlot;
  private readonly box: HTMLElement;
  private readonly caption: HTMLElement;
  private readonly height: number;

  constructor(figure: HTMLElement, private readonly options: ChartOptions) {
    this.height = options.height ?? 260;
    figure.classList.add("chart");
    figure.innerHTML = `<div class="chart-title">${options.title}</div><div class="plot" role="img"></div><figcaption></figcaption>`;
    this.box = figure.querySelector(".plot")!;
    this.caption = figure.querySelector("figcaption")!;
    this.caption.innerHTML = options.lines.filter((l) => l.legend !== false).map(sample).join(" ");
    const series: uPlot.Series[] = [{}];
    for (const line of options.lines) {
      series.push({
        label: line.label,
        stroke: () => colour(line.colour),
        width: line.points ? 0 : line.width ?? 2,
        dash: line.dash,
        spanGaps: false,
        paths: line.points ? () => null : uPlot.paths.linear!(),
        ...(line.fill ? { fill: () => colour(line.fill!) } : {}),
        points: { show: false },
      });
    }
    const axis = (label: string): uPlot.Axis => ({
      label, labelFont: font, font, labelSize: 22,
      stroke: () => colour("text"),
      grid: { stroke: () => colour("grid"), width: 1 },
      ticks: { stroke: () => colour("grid"), width: 1, size: 5 },
    });
    const placed = (splits?: number[]): uPlot.Axis => splits === undefined ? {}
      : { splits: () => splits, filter: (_, values) => values, values: (_, v) => v.map(options.values ?? String) };
    this.plot = new uPlot({
      width: this.width(), height: this.height,
      legend: { show: false },
      cursor: { show: false },
      padding: [10, 14, 0, 0],
      scales: {
        x: { time: false, distr: options.xLog ? 3 : 1, range: options.xRange ? (_, min, max) => typeof options.xRange === "function" ? options.xRange(min, max) : options.xRange! : undefined },
        y: { distr: options.yLog ? 3 : 1, range: options.yRange ? () => options.yRange! : undefined },
      },
      axes: [{ ...axis(options.x), size: 34, space: 56, ...placed(options.xSplits) }, { ...axis(options.y), size: 50, ...placed(options.ySplits) }],
      pxAlign: 0,
      series,
      bands: (options.bands ?? []).map((b) => ({ series: b.between, fill: () => colour(b.colour) })),
      hooks: { draw: [(u) => this.drawMarks(u), ...(options.draw ? [options.draw] : [])] },
    }, options.lines.length === 0 ? [[0, 1]] : [[], ...options.lines.map(() => [])] as uPlot.AlignedData, this.box);
    charts.add(this);
    new ResizeObserver(() => {
      const width = this.width();
      if (this.box.clientWidth > 0 && width !== this.plot.width) this.plot.setSize({ width, height: this.height });
    }).observe(this.box);
  }

  private drawMarks(u: uPlot): void {
    const ratio = devicePixelRatio || 1;
    u.ctx.save();
    u.ctx.lineWidth = 1.8 * ratio;
    u.ctx.setLineDash([]);
    this.options.lines.forEach((line, i) => {
      if (!line.points) return;
      u.ctx.strokeStyle = u.ctx.fillStyle = colour(line.colour);
      (u.data[i + 1] as (number | null)[]).forEach((y, k) => {
        if (y === null || Number.isNaN(y)) return;
        mark(u.ctx, line.points!, u.valToPos(u.data[0]![k]!, "x", true), u.valToPos(y, "y", true), 4 * ratio);
      });
    });
    u.ctx.restore();
  }

  private width(): number {
    return Math.max(220, this.box.clientWidth);
  }

  set(data: ArrayLike<number | null>[], says: string): void {
    this.plot.setData(data as unknown as uPlot.AlignedData);
    this.box.setAttribute("aria-label", this.options.title.replace(/<[^>]*>/g, "") + ". " + says);
  }

  redraw(): void {
    this.plot.redraw();
  }
}

matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => charts.forEach((c) => c.redraw()));
