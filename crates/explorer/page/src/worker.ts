// One engine: WebAssembly that imports nothing, and the memory in which questions and answers stand. The one that is told to opens
// the reader's GPU, too, and computes regions by it.

import { Gpu, type Turn } from "./gpu";

interface Door {
  memory: WebAssembly.Memory;
  room(bytes: number): number;
  open(): number;
  ask(): number;
  begin(steps: number): number;
  turn(steps: number): number;
  length(): number;
}

interface Told {
  head: Record<string, unknown>;
  /** What stands behind the head. */
  bytes: ArrayBuffer;
}

/** Steps of the first turn of a device, and how long a turn may take, ms: short enough for a view that moves on, and for frames. What
 * stands in the place of a GPU shares nothing with the screen. */
const FIRST_STEPS = 64;
const MOST_STEPS = 1024;
const TURN = 20;
const TURN_OF_SOFTWARE = 1000;

let door: Door | undefined;
let gpu: Gpu | null = null;
let steps = FIRST_STEPS;
let dropped = false;

/** Writes bytes into the memory, and reads what is answered. */
function put(bytes: Uint8Array, answer: (door: Door) => number): Told {
  if (!door) throw new Error("no engine is there");
  const place = door.room(bytes.length);
  new Uint8Array(door.memory.buffer, place, bytes.length).set(bytes);
  const at = answer(door);
  const length = door.length();
  const head = new DataView(door.memory.buffer, at, length).getUint32(0, true);
  const words = new TextDecoder().decode(new Uint8Array(door.memory.buffer, at + 8, head));
  return { head: JSON.parse(words) as Record<string, unknown>, bytes: door.memory.buffer.slice(at + 8 + head, at + length) };
}

const text = (words: string) => new TextEncoder().encode(words);

/** A region by the GPU, turn by turn; a drop ends it between two. */
async function byGpu(question: string): Promise<Told> {
  if (!gpu) throw new Error("no GPU is open");
  let told = put(text(question), (door) => door.begin(steps));
  while (typeof told.head["turn"] === "object" && !dropped) {
    const { back, took } = await gpu.turn(told.head["turn"] as Turn, new Uint8Array(told.bytes), (told.head["sources"] ?? {}) as Record<string, string>);
    steps = Math.round(Math.max(1, Math.min(MOST_STEPS, steps * Math.min(2, (gpu.isSoftware ? TURN_OF_SOFTWARE : TURN) / Math.max(1, took)))));
    told = put(back, (door) => door.turn(steps));
  }
  return dropped ? { head: { error: "no more wanted" }, bytes: new ArrayBuffer(0) } : told;
}

interface Asked {
  module?: WebAssembly.Module;
  sweep?: string;
  /** Whether to open the GPU. */
  gpu?: boolean;
  question?: string;
  byGpu?: string;
  drop?: boolean;
}

self.onmessage = async (event: MessageEvent) => {
  const asked = event.data as Asked;
  if (asked.drop) {
    dropped = true;
    return;
  }
  dropped = false;
  let ofGpu = false;
  try {
    if (asked.module) {
      const instance = await WebAssembly.instantiate(asked.module, {});
      door = instance.exports as unknown as Door;
      if (asked.gpu) {
        gpu = await Gpu.open();
        if (!gpu) return postMessage({ error: "this browser opens no GPU", noGpu: true });
      }
    }
    ofGpu = asked.byGpu !== undefined;
    const told =
      asked.sweep !== undefined
        ? put(text(asked.sweep), (door) => door.open())
        : asked.byGpu !== undefined
          ? await byGpu(asked.byGpu)
          : put(text(asked.question ?? ""), (door) => door.ask());
    const { head, bytes } = told;
    if (gpu) head["gpu"] = { name: gpu.name, isSoftware: gpu.isSoftware };
    if (typeof head["error"] === "string") postMessage({ error: head["error"] });
    else postMessage({ head, numbers: new Float64Array(bytes) }, { transfer: [bytes] });
  } catch (why) {
    const words = why instanceof Error ? why.message : String(why);
    if (ofGpu && !(why instanceof WebAssembly.RuntimeError)) return postMessage({ error: words, noGpu: true });
    // A trap leaves the memory in doubt: this engine answers nothing more.
    door = undefined;
    postMessage({ error: `the engine stopped: ${words}` });
  }
};
