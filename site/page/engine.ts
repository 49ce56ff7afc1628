// The page's side of the worker.
import type { Library, Reply, Request, StudyProgress } from "./protocol";

declare const WORKER_SOURCE: string;
declare const PUBLISHED: Record<string, string>;

type Listener = (progress: StudyProgress) => void;
type Results = { [K in keyof Library]: Awaited<ReturnType<Library[K]>> };

async function wasmOf(base64: string): Promise<ArrayBuffer> {
  const packed = Uint8Array.from(atob(base64.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

export class Engine {
  private worker: Worker;
  private waiting = new Map<number, { resolve: (value: never) => void; reject: (error: Error) => void }>();
  private next = 0;
  private progressed: Listener[] = [];
  private refusals: ((message: string) => void)[] = [];
  private ready!: () => void;
  readonly loaded: Promise<void>;
  /** Lines that the library wrote to standard error since the last call of takeWarnings. */
  private warnings: string[] = [];
  words: string[] | null = null;
  running = false;

  constructor(onFailure: (message: string) => void) {
    this.worker = new Worker(URL.createObjectURL(new Blob([WORKER_SOURCE], { type: "text/javascript" })));
    this.loaded = new Promise((resolve) => (this.ready = resolve));
    this.worker.onerror = (event) => onFailure(event.message);
    this.worker.onmessage = (event: MessageEvent<Reply>) => {
      const reply = event.data;
      if (reply.kind === "loaded") this.ready();
      else if (reply.kind === "failed") onFailure(reply.message);
      else if (reply.kind === "warning") this.warnings.push(reply.message);
      else if (reply.kind === "progress") {
        if (!this.running || reply.progress.words !== this.words && reply.progress.words.join("\0") !== this.words?.join("\0")) return;
        this.running = !reply.progress.finished;
        this.progressed.forEach((f) => f(reply.progress));
      } else if (reply.kind === "refused") {
        this.running = false;
        this.refusals.forEach((f) => f(reply.message));
      } else {
        const waiting = this.waiting.get(reply.id);
        this.waiting.delete(reply.id);
        if (reply.error !== undefined) waiting?.reject(new Error(reply.error));
        else waiting?.resolve(reply.value as never);
      }
    };
    const base64 = document.getElementById("wasm")!.textContent!;
    wasmOf(base64).then((wasm) => this.post({ kind: "load", wasm, files: PUBLISHED }, [wasm]),
      (error: Error) => onFailure(error.message));
  }

  private post(request: Request, transfer: Transferable[] = []): void {
    this.worker.postMessage(request, transfer);
  }

  onProgress(f: Listener): void { this.progressed.push(f); }
  onRefusal(f: (message: string) => void): void { this.refusals.push(f); }

  async study(words: string[]): Promise<void> {
    await this.loaded;
    this.words = words;
    this.running = true;
    this.post({ kind: "study", words });
  }

  cancel(): void {
    this.running = false;
    this.post({ kind: "cancel" });
  }

  async call<K extends keyof Library>(name: K, ...args: Parameters<Library[K]>): Promise<Results[K]> {
    await this.loaded;
    const id = ++this.next;
    const result = new Promise<Results[K]>((resolve, reject) => this.waiting.set(id, { resolve: resolve as (value: never) => void, reject }));
    this.post({ kind: "call", id, name, args });
    return result;
  }

  takeWarnings(): string[] {
    return this.warnings.splice(0);
  }
}
