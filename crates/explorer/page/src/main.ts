// The page: what is asked for by hand, and where it goes.

import { CELL, type Choice, Engines } from "./ask";
import { Basin } from "./basin";
import { columnsOf, masses, plots, rows, sound, taken, why, type Cell } from "./cell";
import { along, cuts } from "./cut";
import { PLACES, stateOf } from "./gallery";
import type { Progress } from "./map";
import { Side } from "./side";
import { closed, first, is_allowed, kept_within, parameter, read, type State, sides, whole, written } from "./state";
import { said, strokes } from "./strokes";
import { type About, escape, type Given, plain, shown, symbol } from "./sweep";

const element = <T extends HTMLElement>(id: string): T => {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no #${id}`);
  return found as T;
};

const say = (text: string) => {
  element("status").textContent = text;
};

/** Where the cells of a map come from, that shows a run. */
function from(program: string, ofRun: number, cells: number, count: string): string {
  if (ofRun === 0) return "Computed: the run has nothing of this.";
  const all = ofRun === cells ? `all of ${cells.toLocaleString("en")} ${count}` : `${ofRun.toLocaleString("en")} of ${cells.toLocaleString("en")} ${count}; the others are computed`;
  return `From the run of ${program.replace(/([0-9a-f]{10})[0-9a-f]+/, "$1")}: ${all}.`;
}

