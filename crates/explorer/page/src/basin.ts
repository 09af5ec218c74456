// Where motions from other starts end: the plane of displacement and velocity of the tangential mass, coloured by regime.

import type { Engines } from "./ask";
import { type Colour, NOTHING, parsed } from "./colours";
import { parameter, type State } from "./state";
import { type About, type Class, escape, shown } from "./sweep";

/** Starts along each side, one level after the other. */
// Even, so that none of them starts at rest in the equilibrium itself.
const POINTS = [10, 34];

/** Starts of one question. */
const AT_ONCE = 99;

/** The group of its questions. */
const GROUP = 4;

const [ACROSS, UP] = ["start_displacement", "start_velocity"] as const;

/** A start: displacement, m, and velocity, m/s. */
export type Start = [number, number];

interface Grid {
  points: number;
  /** Half of both sides, SI. */
  reach: Start;
  values: Float64Array;
}

export class Basin {
  private grid: Grid | null = null;
  private start: Start = [0, 0];
  /** A start, and its own regime. */
  private exact: { start: Start; regime: string } | null = null;
  private generation = 0;
  private held = false;
  /** How much closer the plane is looked at. */
  private closer = 1;
  private shown: Parameters<Basin["show"]> | null = null;
  private readonly names: string[];
  private readonly fills: Colour[];

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly words: HTMLElement,
    private readonly engines: Engines,
    private readonly about: About,
    private readonly classes: Class[],
    private readonly chosen: (start: Start) => void,
  ) {
    this.names = about.columns.find((column) => column.name === "regime")?.names ?? [];
    this.fills = this.names.map((name) => parsed(classes.find((one) => one.name === name)?.fill ?? "#888888"));
    this.handle();
  }

  /** Whether the sweep starts with a kick, and has transients. */
  isThere(): boolean {
    return this.names.length > 0 && this.about.responds && [ACROSS, UP].every((key) => parameter(this.about, key) !== undefined);
  }

  /** Shows where other starts of a cell end, whose motion has a period, s, on a belt of a velocity, m/s. */
  async show(state: State, period: number, belt: number): Promise<void> {
    const generation = ++this.generation;
    this.engines.drop(GROUP);
    this.shown = [state, period, belt];
    if (!this.isThere() || !state.cell) return;
    const all: State["at"] = { ...state.at, [state.x]: state.cell[0], [state.y]: state.cell[1] };
    const value = (key: string) => Number(all[key] ?? this.about.fixed.find((one) => one.key === key)?.value ?? 0);
    this.start = [value(ACROSS), value(UP)];
    const { [ACROSS]: _, [UP]: __, ...at } = all;
    // As far as a motion that reaches the velocity of the belt, and the start with room around it.
    const perSecond = (2 * Math.PI) / (period > 0 ? period : 1);
    const velocity = Math.max(1.5 * Math.abs(belt), 1.2 * Math.abs(this.start[1]), 1.2 * perSecond * Math.abs(this.start[0])) || 1;
    const reach: Start = [velocity / perSecond, velocity].map((one) => Number((one / this.closer).toPrecision(3))) as Start;
    this.grid = null;
    this.paint();
    const { start } = this;
    const one = (key: string, value: number) => ({ key, from: value, to: value, points: 1 });
    const itself = { ask: "region", x: one(ACROSS, start[0]), y: one(UP, start[1]), at, response: true, columns: ["regime"] };
    const { numbers: own } = await this.engines.ask(itself, GROUP);
    if (generation !== this.generation) return;
    this.exact = { start, regime: this.names[own[0] ?? NaN] ?? "nothing" };
    for (const points of POINTS) {
      const values = new Float64Array(points * points).fill(NaN);
      const rows = Math.max(1, Math.floor(AT_ONCE / points));
      const place = (half: number, k: number) => half * (-1 + (2 * k) / (points - 1));
      const jobs: Promise<void>[] = [];
      for (let row = 0; row < points; row += rows) {
        const count = Math.min(rows, points - row);
        const question = {
          ask: "region",
          x: { key: ACROSS, from: -reach[0], to: reach[0], points },
          y: { key: UP, from: place(reach[1], row), to: place(reach[1], row + count - 1), points: count },
          ...{ at, response: true, f32: true, columns: ["regime"] },
        };
        jobs.push(this.engines.ask(question, GROUP).then(({ numbers }) => values.set(numbers, row * points)));
      }
      await Promise.all(jobs);
      if (generation !== this.generation) return;
      this.grid = { points, reach, values };
      this.paint();
    }
  }

  /** Nothing is shown any more. */
  clear(): void {
    this.generation++;
    this.engines.drop(GROUP);
    this.grid = this.shown = null;
    this.closer = 1;
  }

  private zoom(by: number): void {
    this.closer = Math.min(Math.max(this.closer * by, 0.1), 1000);
    if (this.shown) void this.show(...this.shown).catch((why: unknown) => (this.words.textContent = why instanceof Error ? why.message : String(why)));
  }

  /** The regime from a start, of the nearest that is known. */
  at([x, v]: Start): string | undefined {
    if (!this.grid) return undefined;
    const { points, reach, values } = this.grid;
    if (Math.abs(x) > reach[0] || Math.abs(v) > reach[1]) return undefined;
    const place = (value: number, half: number) => Math.min(Math.max(Math.round(((value / half + 1) / 2) * (points - 1)), 0), points - 1);
    return this.names[values[place(v, reach[1]) * points + place(x, reach[0])] ?? NaN];
  }

  private paint(): void {
    const context = this.canvas.getContext("2d");
    if (!context) return;
    const { width, height } = this.canvas;
    context.fillStyle = "#ffffff";
    context.fillRect(0, 0, width, height);
    if (!this.grid) {
      this.words.textContent = "Transients from other starts are computed …";
      return;
    }
    const { points, reach, values } = this.grid;
    const image = new ImageData(points, points);
    values.forEach((value, k) => {
      const colour = Number.isNaN(value) ? NOTHING : (this.fills[value] ?? NOTHING);
      image.data.set([...colour, 255], 4 * ((points - 1 - Math.floor(k / points)) * points + (k % points)));
    });
    const small = new OffscreenCanvas(points, points);
    small.getContext("2d")?.putImageData(image, 0, 0);
    context.imageSmoothingEnabled = false;
    // Starts are points: the outer ones stand on the edge, half a cell beyond it is cut off.
    const [w, h] = [width / (points - 1), height / (points - 1)];
    context.drawImage(small, -w / 2, -h / 2, width + w, height + h);
    const [x, y] = [((this.start[0] / reach[0] + 1) / 2) * width, ((1 - this.start[1] / reach[1]) / 2) * height];
    for (const [colour, wide] of [["#ffffff", 5], ["#000000", 2]] as const) {
      context.strokeStyle = colour;
      context.lineWidth = wide;
      context.beginPath();
      context.arc(x, y, 8, 0, 2 * Math.PI);
      context.stroke();
    }
    const found = this.names.filter((_, code) => values.includes(code));
    const swatch = (name: string) => {
      const one = this.classes.find((known) => known.name === name);
      return `<span class="swatch" style="background:${escape(one?.fill ?? "#888888")}"></span>${escape(one?.label ?? name)}`;
    };
    const [mm, v] = this.start;
    const isOwn = this.exact !== null && this.exact.start[0] === mm && this.exact.start[1] === v;
    const ends = isOwn ? this.exact?.regime : this.at(this.start);
    const about = isOwn ? "" : ends === undefined ? " lies outside of the plane" : ", by the nearest of these starts";
    this.words.innerHTML =
      `Across x2 from −${shown(1e3 * reach[0], 3)} to ${shown(1e3 * reach[0], 3)} mm, up ẋ2 from −${shown(reach[1], 3)} to ${shown(reach[1], 3)} m/s, from the sliding equilibrium: ` +
      `${found.map(swatch).join(", ")}. From ${shown(1e3 * mm, 3)} mm and ${shown(v, 3)} m/s${about}${ends === undefined ? "" : `: ${escape(ends.replaceAll("_", " "))}`}.`;
  }

  private handle(): void {
    let before: Start = [0, 0];
    const take = (event: PointerEvent) => {
      if (!this.grid) return;
      const box = this.canvas.getBoundingClientRect();
      const part = (at: number, length: number) => Math.min(Math.max(at / length, 0), 1);
      const [x, y] = [part(event.clientX - box.left, box.width), part(event.clientY - box.top, box.height)];
      this.move([(2 * x - 1) * this.grid.reach[0], (1 - 2 * y) * this.grid.reach[1]]);
    };
    const down = new Set<number>();
    this.canvas.addEventListener("pointerdown", (event) => {
      down.add(event.pointerId);
      // Two fingers take no start.
      if (down.size > 1) {
        if (this.held) this.move(before);
        this.held = false;
        return;
      }
      this.held = this.grid !== null;
      before = this.start;
      this.canvas.setPointerCapture(event.pointerId);
      take(event);
    });
    this.canvas.addEventListener("pointermove", (event) => this.held && take(event));
    this.canvas.addEventListener("pointerup", (event) => {
      down.delete(event.pointerId);
      if (this.held) this.chosen(this.start);
      this.held = false;
    });
    this.canvas.addEventListener("pointercancel", (event) => {
      down.delete(event.pointerId);
      if (this.held) this.move(before);
      this.held = false;
    });
    this.canvas.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        this.zoom(event.deltaY < 0 ? 1.25 : 0.8);
      },
      { passive: false },
    );
    this.canvas.addEventListener("keydown", (event) => {
      if (event.key === "+" || event.key === "-") return this.zoom(event.key === "+" ? 1.5 : 1 / 1.5);
      if (!this.grid) return;
      const step: Record<string, Start> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
      const by = step[event.key];
      const { reach } = this.grid;
      const to = (k: 0 | 1) => Math.min(Math.max(this.start[k] + ((by?.[k] ?? 0) * reach[k]) / 16, -reach[k]), reach[k]);
      if (by) this.move([to(0), to(1)]);
      else if (event.key === "Enter") this.chosen(this.start);
      else return;
      event.preventDefault();
    });
  }

  private move([x, v]: Start): void {
    this.start = [Number(x.toPrecision(3)), Number(v.toPrecision(3))];
    this.paint();
  }
}
