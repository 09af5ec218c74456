// Questions to the engines: one queue for as many workers as there are cores, one for the reader's GPU, and one for the program
// that serves the page, where one does.

import { Gone, Program } from "./program";

declare const WORKER: string;

/** What the engines answer: a head in words, and numbers beside it. */
export interface Answer {
  head: Record<string, unknown>;
  numbers: Float64Array;
}

interface Job {
  question: object;
  done: (answer: Answer) => void;
  failed: (why: Error) => void;
  group: number;
  dropped?: boolean;
}

/** The reader's GPU, with a worker of its own. */
export interface Device {
  name: string;
  isSoftware: boolean;
}

/** What computes: the program that serves the page; here, the GPU what it is faster at, all that it can, or nothing. */
export type Choice = "program" | "auto" | "gpu" | "cpu";

/** The group of questions about the cell that is looked into. */
export const CELL = 2;

/** Cells of one question: an engine answers in a fraction of a second, and is free for another view. */
const AT_ONCE = { eigenvalues: 16384, transients: 96 };
const AT_ONCE_ON_GPU = { eigenvalues: 65536, transients: 8192 };
const AT_ONCE_BY_PROGRAM = { eigenvalues: 65536, transients: 256 };

/** Workers with the same sweep open. */
export class Engines {
  private readonly idle: Worker[] = [];
  private readonly running = new Map<Worker, Job>();
  private queue: Job[] = [];
  readonly count: number;
  /** The GPU, once it is open. */
  device: Device | null = null;
  /** Why there is none. */
  noDevice = "";
  choice: Choice = "auto";
  /** Called when the GPU has come or gone. */
  changed: () => void = () => undefined;
  private gpu: Worker | null = null;
  private onGpu: Job | null = null;
  private gpuQueue: Job[] = [];
  /** The program that serves the page, while it does. */
  program: Program | null = Program.ofPage();
  /** Why it does no longer. */
  noProgram = "";
  private programQueue: Job[] = [];
  private readonly atProgram = new Map<Job, AbortController>();

  private constructor(workers: Worker[]) {
    if (this.program) this.choice = "program";
    this.idle = workers;
    this.count = workers.length;
    for (const worker of workers) {
      worker.onmessage = (event: MessageEvent) => this.finish(worker, event.data as Reply);
      worker.onerror = () => this.finish(worker, { error: "an engine has stopped; load the page again" });
    }
  }

  /** Starts the engines, and opens a sweep in each: they, and what the sweep is. */
  static async open(wasm: Uint8Array, sweep: string): Promise<[Engines, Answer]> {
    const module = await WebAssembly.compile(wasm as BufferSource);
    const cores = Math.max(1, Math.min(16, navigator.hardwareConcurrency || 2));
    const address = URL.createObjectURL(new Blob([WORKER], { type: "text/javascript" }));
    const start = (gpu = false) =>
      new Promise<[Worker, Answer]>((resolve, reject) => {
        const worker = new Worker(address);
        worker.onmessage = (event: MessageEvent) => {
          const reply = event.data as Reply;
          if (reply.error !== undefined) {
            worker.terminate();
            reject(new Error(reply.error));
          } else resolve([worker, { head: reply.head ?? {}, numbers: new Float64Array() }]);
        };
        worker.onerror = () => reject(new Error("this browser starts no worker from a page"));
        worker.postMessage({ module, sweep, gpu });
      });
    const all = await Promise.all(Array.from({ length: cores }, () => start()));
    const first = all[0];
    if (!first) throw new Error("no engine");
    const engines = new Engines(all.map(([worker]) => worker));
    // Nothing waits for the GPU.
    start(true).then(
      ([worker, { head }]) => engines.take(worker, head["gpu"] as Device),
      (why: Error) => engines.lose(why.message),
    );
    return [engines, first[1]];
  }

  private take(worker: Worker, device: Device): void {
    worker.onmessage = (event: MessageEvent) => this.finishOnGpu(event.data as Reply);
    worker.onerror = () => this.lose("its engine has stopped");
    this.gpu = worker;
    this.device = device;
    this.changed();
  }

  /** Goes on without the GPU; the engines get its questions. */
  private lose(why: string): void {
    this.gpu?.terminate();
    this.gpu = this.device = null;
    this.noDevice = why;
    this.queue.push(...(this.onGpu ? [this.onGpu] : []), ...this.gpuQueue);
    this.onGpu = null;
    this.gpuQueue = [];
    this.next();
    this.changed();
  }

  /** Goes on without the program; the engines get its questions. */
  private loseProgram(why: string): void {
    if (!this.program) return;
    this.program = null;
    this.noProgram = why;
    if (this.choice === "program") this.choice = "auto";
    this.queue.push(...[...this.atProgram.keys()].filter((job) => !job.dropped), ...this.programQueue);
    for (const controller of this.atProgram.values()) controller.abort();
    this.atProgram.clear();
    this.programQueue = [];
    this.next();
    this.changed();
  }

