// The map: coarse first, then fine, anew whenever the view moves; what is known stays until better is there.

import type { Answer, Engines } from "./ask";
import { NOTHING, type Scale, scale } from "./colours";
import { nearest, own, type Own, ownRegion } from "./own";
import type { State } from "./state";
import type { About, Class, Column } from "./sweep";

/** Sides of cells in pixels of the screen, one level after the other. */
const OF_EIGENVALUES = [16, 4, 1];
const OF_TRANSIENTS = [32, 16, 8, 4];

/** A level of the map: values row by row from below. */
export interface Level {
  wide: number;
  high: number;
  values: Float64Array;
  /** Rows that are there. */
  known: Uint8Array;
  /** Where the cells stand, if not evenly over the view. */
  own?: Own;
}

/** What the map says while it is computed. */
export interface Progress {
  cells: number;
  of: number;
  seconds: number;
  /** Cells that a run had computed already. */
  ofRun: number;
}

export class MapView {
  private generation = 0;
  private levels: Level[] = [];
  private shownState: State | null = null;
  private picture: HTMLCanvasElement | null = null;
  private pictureOf: State | null = null;
  private drawing = false;
  current: Scale | null = null;
  /** Whether something that is shown is undefined. */
  undefinedCells = false;
  private currentOf = "";
  /** Seconds until the first and the last picture of the last view. */
  times: { first: number; last: number } = { first: NaN, last: NaN };

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly engines: Engines,
    private readonly about: About,
    private readonly classes: Record<string, Class[]>,
    /** The group of its questions. */
    private readonly group: number,
    private readonly told: (progress: Progress) => void,
    private readonly failed: (why: string) => void,
  ) {}

  column(name: string): Column {
    const found = this.about.columns.find((column) => column.name === name) ?? this.about.columns[0];
    if (!found) throw new Error("the sweep has no columns");
    return found;
  }

  /** Shows a state; computes what is not known. */
  show(state: State): void {
    const before = this.shownState;
    this.shownState = state;
    if (before && same(before, state) && this.levels.length > 0 && !this.isResized()) {
      this.draw();
      return;
    }
    if (this.picture === null || before === null || before.x !== state.x || before.y !== state.y) this.pictureOf = null;
    void this.compute(state);
  }

  /** Pixels of the screen that the map has. */
  private pixels(): [number, number] {
    const scaleOf = window.devicePixelRatio || 1;
    return [Math.max(1, Math.round(this.canvas.clientWidth * scaleOf)), Math.max(1, Math.round(this.canvas.clientHeight * scaleOf))];
  }

  private isResized(): boolean {
    const [w, h] = this.pixels();
    return this.canvas.clientWidth > 0 && (this.canvas.width !== w || this.canvas.height !== h);
  }

  /** Computes a state anew. */
  again(state: State): void {
    this.shownState = state;
    void this.compute(state);
  }

  private async compute(state: State): Promise<void> {
    const generation = ++this.generation;
    this.engines.drop(this.group);
    this.keep();
    this.levels = [];
    this.draw();
    const began = performance.now();
    this.times = { first: NaN, last: NaN };
    const column = this.column(state.quantity);
    const scaleOf = window.devicePixelRatio || 1;
    const [w, h] = this.pixels();
    if (this.canvas.width !== w || this.canvas.height !== h) {
      this.canvas.width = w;
      this.canvas.height = h;
    }
    const run = this.engines.takesProgram() ? this.engines.program?.told.run : null;
    const ofRun = run ? own(this.about, run, state, column) : null;
    const sides = ofRun?.whole ? [] : (column.response ? OF_TRANSIENTS : OF_EIGENVALUES).map((side) => Math.max(1, Math.round(side * (column.response ? scaleOf : 1))));
    const most = this.engines.atOnce(column.response);
    // What is coarser than the run shows less than it.
    const least = ofRun ? ofRun.x.length * ofRun.y.length : 0;
    const levels: { wide: number; high: number; own?: Own }[] = sides.map((side) => ({ wide: Math.ceil(w / side), high: Math.ceil(h / side) })).filter(({ wide, high }) => wide * high > least);
    if (ofRun) levels.unshift({ wide: ofRun.x.length, high: ofRun.y.length, own: ofRun });
    const all = levels.map(({ wide, high }) => wide * high).reduce((a, b) => a + b, 0);
    let [done, taken] = [0, 0];
    for (const { wide, high, own } of levels) {
      const level: Level = { wide, high, values: new Float64Array(wide * high).fill(NaN), known: new Uint8Array(high), ...(own ? { own } : {}) };
      const rows = Math.max(1, Math.floor(most / wide));
      const jobs: Promise<void>[] = [];
      for (let row = 0; row < high; row += rows) {
        const count = Math.min(rows, high - row);
        const question = own ? ownRegion(state, column, own, [row, count]) : region(state, column, [wide, high], [row, count], !run);
        jobs.push(
          this.engines.ask(question, this.group).then((answer: Answer) => {
            if (generation !== this.generation) return;
            level.values.set(answer.numbers, row * wide);
            level.known.fill(1, row, row + count);
            done += wide * count;
            taken += Number(answer.head["of_run"] ?? 0);
            this.told({ cells: done, of: all, seconds: (performance.now() - began) / 1000, ofRun: taken });
            this.draw();
          }),
        );
      }
      this.levels.push(level);
      try {
        await Promise.all(jobs);
      } catch (why) {
        if (generation === this.generation) {
          this.engines.drop(this.group);
          this.failed(why instanceof Error ? why.message : String(why));
        }
        return;
      }
      if (generation !== this.generation) return;
      if (Number.isNaN(this.times.first)) this.times.first = (performance.now() - began) / 1000;
      // Coarser levels are of no more use.
      this.levels = [level];
    }
    this.times.last = (performance.now() - began) / 1000;
    this.draw();
    this.told({ cells: all, of: all, seconds: this.times.last, ofRun: taken });
  }

  /** Keeps what is drawn, to be shown where nothing newer is. */
  private keep(): void {
    if (!this.current || this.levels.length === 0 || !this.drawnState) return;
    const kept = document.createElement("canvas");
    kept.width = this.canvas.width;
    kept.height = this.canvas.height;
    kept.getContext("2d")?.drawImage(this.canvas, 0, 0);
    this.picture = kept;
    this.pictureOf = this.drawnState;
  }

  private drawnState: State | null = null;

  /** Draws once before the next frame. */
  private draw(): void {
    if (this.drawing) return;
    this.drawing = true;
    requestAnimationFrame(() => {
      this.drawing = false;
      this.paint();
    });
  }

  private paint(): void {
    const state = this.shownState;
    const context = this.canvas.getContext("2d");
    if (!state || !context) return;
    const { width, height } = this.canvas;
    const column = this.column(state.quantity);
    let [low, high] = [Infinity, -Infinity];
    this.undefinedCells = false;
    for (const level of this.levels) {
      level.values.forEach((value, place) => {
        if (Number.isFinite(value)) {
          if (value < low) low = value;
          if (value > high) high = value;
        } else if (level.known[Math.floor(place / level.wide)]) this.undefinedCells = true;
      });
    }
    // Until there are values the scale of the picture that is shown stays.
    const kept = this.current && this.currentOf === column.name ? this.current.ends : ([0, 1] as [number, number]);
    const colours = scale(column, this.classes[column.name], low <= high ? [low, high] : kept, state.hidden);
    [this.current, this.currentOf] = [colours, column.name];
    context.imageSmoothingEnabled = false;
    context.fillStyle = "#ffffff";
    context.fillRect(0, 0, width, height);
    const before = this.pictureOf;
    if (this.picture && before && before.x === state.x && before.y === state.y && before.quantity === state.quantity && before.hidden.join() === state.hidden.join()) {
      const [x0, x1] = part(before.rangeX, state.rangeX);
      const [y0, y1] = part(before.rangeY, state.rangeY);
      context.drawImage(this.picture, x0 * width, (1 - y1) * height, (x1 - x0) * width, (y1 - y0) * height);
    }
    let any = false;
    for (const coarse of this.levels) {
      const level = coarse.own ? spread(coarse, coarse.own, state, [width, height]) : coarse;
      const image = new ImageData(level.wide, level.high);
      let rows = 0;
      for (let row = 0; row < level.high; row++) {
        if (!level.known[row]) continue;
        rows++;
        for (let at = 0; at < level.wide; at++) {
          const [r, g, b] = colours.colour(level.values[row * level.wide + at] as number) ?? NOTHING;
          const pixel = 4 * ((level.high - 1 - row) * level.wide + at);
          image.data[pixel] = r;
          image.data[pixel + 1] = g;
          image.data[pixel + 2] = b;
          image.data[pixel + 3] = 255;
        }
      }
      if (rows === 0) continue;
      any = true;
      const small = new OffscreenCanvas(level.wide, level.high);
      small.getContext("2d")?.putImageData(image, 0, 0);
      context.drawImage(small, 0, 0, width, height);
    }
    if (any) this.drawnState = state;
    this.canvas.dispatchEvent(new Event("painted"));
  }

  /** The finest cell that is known at a place, as parts of both sides from the lower left: its level and its column and row there. */
  private found(x: number, y: number): [Level, number, number] | undefined {
    for (const level of [...this.levels].reverse()) {
      const state = this.shownState;
      const part = (values: number[], [low, high]: [number, number], at: number) => nearest(values, [low + at * (high - low), low + at * (high - low)], 1)[0] ?? 0;
      const row = level.own && state ? part(level.own.y, state.rangeY, y) : Math.floor(y * level.high);
      const at = level.own && state ? part(level.own.x, state.rangeX, x) : Math.floor(x * level.wide);
      if (row >= 0 && row < level.high && at >= 0 && at < level.wide && level.known[row]) return [level, at, row];
    }
    return undefined;
  }

  /** The value at a place; nothing where none is known. */
  value(x: number, y: number): number | undefined {
    const [level, at, row] = this.found(x, y) ?? [undefined, 0, 0];
    return level?.values[row * level.wide + at];
  }

  /** The instance of a run whose value is shown at a place; nothing where a cell of the view is. */
  instance(x: number, y: number): [number, number] | undefined {
    const [level, at, row] = this.found(x, y) ?? [undefined, 0, 0];
    return level?.own && [level.own.x[at] as number, level.own.y[row] as number];
  }

  /** The finest level that is whole, for tests and pictures. */
  finest(): Level | undefined {
    return [...this.levels].reverse().find((level) => level.known.every((known) => known === 1));
  }
}

