// What is drawn over a map: its axes, its lines, the place of the cell, and the pointer that two maps have in common.

import type { Piece } from "./lines";
import { ticks } from "./plots";
import { parameter, type State } from "./state";
import type { Mark } from "./strokes";
import { type About, plain, shown } from "./sweep";

/** Lines of one value, and the words beside them; borders of classes have none. */
export interface Lines {
  words: string;
  pieces: Piece[];
}

/** Draws over a map: its lines, measured strokes, and more; `pointer` is a place as parts of both sides from the lower left. */
export function marks(canvas: HTMLCanvasElement, about: About, state: State, lines: Lines[], strokes: Mark[], pointer: [number, number] | null): void {
  const scaleOf = window.devicePixelRatio || 1;
  const [w, h] = [canvas.clientWidth, canvas.clientHeight];
  canvas.width = Math.round(w * scaleOf);
  canvas.height = Math.round(h * scaleOf);
  const context = canvas.getContext("2d");
  if (!context) return;
  context.scale(scaleOf, scaleOf);
  context.font = "12px system-ui, sans-serif";
  const px = (x: number) => ((x - state.rangeX[0]) / (state.rangeX[1] - state.rangeX[0])) * w;
  const py = (y: number) => h - ((y - state.rangeY[0]) / (state.rangeY[1] - state.rangeY[0])) * h;
  /** Black on a light casing: to be seen on every colour. */
  const twice = (width: number, draw: () => void) => {
    for (const [colour, more] of [["#ffffff", 2.4], ["#000000", 0]] as const) {
      context.strokeStyle = colour;
      context.lineWidth = width + more;
      draw();
    }
  };
  const text = (words: string, x: number, y: number, align: CanvasTextAlign) => {
    context.textAlign = align;
    context.lineWidth = 4;
    context.strokeStyle = "#ffffff";
    context.strokeText(words, x, y);
    context.fillStyle = "#000000";
    context.fillText(words, x, y);
  };
  for (const { pieces } of lines) {
    const path = new Path2D();
    for (const [ax, ay, bx, by] of pieces) {
      path.moveTo(ax * w, (1 - ay) * h);
      path.lineTo(bx * w, (1 - by) * h);
    }
    twice(0.8, () => context.stroke(path));
  }
  for (const { words, pieces } of lines) {
    // Beside the piece nearest to the middle of the map.
    const away = ([ax, ay]: Piece) => Math.hypot(ax - 0.5, ay - 0.5);
    const near = words === "" ? undefined : pieces.reduce<Piece | undefined>((best, piece) => (best && away(best) <= away(piece) ? best : piece), undefined);
    if (near) text(words, Math.min(Math.max(near[0] * w, 24), w - 24), Math.min(Math.max((1 - near[1]) * h + 4, 30), h - 24), "center");
  }
  context.strokeStyle = "#000000";
  context.lineWidth = 1;
  for (const tick of ticks(...state.rangeX, 5)) {
    context.strokeStyle = "#000000";
    context.lineWidth = 1;
    context.strokeRect(px(tick), h - 6, 0.01, 6);
    if (px(tick) > 30 && px(tick) < w - 60) text(shown(tick, 6), px(tick), h - 9, "center");
  }
  for (const tick of ticks(...state.rangeY, 5)) {
    context.strokeStyle = "#000000";
    context.lineWidth = 1;
    context.strokeRect(0, py(tick), 6, 0.01);
    if (py(tick) > 26 && py(tick) < h - 24) text(shown(tick, 6), 9, py(tick) + 4, "left");
  }
  const [x, y] = [parameter(about, state.x), parameter(about, state.y)];
  if (x) text(plain(x), w - 8, h - 9, "right");
  if (y) text(plain(y), 9, 16, "left");
  const { cut } = state;
  if (cut) {
    twice(2, () => {
      context.setLineDash([7, 4]);
      context.beginPath();
      context.moveTo(px(cut[0]), py(cut[1]));
      context.lineTo(px(cut[2]), py(cut[3]));
      context.stroke();
    });
    context.setLineDash([]);
  }
  for (const { at, errors, fill, here } of strokes) {
    const [a, b] = [px(at[0]), py(at[1])];
    twice(1.2, () => {
      context.strokeRect(px(at[0] - errors[0]), b, px(at[0] + errors[0]) - px(at[0] - errors[0]), 0.01);
      context.strokeRect(a, py(at[1] + errors[1]), 0.01, py(at[1] - errors[1]) - py(at[1] + errors[1]));
    });
    context.beginPath();
    context.arc(a, b, 6, 0, 2 * Math.PI);
    context.fillStyle = here ? fill : "#ffffff";
    context.fill();
    // A hollow one has its colour as a ring.
    for (const [colour, width] of here ? ([["#ffffff", 4], ["#000000", 1.6]] as const) : ([["#000000", 4.5], [fill, 2.5]] as const)) {
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.beginPath();
      context.arc(a, b, 6, 0, 2 * Math.PI);
      context.stroke();
    }
  }
  if (pointer) {
    const [a, b] = [pointer[0] * w, (1 - pointer[1]) * h];
    twice(1, () => {
      context.strokeRect(a, 0, 0.01, h);
      context.strokeRect(0, b, w, 0.01);
    });
  }
  if (state.cell) {
    const [a, b] = [px(state.cell[0]), py(state.cell[1])];
    twice(1.6, () => {
      context.beginPath();
      context.arc(a, b, 7, 0, 2 * Math.PI);
      context.stroke();
    });
  }
}
