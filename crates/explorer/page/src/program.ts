// The program that serves the page: its engines asked by requests.

import type { Answer } from "./ask";

/** What the program has computed already, of the sweep of the page. */
export interface Run {
  instances: number;
  response: boolean;
  program: string;
}

/** What the program tells the page it serves. */
export interface Told {
  token: string;
  cores: number;
  /** Whether a GPU computes, which takes many cells at once. */
  gpu: boolean;
  /** What computes, in words. */
  by: string;
  run: Run | null;
}

/** How long a program that is busy is left alone, ms. */
const PAUSE = 300;

/** Why there is no answer: the program is gone or no longer ours. Any other error is the answer's. */
export class Gone extends Error {}

export class Program {
  constructor(readonly told: Told) {}

  /** The program that has served this page, if one has. */
  static ofPage(): Program | null {
    const told = document.getElementById("program")?.textContent;
    return told ? new Program(JSON.parse(told) as Told) : null;
  }

  /** The answer to a question; a signal drops it. */
  async ask(question: object, signal: AbortSignal): Promise<Answer> {
    for (;;) {
      const response = await this.send(JSON.stringify(question), signal);
      if (response.status === 503) await new Promise((resolve) => setTimeout(resolve, PAUSE));
      else if (!response.ok) throw new Gone(`it answers ${response.status}: ${(await response.text()).trim()}`);
      else return parsed(await this.whole(response, signal));
      signal.throwIfAborted();
    }
  }

  private async send(body: string, signal: AbortSignal): Promise<Response> {
    const headers = { "Content-Type": "application/json", "X-Squealmap-Token": this.told.token };
    return fetch("/ask", { method: "POST", headers, body, signal }).catch((why: unknown) => gone(why, signal));
  }

  private async whole(response: Response, signal: AbortSignal): Promise<ArrayBuffer> {
    return response.arrayBuffer().catch((why: unknown) => gone(why, signal));
  }
}

function gone(why: unknown, signal: AbortSignal): never {
  if (signal.aborted) throw why;
  throw new Gone("it has ended");
}

/** Bytes of an answer: the length of the head, the head, the numbers. */
function parsed(bytes: ArrayBuffer): Answer {
  const length = new DataView(bytes).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 8, length))) as Record<string, unknown>;
  if (typeof head["error"] === "string") throw new Error(head["error"]);
  return { head, numbers: new Float64Array(bytes, 8 + length) };
}
