// What page and worker tell each other.

/** What a run says of itself. */
export interface RunSummary {
  iterations: number;
  logEvidence: number;
  evaluations: number;
  mean: Float64Array;
}

/** A study as far as it has come; one entry a sampler. */
export interface StudyProgress {
  words: string[];
  arms: string[];
  runs: number;
  done: number[];
  iterations: number[][];
  logEvidence: number[][];
  evaluations: number[][];
  areas: Float64Array[];
  /** Of friction force and natural frequency: x, then least and largest fraction of each sampler. */
  boxes: Float64Array[][];
  finished: boolean;
  /** Of the runs alone, without the pictures. */
  milliseconds: number;
}

export interface StageRecord {
  stage: number;
  beta: number;
  step: number;
  effectiveSampleSize: number;
  coefficientOfVariation: number;
  acceptanceRate: number;
  feasible: number;
  distinctAncestors: number;
  evaluations: number;
}

export interface Stage {
  beta: number;
  /** Column by column. */
  points: Float64Array;
  logLikelihood: Float64Array;
  record?: StageRecord;
  weights?: Float64Array;
}

export interface Marginal {
  x: Float64Array;
  density: Float64Array;
  cdf: Float64Array;
  mean: number;
  sd: number;
  low: number;
  high: number;
}

export interface ExactPosterior {
  logEvidence: number;
  marginals: Marginal[];
}

export interface Fit {
  estimate: number;
  standardError: number;
  noise: number;
  atBound: boolean;
}

export interface Observations {
  nominalRatio: Float64Array;
  measuredRatio: Float64Array;
  drivingFrequencyHz: Float64Array;
  phaseDeg: Float64Array;
}

export interface SteadyMotion {
  periodic: boolean;
  atRest: boolean;
  phaseDeg: number;
  amplitude: number;
  continuous: boolean;
  stickingFraction: number;
  stops: number;
  tau: Float64Array;
  x: Float64Array;
  sticks: Float64Array;
}

export interface PhaseCurve {
  closed: Float64Array;
  limit: Float64Array;
  integrated: Float64Array;
}

/** The functions of binding.cpp. Each may return { error }. */
export interface Library {
  writeFile(path: string, text: string): void;
  begin(slot: number, words: string[]): { runs: number; arms: string[] };
  run(slot: number, arm: number): RunSummary;
  areas(slot: number, arm: number): Float64Array;
  pboxes(slot: number, parameter: number, low: number, high: number, count: number): Float64Array[];
  samples(slot: number, arm: number, parameter: number): Float64Array;
  csv(slot: number, table: string): string;
  trace(slot: number, arm: number, index: number): Stage[];
  observations(path: string): Observations;
  exactPosterior(words: string[], count: number): ExactPosterior;
  leastSquares(words: string[]): { frictionForce: Fit; naturalFrequency: Fit };
  phaseCurve(forceRatio: number, ratios: number[], integrate: boolean): PhaseCurve;
  steadyMotion(frequencyRatio: number, forceRatio: number): SteadyMotion;
}

export type Request =
  | { kind: "load"; wasm: ArrayBuffer; files: Record<string, string> }
  | { kind: "study"; words: string[] }
  | { kind: "cancel" }
  | { kind: "call"; id: number; name: keyof Library; args: unknown[] };

export type Reply =
  | { kind: "loaded" }
  | { kind: "failed"; message: string }
  | { kind: "warning"; message: string }
  | { kind: "progress"; progress: StudyProgress }
  | { kind: "refused"; words: string[]; message: string }
  | { kind: "result"; id: number; value?: unknown; error?: string };
