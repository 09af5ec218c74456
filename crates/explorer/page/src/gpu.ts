// The reader's GPU: what the engine asks for is sent, dispatched and brought back.

/** A dispatch: its kernel, where its words lie in inputs, state and flags (bytes), and how many invocations. */
interface Dispatch {
  kernel: string;
  first: [number, number, number];
  bytes: [number, number, number];
  count: number;
}

/** What is to be done in a turn. The bytes of inputs, state, flags and settings are sent one after the other. */
export interface Turn {
  dispatches: Dispatch[];
  sizes: [number, number, number, number];
  settings: number;
  aligned: number;
}

/** Invocations of a workgroup, as the kernels have it. */
const WORKGROUP = 64;

/** Words of the counter of those that are finished. */
const PROGRESS = 16;

interface Buffers {
  sizes: number[];
  parts: GPUBuffer[];
  back: GPUBuffer;
}

export class Gpu {
  private readonly pipelines = new Map<string, GPUComputePipeline>();
  private readonly layout: GPUBindGroupLayout;
  private readonly progress: GPUBuffer;
  private buffers: Buffers | null = null;
  /** Why the device is gone. */
  lost: string | null = null;

  private constructor(
    private readonly device: GPUDevice,
    /** What the browser tells of it. */
    readonly name: string,
    /** Whether software stands in its place. */
    readonly isSoftware: boolean,
  ) {
    const visibility = GPUShaderStage.COMPUTE;
    const entry = (binding: number, type: GPUBufferBindingType) => ({ binding, visibility, buffer: { type } });
    this.layout = device.createBindGroupLayout({
      entries: [entry(0, "uniform"), entry(1, "read-only-storage"), entry(2, "storage"), entry(3, "storage"), entry(4, "storage")],
    });
    this.progress = device.createBuffer({ size: PROGRESS, usage: GPUBufferUsage.STORAGE });
    void device.lost.then((info) => {
      this.lost = info.message || info.reason || "the device is lost";
    });
  }

  /** Opens the device, where there is one. */
  static async open(): Promise<Gpu | null> {
    const gpu = (navigator as { gpu?: GPU }).gpu;
    const adapter = await gpu?.requestAdapter({ powerPreference: "high-performance" }).catch(() => null);
    if (!adapter) return null;
    const { maxStorageBufferBindingSize, maxBufferSize } = adapter.limits;
    const device = await adapter.requestDevice({ requiredLimits: { maxStorageBufferBindingSize, maxBufferSize } }).catch(() => null);
    if (!device) return null;
    const { vendor, architecture, description, isFallbackAdapter } = adapter.info;
    const name = description || [vendor, architecture].filter(Boolean).join(" ") || "GPU";
    return new Gpu(device, name, isFallbackAdapter || /swiftshader|llvmpipe|lavapipe|warp|basic render/i.test(`${architecture} ${name}`));
  }

  /** Does a turn: the bytes of state and flags that have come of it, and how long it took, ms. */
  async turn(turn: Turn, bytes: Uint8Array<ArrayBuffer>, sources: Record<string, string>): Promise<{ back: Uint8Array; took: number }> {
    if (this.lost !== null) throw new Error(this.lost);
    for (const [name, code] of Object.entries(sources)) if (!this.pipelines.has(name)) this.pipelines.set(name, await this.compiled(name, code));
    const began = performance.now();
    this.device.pushErrorScope("out-of-memory");
    this.device.pushErrorScope("validation");
    const { parts, back } = this.room(turn.sizes);
    let at = 0;
    turn.sizes.forEach((size, k) => {
      if (size > 0) this.device.queue.writeBuffer(parts[k] as GPUBuffer, 0, bytes, at, size);
      at += size;
    });
    const encoder = this.device.createCommandEncoder();
    const pass = encoder.beginComputePass();
    turn.dispatches.forEach((dispatch, number) => {
      const pipeline = this.pipelines.get(dispatch.kernel);
      if (!pipeline) throw new Error(`the kernel ${dispatch.kernel} was not told`);
      const part = (k: number) => ({ buffer: parts[k] as GPUBuffer, offset: dispatch.first[k], size: dispatch.bytes[k] });
      const resources = [{ buffer: parts[3] as GPUBuffer, offset: number * turn.aligned, size: turn.settings }, part(0), part(1), part(2), { buffer: this.progress }];
      pass.setPipeline(pipeline);
      pass.setBindGroup(0, this.device.createBindGroup({ layout: this.layout, entries: resources.map((resource, binding) => ({ binding, resource })) as GPUBindGroupEntry[] }));
      const groups = Math.ceil(dispatch.count / WORKGROUP);
      const rows = Math.ceil(groups / this.device.limits.maxComputeWorkgroupsPerDimension);
      pass.dispatchWorkgroups(Math.ceil(groups / rows), rows);
    });
    pass.end();
    const [, state, flags] = turn.sizes;
    encoder.copyBufferToBuffer(parts[1] as GPUBuffer, 0, back, 0, state);
    encoder.copyBufferToBuffer(parts[2] as GPUBuffer, 0, back, state, flags);
    this.device.queue.submit([encoder.finish()]);
    const errors = await Promise.all([this.device.popErrorScope(), this.device.popErrorScope()]);
    const wrong = errors.find((error) => error !== null);
    if (wrong) throw new Error(wrong.message);
    await back.mapAsync(GPUMapMode.READ, 0, state + flags);
    const words = new Uint8Array(back.getMappedRange(0, state + flags).slice(0));
    back.unmap();
    return { back: words, took: performance.now() - began };
  }

  private async compiled(name: string, code: string): Promise<GPUComputePipeline> {
    const layout = this.device.createPipelineLayout({ bindGroupLayouts: [this.layout] });
    const module = this.device.createShaderModule({ label: name, code });
    const { messages } = await module.getCompilationInfo();
    const wrong = messages.find((message) => message.type === "error");
    if (wrong) throw new Error(`this browser does not compile a kernel: line ${wrong.lineNum}: ${wrong.message}: ${code.split("\n")[wrong.lineNum - 1]}`);
    return this.device.createComputePipelineAsync({ label: name, layout, compute: { module, entryPoint: "main" } });
  }

  /** Buffers that hold so many bytes: those of before, or larger ones. */
  private room(sizes: number[]): Buffers {
    if (this.buffers && sizes.every((size, k) => size <= (this.buffers?.sizes[k] ?? 0))) return this.buffers;
    for (const buffer of this.buffers ? [...this.buffers.parts, this.buffers.back] : []) buffer.destroy();
    const larger = sizes.map((size, k) => Math.max(256, Math.ceil(Math.max(size, this.buffers?.sizes[k] ?? 0) / 256) * 256));
    const make = (size: number, usage: number) => this.device.createBuffer({ size, usage });
    const { STORAGE, UNIFORM, COPY_DST, COPY_SRC, MAP_READ } = GPUBufferUsage;
    const usages = [STORAGE | COPY_DST, STORAGE | COPY_DST | COPY_SRC, STORAGE | COPY_DST | COPY_SRC, UNIFORM | COPY_DST];
    const parts = larger.map((size, k) => make(size, usages[k] as number));
    this.buffers = { sizes: larger, parts, back: make((larger[1] as number) + (larger[2] as number), MAP_READ | COPY_DST) };
    return this.buffers;
  }
}
