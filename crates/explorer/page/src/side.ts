// One of the maps that are side by side: its picture, what is drawn over it, and its legend.

import type { Engines } from "./ask";
import { legend } from "./legend";
import { borders, isoline, places } from "./lines";
import { type Level, MapView, type Progress } from "./map";
import { type Lines, marks } from "./marks";
import { ticks } from "./plots";
import type { State } from "./state";
import { marksOf } from "./strokes";
import { type About, type Class, type Column, shown } from "./sweep";

/** About so many lines of equal value. */
const LINES = 7;

/** The elements of a map. */
export interface Elements {
  canvas: HTMLCanvasElement;
  marks: HTMLCanvasElement;
  legend: HTMLElement;
}

export class Side {
  readonly view: MapView;
  private state: State | null = null;
  private pointer: [number, number] | null = null;
  private lines: { of: Level; all: Lines[] } | null = null;

  constructor(
    readonly elements: Elements,
    engines: Engines,
    private readonly about: About,
    private readonly classes: Record<string, Class[]>,
    group: number,
    private readonly toggled: (name: string) => void,
    told: (progress: Progress) => void,
    failed: (why: string) => void,
  ) {
    this.view = new MapView(elements.canvas, engines, about, classes, group, told, failed);
    elements.canvas.addEventListener("painted", () => {
      if (!this.state) return;
      if (this.column().names.length === 0) this.legend();
      if (this.state.lines) this.draw();
    });
    new ResizeObserver(() => this.state && this.show({ ...this.state, rangeX: [...this.state.rangeX] })).observe(elements.canvas);
  }

  private column(): Column {
    return this.view.column(this.state?.quantity ?? "");
  }

  /** Shows a state, in which the map has its own quantity. */
  show(state: State): void {
    this.state = state;
    this.view.show(state);
    this.legend();
    this.draw();
  }

  /** The place of the pointer, on whichever map it is. */
  point(at: [number, number] | null): void {
    this.pointer = at;
    this.draw();
  }

  /** The value at a place, in words. */
  said(place: [number, number]): string {
    const column = this.column();
    const value = this.view.value(...place);
    if (value === undefined) return `${column.name} is not computed yet`;
    return `${column.name} = ${column.names.length > 0 ? (column.names[value] ?? "–").replaceAll("_", " ") : `${shown(value, 5)} ${column.unit}`.trim()}`;
  }

  private legend(): void {
    if (this.state) legend(this.elements.legend, this.column(), this.classes[this.column().name], this.view.current, this.view.undefinedCells, this.state.hidden, this.toggled);
  }

  private draw(): void {
    if (this.state) marks(this.elements.marks, this.about, this.state, this.state.lines ? this.found(this.state) : [], marksOf(this.state, this.classes["type"] ?? []), this.pointer);
  }

  /** The lines of the finest cells that are all there. */
  private found(state: State): Lines[] {
    const level = this.view.finest();
    if (!level) return [];
    if (this.lines?.of === level) return this.lines.all;
    const [x, y] = [places(level.wide, state.rangeX, level.own?.x), places(level.high, state.rangeY, level.own?.y)];
    const column = this.column();
    // Its own: the scale of the picture is that of the last frame.
    let [low, high] = [Infinity, -Infinity];
    for (const value of level.values) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
    const most = column.unit === "deg" ? 180 : Infinity;
    const all =
      column.names.length > 0
        ? [{ words: "", pieces: borders(level, x, y) }]
        : ticks(low, high, LINES).map((value) => ({ words: shown(value, 4), pieces: isoline(level, x, y, value, most) }));
    this.lines = { of: level, all };
    return all;
  }
}
