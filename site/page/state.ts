// What the address holds: the part of the page, the seed and every setting, so that a view can be cited.

export const parts = ["study", "knobs", "run", "rig", "data", "verdicts"] as const;
export type Part = (typeof parts)[number];

/** All settings as they stand in the address, as text: the library checks them. */
export interface State {
  part: Part;
  seed: string;
  reading: string;
  runs: string;
  /** N_eff/N of both samplers; 0.5 is the paper's. */
  ess: string;
  /** "paper", "waste-free" or "recommended". */
  moves: string;
  steps: string;
  chains: string;
  /** Of the third part. */
  sampler: string;
  run: string;
  stage: string;
  /** Of the fourth part: F_mu in N, and the frequency ratio of the motion that is drawn. */
  friction: string;
  ratio: string;
}

export const defaults: State = {
  part: "study", seed: "1", reading: "as_published", runs: "50", ess: "0.5", moves: "paper", steps: "3",
  chains: "10", sampler: "0", run: "0", stage: "0", friction: "0.98", ratio: "0.79",
};

export function read(hash: string): State {
  const state = { ...defaults };
  const given = new URLSearchParams(hash.replace(/^#/, ""));
  for (const key of Object.keys(defaults) as (keyof State)[]) {
    const value = given.get(key);
    if (value !== null) (state as unknown as Record<string, string>)[key] = value;
  }
  if (!parts.includes(state.part)) state.part = defaults.part;
  return state;
}

export function write(state: State): string {
  const text = new URLSearchParams();
  for (const key of Object.keys(defaults) as (keyof State)[]) {
    if (state[key] !== defaults[key]) text.set(key, state[key]);
  }
  const hash = text.toString();
  return "#" + (hash || "part=study");
}

/** CoV = sqrt(N/N_eff - 1): the same rule by its other name. */
export function covOf(ess: number): number {
  return Math.sqrt(1 / ess - 1);
}

/** The settings as options of sampling_study; none where they are its defaults. */
export function wordsOf(state: State): string[] {
  const words: string[] = [];
  const add = (option: string, value: string) => words.push(option, value);
  if (state.seed !== defaults.seed) add("--seed", state.seed);
  if (state.reading !== defaults.reading) add("--reading", state.reading);
  if (state.runs !== defaults.runs) add("--runs", state.runs);
  if (state.moves === "recommended") add("--sampler", "recommended");
  if (state.moves === "waste-free") {
    add("--move", "waste-free");
    add("--chains", state.chains);
  }
  if (state.moves === "paper" && state.steps !== defaults.steps) add("--move-steps", state.steps);
  if (state.ess !== defaults.ess) {
    add("--cov-target", String(covOf(Number(state.ess))));
    add("--ess-fraction", state.ess);
  }
  return words;
}