/** Bytes of a text in base 64, unpacked. */
async function unpacked(text: string): Promise<Uint8Array> {
  const packed = Uint8Array.from(atob(text.trim()), (sign) => sign.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

async function main(): Promise<void> {
  const given = document.getElementById("sweep")?.textContent;
  if (!given) return say("no sweep is in this page; `squealmap explore SWEEP --export DIR` writes one that has");
  if (typeof WebAssembly === "undefined" || typeof DecompressionStream === "undefined")
    return say("this browser is too old: it has no WebAssembly or cannot unpack it; any of 2023 or later can");
  const { description, file, classes } = JSON.parse(given) as Given;
  const wasm = await unpacked(element("wasm").textContent ?? "");
  const [engines, about] = await Engines.open(wasm, description);
  new Page(engines, about.head as unknown as About, file, classes).start();
}

/** The group of questions about the line across the map. */
const LINE = 5;

/** What a cut does not depend on. */
const UNRELATED = { hidden: [], beside: "", hiddenBeside: [], lines: false, strokes: [] };

/** What the second map shows. */
const beside = (state: State): State => ({ ...state, quantity: state.beside, hidden: state.hiddenBeside });

class Page {
  private state: State;
  /** The map, and the one beside it. */
  private readonly first: Side;
  private readonly second: Side;
  private readonly basin: Basin;
  private cell: Cell | null = null;
  private cellAsked = 0;
  private cut = "";
  private line = "";
  /** The values along it. */
  private acrossValues: Float64Array | null = null;
  /** Whether the next drag draws a line across the map. */
  private draws = false;
  private moving = 0;
  private sliderOf = new Map<string, HTMLInputElement[]>();

  constructor(
    private readonly engines: Engines,
    private readonly about: About,
    private readonly file: string,
    private readonly classes: Given["classes"],
  ) {
    this.state = first(about);
    const made = (ids: [string, string, string], group: number, toggled: (name: string) => void, told: (progress: Progress) => void) => {
      const [canvas, marks, legend] = ids;
      const elements = { canvas: element<HTMLCanvasElement>(canvas), marks: element<HTMLCanvasElement>(marks), legend: element(legend) };
      return new Side(elements, engines, about, classes, group, toggled, told, say);
    };
    const without = (names: string[], name: string) => (names.includes(name) ? names.filter((other) => other !== name) : [...names, name]);
    this.first = made(["map", "marks", "legend"], 1, (name) => this.go({ ...this.state, hidden: without(this.state.hidden, name) }), (progress) => this.told(progress));
    this.second = made(["map-beside", "marks-beside", "legend-beside"], 3, (name) => this.go({ ...this.state, hiddenBeside: without(this.state.hiddenBeside, name) }), () => undefined);
    this.basin = new Basin(element<HTMLCanvasElement>("basin"), element("basin-words"), engines, about, classes["regime"] ?? [], (start) => this.from(start));
  }

  /** Takes another start from the basin of a cell. */
  private from([start_displacement, start_velocity]: [number, number]): void {
    this.go({ ...this.state, at: { ...this.state.at, start_displacement, start_velocity } });
    this.sliders();
  }

  private get view() {
    return this.first.view;
  }

  private told({ cells, of, seconds, ofRun }: Progress): void {
    const done = cells >= of;
    const { response } = this.view.column(this.state.quantity);
    const count = response ? "transients" : "cells";
    say(`${cells.toLocaleString("en")} of ${of.toLocaleString("en")} ${count}, ${seconds.toFixed(2)} s on ${this.engines.by(response)}${done ? "" : " …"}`);
    const run = this.engines.program?.told.run;
    element("source").textContent = run && this.engines.takesProgram() ? from(run.program, ofRun, cells, count) : "";
    if (done) {
      void this.along();
      void this.across();
    }
  }

  /** The maps that are shown. */
  private maps(): Side[] {
    return this.state.beside === "" ? [this.first] : [this.first, this.second];
  }

  /** Computes what is shown anew. */
  private again(): void {
    this.view.again(this.state);
    if (this.state.beside !== "") this.second.view.again(beside(this.state));
  }

  start(): void {
    document.title = this.about.title || "squealmap";
    element("title").textContent = this.about.title || "Map";
    this.take();
    this.controls();
    this.handle();
    this.engine();
    this.gallery();
    this.go(this.state, false);
    window.addEventListener("hashchange", () => {
      if (location.hash === written(this.state)) return;
      this.take();
      this.controls();
      this.go(this.state, false);
    });
    // What tests and the curious look at.
    Object.assign(window, { squealmap: { page: this, state: () => this.state, view: this.view, beside: this.second.view, basin: this.basin, about: this.about, engines: this.engines, places: PLACES } });
  }

  /** Places that are worth a look, where the sweep has them. */
  private gallery(): void {
    const links = PLACES.flatMap((place) => {
      const state = stateOf(this.about, place);
      return state ? [`<li><a href="${escape(written(state))}">${escape(place.title)}</a>. ${escape(place.words)}</li>`] : [];
    });
    element("gallery").hidden = links.length === 0;
    element("places").innerHTML = links.join("");
  }

  /** The choice of what computes. */
  private engine(): void {
    const choice = element<HTMLSelectElement>("engine");
    const show = () => {
      const { device, noDevice, count, program, noProgram } = this.engines;
      const gpu = device ? `${device.name}${device.isSoftware ? ", software" : ""}` : "no GPU";
      const served = program || noProgram ? [["program", program ? `this program (${program.told.by})` : `this program, but ${noProgram}`]] : [];
      const isThere = (value: string | undefined) => (value === "gpu" ? device !== null : value !== "program" || program !== null);
      choice.title = noProgram ? `The program does not answer: ${noProgram}` : device ? `Transients on ${gpu}` : noDevice;
      choice.innerHTML = [
        ...served,
        ["auto", "automatic"],
        ["gpu", `GPU (${gpu})`],
        ["cpu", `${count} engines on the CPU`],
      ]
        .map(([value, words]) => `<option value="${value}"${value === this.engines.choice ? " selected" : ""}${isThere(value) ? "" : " disabled"}>${escape(words ?? "")}</option>`)
        .join("");
    };
    choice.addEventListener("change", () => {
      this.engines.choice = choice.value as Choice;
      this.again();
    });
    let before = this.engines.program;
    this.engines.changed = () => {
      // Questions of a size for other engines are asked anew.
      if (before !== this.engines.program) this.again();
      before = this.engines.program;
      if (!this.engines.device && this.engines.choice === "gpu") this.engines.choice = "auto";
      show();
    };
    show();
  }

  private take(): void {
    const { state, wrong } = read(this.about, location.hash);
    this.state = state;
    element("wrong").textContent = wrong.length > 0 ? `The address is not all understood: ${wrong.join("; ")}.` : "";
  }

  /** Shows another state. */
  go(state: State, write = true): void {
    const before = this.state;
    this.state = closed(this.about, state);
    if (write) history.replaceState(null, "", written(this.state));
    this.first.show(this.state);
    element("draw-cut").textContent = this.state.cut ? "Remove the cut" : "Draw a cut";
    if (!this.state.cut) element("across-map").hidden = true;
    element("measured").textContent = said(this.state);
    element("strokes").textContent = this.state.strokes.length > 0 ? "Remove strokes" : "Add strokes";
    const isTwo = this.state.beside !== "";
    element("beside-map").hidden = !isTwo;
    element("maps").classList.toggle("two", isTwo);
    if (isTwo) this.second.show(beside(this.state));
    const same = JSON.stringify([before.cell, before.at]) === JSON.stringify([this.state.cell, this.state.at]);
    if (!this.state.cell) this.leave();
    else if (!same || !this.cell) void this.look();
  }

  /** No cell is looked into, also of those that were asked for. */
  private leave(): void {
    this.cellAsked++;
    this.stop();
    this.cell = null;
    this.basin.clear();
    element("cell").hidden = true;
    element("hint").hidden = false;
  }

  private controls(): void {
    const option = (value: string, text: string, chosen: boolean) => `<option value="${escape(value)}"${chosen ? " selected" : ""}>${escape(text)}</option>`;
    const swept = new Set(this.about.axes.map((axis) => axis.key));
    const shownColumns = this.about.columns.filter((column) => !swept.has(column.name) && column.name !== "status" && column.name !== "steps");
    const group = (chosen: string, label: string, response: boolean) => {
      const of = shownColumns.filter((column) => column.response === response);
      return of.length === 0 ? "" : `<optgroup label="${label}">${of.map((column) => option(column.name, column.print.replace(/[{}]/g, ""), column.name === chosen)).join("")}</optgroup>`;
    };
    const quantities = (chosen: string) => group(chosen, "Eigenvalues", false) + (this.about.responds ? group(chosen, "Transients", true) : "");
    element("quantity").innerHTML = quantities(this.state.quantity);
    element("beside").innerHTML = option("", "nothing", this.state.beside === "") + quantities(this.state.beside);
    element<HTMLInputElement>("lines").checked = this.state.lines;
    const axes = sides(this.about);
    for (const [id, key] of [["across", this.state.x], ["up", this.state.y]] as const)
      element(id).innerHTML = axes.map((axis) => option(axis.key, plain({ symbol: axis.symbol, unit: axis.unit }), axis.key === key)).join("");
    this.sliders();
  }

  private sliders(): void {
    const box = element("sliders");
    box.textContent = "";
    this.sliderOf.clear();
    const add = (key: string, html: string, title: string, value: number, [low, high]: [number, number]) => {
      const label = document.createElement("label");
      label.innerHTML = html;
      label.title = title;
      label.htmlFor = `slider-${key}`;
      const slider = Object.assign(document.createElement("input"), { type: "range", min: "0", max: "1000", step: "1", id: `slider-${key}` });
      const number = Object.assign(document.createElement("input"), { type: "number", step: "any", value: String(value) });
      number.setAttribute("aria-label", `${key}, a number`);
      slider.value = String(Math.round((1000 * (value - low)) / (high - low || 1)));
      const set = (chosen: number) => {
        const of = parameter(this.about, key);
        if (!of || !is_allowed(of, chosen)) return say(`\`${key}\` is ${chosen}, and has to be ${of?.range ?? "a number"}`);
        this.go({ ...this.state, at: { ...this.state.at, [key]: chosen } });
      };
      slider.addEventListener("input", () => {
        const chosen = Number((low + (Number(slider.value) / 1000) * (high - low)).toPrecision(5));
        number.value = String(chosen);
        set(chosen);
      });
      number.addEventListener("change", () => {
        slider.value = String(Math.round((1000 * (Number(number.value) - low)) / (high - low || 1)));
        if (number.value.trim() !== "") set(Number(number.value));
      });
      box.append(label, slider, number);
    };
    for (const axis of this.about.axes) {
      if (axis.key === this.state.x || axis.key === this.state.y) continue;
      if (!axis.numbers) {
        const label = Object.assign(document.createElement("label"), { textContent: axis.key, htmlFor: `slider-${axis.key}` });
        const select = Object.assign(document.createElement("select"), { id: `slider-${axis.key}` });
        for (const value of axis.values) select.append(new Option(String(value), String(value), false, value === this.state.at[axis.key]));
        select.addEventListener("change", () => this.go({ ...this.state, at: { ...this.state.at, [axis.key]: select.value } }));
        box.append(label, select, document.createElement("span"));
        continue;
      }
      add(axis.key, `${symbol(axis)} ${escape(axis.unit)}`, axis.meaning, Number(this.state.at[axis.key]), whole(this.about, axis.key));
    }
    for (const fixed of this.about.fixed) {
      const value = Number(this.state.at[fixed.key] ?? fixed.value);
      const size = Math.abs(fixed.value) || (fixed.most !== null && fixed.least !== null ? fixed.most : 1);
      const low = Math.max(fixed.least ?? -Infinity, fixed.value === 0 ? -size : fixed.value - size);
      const high = Math.min(fixed.most ?? Infinity, fixed.value + size);
      // An end that lies outside is a thousandth away.
      const range: [number, number] = [is_allowed(fixed, low) ? low : low + size / 1000, is_allowed(fixed, high) ? high : high - size / 1000];
      add(fixed.key, `${symbol(fixed)} ${escape(fixed.unit)}`, fixed.meaning, value, range);
    }
  }

  /** The values at a place of the map, as parts of both sides from the lower left. */
  private at([x, y]: [number, number]): [number, number] {
    const value = ([low, high]: [number, number], part: number) => low + part * (high - low);
    return [value(this.state.rangeX, x), value(this.state.rangeY, y)];
  }

  private handle(): void {
    const choose = (id: string, take: (value: string) => void) => element<HTMLSelectElement>(id).addEventListener("change", (event) => take((event.target as HTMLSelectElement).value));
    choose("quantity", (quantity) => this.go({ ...this.state, quantity, hidden: [] }));
    choose("beside", (beside) => this.go({ ...this.state, beside, hiddenBeside: [] }));
    element<HTMLInputElement>("lines").addEventListener("change", (event) => this.go({ ...this.state, lines: (event.target as HTMLInputElement).checked }));
    const side = (of: "x" | "y") => (key: string) => {
      const [kept, other] = of === "x" ? [this.state.y, this.state.x] : [this.state.x, this.state.y];
      const opposite = kept === key ? other : kept;
      const [x, y] = of === "x" ? [key, opposite] : [opposite, key];
      this.state = closed(this.about, { ...this.state, cut: null, x, y, rangeX: whole(this.about, x), rangeY: whole(this.about, y), cell: null });
      this.leave();
      this.controls();
      this.go(this.state);
    };
    choose("across", side("x"));
    choose("up", side("y"));
    element("home").addEventListener("click", () => this.go({ ...this.state, rangeX: whole(this.about, this.state.x), rangeY: whole(this.about, this.state.y) }));
    for (const { elements } of [this.first, this.second]) this.pointer(elements.canvas);
    const line = element("draw-cut");
    line.addEventListener("click", () => {
      this.draws = !this.draws && this.state.cut === null;
      if (this.state.cut) this.go({ ...this.state, cut: null });
      line.setAttribute("aria-pressed", String(this.draws));
      void this.across();
      if (this.draws) say("drag across the map, from one end of the cut to the other; or set `cut=` in the address");
    });
    const file = element<HTMLInputElement>("strokes-file");
    element("strokes").addEventListener("click", () => {
      if (this.state.strokes.length > 0) this.go({ ...this.state, strokes: [] });
      else file.click();
    });
    file.addEventListener("change", async () => {
      const [chosen] = file.files ?? [];
      file.value = "";
      if (!chosen) return;
      try {
        if (chosen.size > 1 << 20) throw new Error(`${chosen.name} has ${chosen.size} bytes, and a table of strokes has at most ${1 << 20}`);
        this.go({ ...this.state, strokes: strokes(this.about, await chosen.text()) });
      } catch (why) {
        say(why instanceof Error ? why.message : String(why));
      }
    });
    const copy = (id: string, text: () => Promise<string> | string, done: string) =>
      element(id).addEventListener("click", async () => {
        try {
          await navigator.clipboard.writeText(await text());
          say(done);
        } catch (why) {
          say(why instanceof Error ? why.message : String(why));
        }
      });
    copy("toml", () => this.toml(), "the sweep of this view is copied: save it as view.toml, and `squealmap run view.toml` computes it");
    copy("command", () => this.command(), "the command is copied");
    copy("address", () => location.href, "the address is copied");
    element("picture").addEventListener("click", () => {
      const all = this.maps().map(({ elements }) => elements);
      const [wide, high] = [all[0]?.canvas.width ?? 1, all[0]?.canvas.height ?? 1];
      const both = Object.assign(document.createElement("canvas"), { width: wide * all.length, height: high });
      const context = both.getContext("2d");
      all.forEach(({ canvas, marks }, place) => {
        for (const layer of [canvas, marks]) context?.drawImage(layer, place * wide, 0, wide, high);
      });
      const link = Object.assign(document.createElement("a"), { href: both.toDataURL("image/png"), download: "map.png" });
      link.click();
    });
    element("close").addEventListener("click", () => {
      this.go({ ...this.state, cell: null });
    });
    element("hear").addEventListener("click", () => this.hear());
    element("move").addEventListener("click", () => this.move());
  }

  /** The sweep of the view, as a sweep file. */
  async toml(): Promise<string> {
    const column = this.view.column(this.state.quantity);
    const points = column.response ? 101 : 401;
    const side = (key: string, [from, to]: [number, number]) => ({ key, from, to, points });
    const question = {
      ask: "file",
      x: side(this.state.x, this.state.rangeX),
      y: side(this.state.y, this.state.rangeY),
      at: this.state.at,
      response: column.response,
      columns: [],
    };
    return String((await this.engines.ask(question)).head["toml"]);
  }

  /** The command that shows the cell, or computes the sweep. */
  command(): string {
    const at = { ...this.state.at };
    if (!this.state.cell) return `squealmap run ${this.file}`;
    const pairs = Object.entries({ ...at, [this.state.x]: this.state.cell[0], [this.state.y]: this.state.cell[1] }).map(([key, value]) => `${key}=${value}`);
    return `squealmap trace ${this.file} --at ${pairs.join(",")}`;
  }

  private pointer(canvas: HTMLCanvasElement): void {
    const held = new Map<number, [number, number]>();
    const from = new Map<number, [number, number]>();
    let moved = 0;
    const place = (event: { clientX: number; clientY: number }): [number, number] => {
      const box = canvas.getBoundingClientRect();
      return [(event.clientX - box.left) / box.width, 1 - (event.clientY - box.top) / box.height];
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      held.set(event.pointerId, place(event));
      from.set(event.pointerId, place(event));
      moved = 0;
    });
    canvas.addEventListener("pointermove", (event) => {
      const now = place(event);
      const before = held.get(event.pointerId);
      if (!before) return this.read(now);
      const box = canvas.getBoundingClientRect();
      if (this.draws || event.shiftKey) {
        const ends = [...this.at(from.get(event.pointerId) ?? before), ...this.at(now)].map((end) => Number(end.toPrecision(6)));
        held.set(event.pointerId, now);
        moved = Infinity;
        return this.go({ ...this.state, cut: ends as [number, number, number, number] });
      }
      moved += Math.hypot((now[0] - before[0]) * box.width, (now[1] - before[1]) * box.height);
      const others = [...held].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
      held.set(event.pointerId, now);
      const other = others[0];
      if (other) {
        const apart = (a: [number, number], b: [number, number]) => Math.hypot(a[0] - b[0], a[1] - b[1]);
        this.zoom(apart(before, other) / Math.max(apart(now, other), 1e-3), other);
      } else if (moved > 4) this.pan(before[0] - now[0], before[1] - now[1]);
    });
    const up = (event: PointerEvent) => {
      const here = held.get(event.pointerId);
      held.delete(event.pointerId);
      if (this.draws && this.state.cut) {
        this.draws = false;
        element("draw-cut").setAttribute("aria-pressed", "false");
      }
      if (this.state.cut) void this.across();
      if (event.type === "pointerup" && here && moved <= 4 && held.size === 0) this.pick(here);
    };
    canvas.addEventListener("pointerup", up);
    canvas.addEventListener("pointercancel", up);
    canvas.addEventListener("pointerleave", () => {
      element("readout").textContent = "";
      for (const side of this.maps()) side.point(null);
    });
    canvas.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        this.zoom(Math.exp(Math.sign(event.deltaY) * Math.min(Math.abs(event.deltaY), 100) * 0.003), place(event));
      },
      { passive: false },
    );
    canvas.addEventListener("keydown", (event) => {
      const step: Record<string, [number, number]> = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] };
      const by = step[event.key];
      if (by) this.pan(...by);
      else if (event.key === "+" || event.key === "=") this.zoom(0.8, [0.5, 0.5]);
      else if (event.key === "-") this.zoom(1.25, [0.5, 0.5]);
      else if (event.key === "Enter") this.pick([0.5, 0.5]);
      else return;
      event.preventDefault();
    });
  }

  private pan(dx: number, dy: number): void {
    const by = (key: string, [low, high]: [number, number], part: number): [number, number] => {
      const shift = part * (high - low);
      const moved = kept_within(this.about, key, [low + shift, high + shift]);
      // At the end of what is allowed the range keeps its length.
      return moved && Math.abs(moved[1] - moved[0] - (high - low)) < 1e-9 * (high - low) ? moved : [low, high];
    };
    this.go({ ...this.state, rangeX: by(this.state.x, this.state.rangeX, dx), rangeY: by(this.state.y, this.state.rangeY, dy) });
  }

  private zoom(by: number, [x, y]: [number, number]): void {
    const to = (key: string, [low, high]: [number, number], part: number): [number, number] => {
      const at = low + part * (high - low);
      return kept_within(this.about, key, [at - part * by * (high - low), at + (1 - part) * by * (high - low)]) ?? [low, high];
    };
    this.go({ ...this.state, rangeX: to(this.state.x, this.state.rangeX, x), rangeY: to(this.state.y, this.state.rangeY, y) });
  }

  /** The instance of a run that every map shows at a place; nothing where one shows a cell of the view. */
  private instance(place: [number, number]): [number, number] | undefined {
    const [first, ...others] = this.maps().map((side) => side.view.instance(...place));
    return others.every((other) => other?.join() === first?.join()) ? first : undefined;
  }

  private read(place: [number, number]): void {
    const [a, b] = this.instance(place) ?? this.at(place);
    const [x, y] = [parameter(this.about, this.state.x), parameter(this.about, this.state.y)];
    const unit = (of: { unit: string } | undefined) => (of?.unit ? ` ${of.unit}` : "");
    element("readout").textContent = `${this.state.x} = ${shown(a, 5)}${unit(x)}, ${this.state.y} = ${shown(b, 5)}${unit(y)}: ${this.maps().map((side) => side.said(place)).join(", ")}`;
    // One map needs no second pointer.
    if (this.state.beside !== "") for (const side of this.maps()) side.point(place);
  }

  /** Looks into the cell at a place of the map. */
  pick(place: [number, number]): void {
    const rounded = this.at(place).map((value) => Number(value.toPrecision(6))) as [number, number];
    this.go({ ...this.state, cell: this.instance(place) ?? rounded });
  }

  private async look(): Promise<void> {
    const { cell } = this.state;
    const asked = ++this.cellAsked;
    this.stop();
    if (!cell) return;
    const at = { ...this.state.at, [this.state.x]: cell[0], [this.state.y]: cell[1] };
    const responds = this.about.responds;
    const side = (key: string, value: number) => ({ key, from: value, to: value, points: 1 });
    const columns = columnsOf(this.about, responds);
    const region = {
      ask: "region",
      x: side(this.state.x, cell[0]),
      y: side(this.state.y, cell[1]),
      at: this.state.at,
      response: responds,
      columns: columns.map((column) => column.name),
    };
    const motion = { ask: "cell", at, skipped: responds ? 400 : 0, periods: responds ? 12 : 0, samples: 80 };
    try {
      const [answer, numbers] = await Promise.all([this.engines.ask(motion, CELL), this.engines.ask(region, CELL)]);
      if (asked !== this.cellAsked) return;
      this.cell = taken(answer);
      const type = columns.findIndex((column) => column.name === "type");
      const name = columns[type]?.names[numbers.numbers[type] ?? NaN];
      element("why").textContent = why(this.cell, name);
      element("plots").innerHTML = plots(this.cell, this.belt());
      element("numbers").innerHTML = rows(columns, numbers.numbers);
      element("cell").hidden = false;
      element("hint").hidden = true;
      masses(element("masses"), this.cell, this.belt(), 0);
      element("basin-of").hidden = !this.basin.isThere();
      void this.basin.show(this.state, this.cell.period, this.belt()).catch((why: unknown) => say(why instanceof Error ? why.message : String(why)));
      void this.along();
    } catch (why) {
      say(why instanceof Error ? why.message : String(why));
    }
  }

  /** The map along the line across it, once the map itself is there. */
  private async across(): Promise<void> {
    const of = JSON.stringify({ ...this.state, ...UNRELATED, cell: null });
    element("across-map").hidden = this.state.cut === null;
    if (!this.state.cut || of === this.line) return;
    this.line = of;
    this.engines.drop(LINE);
    const drawn = await along(this.engines, this.about, this.state, LINE).catch(() => null);
    if (of !== this.line) return;
    this.acrossValues = drawn?.values ?? null;
    element("line-cut").innerHTML = drawn?.plot ?? "";
  }

  /** The map along its sides through the cell, once the map itself is there. */
  private async along(): Promise<void> {
    const of = JSON.stringify({ ...this.state, ...UNRELATED, cut: null });
    if (!this.state.cell || of === this.cut) return;
    this.cut = of;
    const drawn = await cuts(this.engines, this.about, this.state, CELL).catch(() => "");
    if (of === this.cut) element("cuts").innerHTML = drawn;
  }

  private belt(): number {
    const of = this.state.x === "belt_velocity" ? this.state.cell?.[0] : this.state.y === "belt_velocity" ? this.state.cell?.[1] : this.state.at["belt_velocity"];
    const fixed = this.about.fixed.find((one) => one.key === "belt_velocity");
    return Number(of ?? fixed?.value ?? 0);
  }

  private hear(): void {
    const context = new AudioContext();
    const wave = this.cell && sound(this.cell, context.sampleRate);
    if (!wave) return say("nothing moves here, so that nothing is heard");
    const buffer = context.createBuffer(1, wave.length, context.sampleRate);
    buffer.copyToChannel(wave as Float32Array<ArrayBuffer>, 0);
    const source = new AudioBufferSourceNode(context, { buffer });
    source.connect(context.destination);
    source.onended = () => void context.close();
    source.start();
  }

  private stop(): void {
    cancelAnimationFrame(this.moving);
    this.moving = 0;
    element("move").setAttribute("aria-pressed", "false");
  }

  /** The masses move, a period in two seconds. */
  private move(): void {
    if (this.moving !== 0) return this.stop();
    const cell = this.cell;
    const t = cell?.motion["t"];
    if (!cell || !t || t.length < 2) return;
    element("move").setAttribute("aria-pressed", "true");
    const began = performance.now();
    const length = (t[t.length - 1] as number) - (t[0] as number);
    const frame = (now: number) => {
      const time = (t[0] as number) + (((now - began) / 2000) * cell.period) % length;
      let [low, high] = [0, t.length - 1];
      while (low < high) {
        const middle = (low + high) >> 1;
        if ((t[middle] as number) < time) low = middle + 1;
        else high = middle;
      }
      masses(element("masses"), cell, this.belt(), low);
      this.moving = requestAnimationFrame(frame);
    };
    this.moving = requestAnimationFrame(frame);
  }
}

main().catch((why: unknown) => say(why instanceof Error ? why.message : String(why)));