  /** Whether the program answers. */
  takesProgram(): boolean {
    return this.program !== null && this.choice === "program";
  }

  /** Whether the GPU computes regions with or without transients. */
  takesGpu(response: boolean): boolean {
    if (!this.gpu || !this.device || this.choice === "cpu" || this.takesProgram()) return false;
    return this.choice === "gpu" || (response && !this.device.isSoftware);
  }

  /** What computes such regions, in words. */
  by(response: boolean): string {
    if (this.program && this.takesProgram()) return `this program (${this.program.told.by})`;
    return this.takesGpu(response) && this.device ? this.device.name : `${this.count} engines`;
  }

  /** Cells of one question. */
  atOnce(response: boolean): number {
    const onGpu = this.takesProgram() ? this.program?.told.gpu : this.takesGpu(response);
    const most = onGpu ? AT_ONCE_ON_GPU : this.takesProgram() ? AT_ONCE_BY_PROGRAM : AT_ONCE;
    return most[response ? "transients" : "eigenvalues"];
  }

  /** Asks; questions of one group can be dropped together. */
  ask(question: object, group = 0): Promise<Answer> {
    return new Promise((done, failed) => {
      const { ask, response } = question as { ask?: string; response?: boolean };
      const queue = this.takesProgram() ? this.programQueue : ask === "region" && this.takesGpu(response === true) ? this.gpuQueue : this.queue;
      const job = { question, done, failed, group };
      // A cell does not wait for maps.
      if (group === CELL) queue.unshift(job);
      else queue.push(job);
      this.next();
    });
  }

  /** Drops the questions of a group that no engine has begun with; the GPU and the program drop those, too, which they are at. */
  drop(group: number): void {
    this.programQueue = this.programQueue.filter((job) => job.group !== group);
    for (const [job, controller] of this.atProgram) {
      if (job.group !== group) continue;
      job.dropped = true;
      controller.abort();
    }
    this.queue = this.queue.filter((job) => job.group !== group);
    this.gpuQueue = this.gpuQueue.filter((job) => job.group !== group);
    if (this.onGpu?.group === group) {
      this.onGpu.dropped = true;
      this.gpu?.postMessage({ drop: true });
    }
  }

  /** How many questions are open. */
  open(): number {
    return this.queue.length + this.running.size + this.gpuQueue.length + (this.onGpu ? 1 : 0) + this.programQueue.length + this.atProgram.size;
  }

  private next(): void {
    while (this.idle.length > 0 && this.queue.length > 0) {
      const worker = this.idle.pop() as Worker;
      const job = this.queue.shift() as Job;
      this.running.set(worker, job);
      worker.postMessage({ question: JSON.stringify(job.question) });
    }
    while (this.program && this.programQueue.length > 0 && this.atProgram.size < this.program.told.cores) void this.askProgram(this.program, this.programQueue.shift() as Job);
    const job = this.gpu && !this.onGpu ? this.gpuQueue.shift() : undefined;
    if (!this.gpu || !job) return;
    this.onGpu = job;
    const { ask: _, ...region } = job.question as { ask?: string };
    this.gpu.postMessage({ byGpu: JSON.stringify(region) });
  }

  private async askProgram(program: Program, job: Job): Promise<void> {
    const controller = new AbortController();
    this.atProgram.set(job, controller);
    try {
      job.done(await program.ask(job.question, controller.signal));
    } catch (why) {
      if (why instanceof Gone) this.loseProgram(why.message);
      else if (!controller.signal.aborted) job.failed(why instanceof Error ? why : new Error(String(why)));
    }
    // What was lost with the program is no longer among its questions.
    if (this.atProgram.delete(job)) this.next();
  }

  private finishOnGpu(reply: Reply): void {
    if (reply.noGpu) return this.lose(reply.error ?? "the GPU is lost");
    const job = this.onGpu;
    this.onGpu = null;
    if (job && reply.error === undefined) job.done({ head: reply.head ?? {}, numbers: reply.numbers ?? new Float64Array() });
    // What the GPU cannot do the engines do, or say why not.
    else if (job && !job.dropped) this.queue.push(job);
    this.next();
  }

  private finish(worker: Worker, reply: Reply): void {
    const job = this.running.get(worker);
    this.running.delete(worker);
    this.idle.push(worker);
    this.next();
    if (!job) return;
    if (reply.error !== undefined) job.failed(new Error(reply.error));
    else job.done({ head: reply.head ?? {}, numbers: reply.numbers ?? new Float64Array() });
  }
}

interface Reply {
  error?: string;
  /** Whether the GPU is to be done without. */
  noGpu?: boolean;
  head?: Record<string, unknown>;
  numbers?: Float64Array;
}
