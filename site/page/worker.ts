// The worker: the library, and the loop that makes the runs of a study one by one.
import type { Library, Reply, Request, StudyProgress } from "./protocol";

declare function createStudy(options: object): Promise<Library>;

const places = 420;
const ranges = [[0.55, 1.3], [2.93, 3.27]];
const pictureEvery = 120; // ms, and at most a fifth of the time

let library: Library;
let current = 0; // number of the study that is wanted; another one ends the loop

function reply(message: Reply): void {
  (self as unknown as { postMessage(m: Reply): void }).postMessage(message);
}

/** What the library returned, or its one line as an error. */
function checked<T>(value: T): T {
  const failed = value as { error?: string } | null | undefined;
  if (failed && typeof failed === "object" && typeof failed.error === "string") throw new Error(failed.error);
  return value;
}

/** Lets messages in. */
const channel = new MessageChannel();
let wake: () => void = () => {};
channel.port1.onmessage = () => wake();
function pause(): Promise<void> {
  return new Promise((resolve) => {
    wake = resolve;
    channel.port2.postMessage(0);
  });
}

async function makeStudy(words: string[]): Promise<void> {
  const mine = ++current;
  try {
    const { runs, arms } = checked(library.begin(0, words));
    const progress: StudyProgress = {
      words, arms, runs, done: arms.map(() => 0), iterations: arms.map(() => []), logEvidence: arms.map(() => []),
      evaluations: arms.map(() => []), areas: [], boxes: [], finished: false, milliseconds: 0,
    };
    let next = 0; // time of the next picture
    for (let i = 0; i < runs; ++i) {
      for (let arm = 0; arm < arms.length; ++arm) {
        const start = performance.now();
        const run = checked(library.run(0, arm));
        progress.milliseconds += performance.now() - start;
        progress.done[arm] = i + 1;
        progress.iterations[arm]!.push(run.iterations);
        progress.logEvidence[arm]!.push(run.logEvidence);
        progress.evaluations[arm]!.push(run.evaluations);
        await pause();
        if (mine !== current) return;
      }
      progress.finished = i + 1 === runs;
      if (progress.finished || performance.now() > next) {
        const start = performance.now();
        progress.areas = arms.map((_, arm) => checked(library.areas(0, arm)));
        progress.boxes = ranges.map(([low, high], p) => checked(library.pboxes(0, p, low!, high!, places)));
        reply({ kind: "progress", progress });
        const end = performance.now();
        next = end + Math.max(pictureEvery, 4 * (end - start));
      }
    }
  } catch (error) {
    if (mine === current) reply({ kind: "refused", words, message: (error as Error).message });
  }
}

async function load(wasm: ArrayBuffer, files: Record<string, string>): Promise<void> {
  try {
    library = await createStudy({
      wasmBinary: wasm,
      print: () => {},
      printErr: (line: string) => reply({ kind: "warning", message: line }),
    });
    for (const [path, text] of Object.entries(files)) library.writeFile(path, text);
    reply({ kind: "loaded" });
  } catch (error) {
    reply({ kind: "failed", message: (error as Error).message });
  }
}

self.onmessage = (event: MessageEvent<Request>) => {
  const request = event.data;
  if (request.kind === "load") void load(request.wasm, request.files);
  else if (request.kind === "study") void makeStudy(request.words);
  else if (request.kind === "cancel") ++current;
  else {
    try {
      const f = library[request.name] as (...args: unknown[]) => unknown;
      reply({ kind: "result", id: request.id, value: checked(f(...request.args)) });
    } catch (error) {
      reply({ kind: "result", id: request.id, error: (error as Error).message });
    }
  }
};