/** The cells of a run over the pixels of a view: each pixel has the nearest. */
function spread(level: Level, { x, y }: Own, state: State, [wide, high]: [number, number]): Level {
  const [across, up] = [nearest(x, state.rangeX, wide), nearest(y, state.rangeY, high)];
  const values = new Float64Array(wide * high);
  const known = new Uint8Array(high);
  up.forEach((from, row) => {
    known[row] = level.known[from] ?? 0;
    across.forEach((at, to) => {
      values[row * wide + to] = level.values[from * level.wide + at] as number;
    });
  });
  return { wide, high, values, known };
}

/** Whether two states have the same cells. */
function same(a: State, b: State): boolean {
  const of = (state: State) => JSON.stringify([state.x, state.y, state.rangeX, state.rangeY, state.quantity, state.at]);
  return of(a) === of(b);
}

/** Where an older range lies in a newer one, as parts of it. */
function part(old: [number, number], now: [number, number]): [number, number] {
  const length = now[1] - now[0];
  return [(old[0] - now[0]) / length, (old[1] - now[0]) / length];
}

/** The question about rows of a level: each cell by its middle; transients in f32 where that is wanted. */
export function region(state: State, column: Column, [wide, high]: [number, number], [row, rows]: [number, number], f32: boolean): object {
  const middle = ([low, high]: [number, number], place: number, of: number) => low + ((place + 0.5) / of) * (high - low);
  return {
    ask: "region",
    x: { key: state.x, from: middle(state.rangeX, 0, wide), to: middle(state.rangeX, wide - 1, wide), points: wide },
    y: { key: state.y, from: middle(state.rangeY, row, high), to: middle(state.rangeY, row + rows - 1, high), points: rows },
    at: state.at,
    response: column.response,
    f32: f32 && column.response,
    columns: [column.name],
  };
}
