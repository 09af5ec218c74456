// Questions to the engines: one queue, as many workers as there are cores.

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
}

/** Workers with the same sweep open. */
export class Engines {
  private readonly idle: Worker[] = [];
  private readonly running = new Map<Worker, Job>();
  private queue: Job[] = [];
  readonly count: number;

  private constructor(workers: Worker[]) {
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
    const start = () =>
      new Promise<[Worker, Answer]>((resolve, reject) => {
        const worker = new Worker(address);
        worker.onmessage = (event: MessageEvent) => {
          const reply = event.data as Reply;
          if (reply.error !== undefined) reject(new Error(reply.error));
          else resolve([worker, { head: reply.head ?? {}, numbers: new Float64Array() }]);
        };
        worker.onerror = () => reject(new Error("this browser starts no worker from a page"));
        worker.postMessage({ module, sweep });
      });
    const all = await Promise.all(Array.from({ length: cores }, start));
    const first = all[0];
    if (!first) throw new Error("no engine");
    return [new Engines(all.map(([worker]) => worker)), first[1]];
  }

  /** Asks; questions of one group can be dropped together. */
  ask(question: object, group = 0): Promise<Answer> {
    return new Promise((done, failed) => {
      this.queue.push({ question, done, failed, group });
      this.next();
    });
  }

  /** Drops the questions of a group that no engine has begun with. */
  drop(group: number): void {
    this.queue = this.queue.filter((job) => job.group !== group);
  }

  /** How many questions are open. */
  open(): number {
    return this.queue.length + this.running.size;
  }

  private next(): void {
    while (this.idle.length > 0 && this.queue.length > 0) {
      const worker = this.idle.pop() as Worker;
      const job = this.queue.shift() as Job;
      this.running.set(worker, job);
      worker.postMessage({ question: JSON.stringify(job.question) });
    }
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
  head?: Record<string, unknown>;
  numbers?: Float64Array;
}
