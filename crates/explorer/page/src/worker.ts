// One engine: WebAssembly that imports nothing, and the memory in which questions and answers stand.

interface Door {
  memory: WebAssembly.Memory;
  room(bytes: number): number;
  open(): number;
  ask(): number;
  length(): number;
}

let door: Door | undefined;

/** Writes a text into the memory, and reads what is answered. */
function put(text: string, answer: (door: Door) => number): { head: Record<string, unknown>; numbers: Float64Array } {
  if (!door) throw new Error("no engine is there");
  const bytes = new TextEncoder().encode(text);
  const place = door.room(bytes.length);
  new Uint8Array(door.memory.buffer, place, bytes.length).set(bytes);
  const at = answer(door);
  const length = door.length();
  const view = new DataView(door.memory.buffer, at, length);
  const head = view.getUint32(0, true);
  const words = new TextDecoder().decode(new Uint8Array(door.memory.buffer, at + 8, head));
  const numbers = new Float64Array(door.memory.buffer.slice(at + 8 + head, at + length));
  return { head: JSON.parse(words) as Record<string, unknown>, numbers };
}

self.onmessage = async (event: MessageEvent) => {
  const asked = event.data as { module?: WebAssembly.Module; sweep?: string; question?: string };
  try {
    if (asked.module) {
      const instance = await WebAssembly.instantiate(asked.module, {});
      door = instance.exports as unknown as Door;
    }
    const { head, numbers } =
      asked.sweep !== undefined ? put(asked.sweep, (door) => door.open()) : put(asked.question ?? "", (door) => door.ask());
    if (typeof head["error"] === "string") postMessage({ error: head["error"] });
    else postMessage({ head, numbers }, { transfer: [numbers.buffer] });
  } catch (why) {
    // A trap leaves the memory in doubt: this engine answers nothing more.
    door = undefined;
    postMessage({ error: `the engine stopped: ${why instanceof Error ? why.message : String(why)}` });
  }
};
