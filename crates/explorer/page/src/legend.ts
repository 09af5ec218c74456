// What the colours of a map mean: its classes as buttons that show and hide, or a ramp between two numbers.

import { hex, type Scale, words } from "./colours";
import type { Class, Column } from "./sweep";

/** Draws the legend of a column; `toggled` is told of a class that is to be shown or hidden. */
export function legend(box: HTMLElement, column: Column, classes: Class[] | undefined, show: Scale | null, gaps: boolean, hidden: string[], toggled: (name: string) => void): void {
  if (column.names.length > 0) {
    const known = classes ?? column.names.map((name) => ({ name, label: name.replaceAll("_", " "), fill: "#888888" }));
    // The class that was chosen by a key keeps the focus.
    const focused = [...box.children].indexOf(document.activeElement as Element);
    box.textContent = "";
    for (const one of known) {
      const button = Object.assign(document.createElement("button"), { type: "button", className: "class", title: "Show or hide" });
      button.setAttribute("aria-pressed", String(!hidden.includes(one.name)));
      const swatch = Object.assign(document.createElement("span"), { className: "swatch" });
      swatch.style.background = one.fill;
      button.append(swatch, one.label);
      button.addEventListener("click", () => toggled(one.name));
      box.append(button);
    }
    (box.children[focused] as HTMLElement | undefined)?.focus();
    return;
  }
  const [low, high] = words(column, show?.ends ?? [0, 1]);
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [192, 1];
  const context = canvas.getContext("2d");
  if (context && show && show.classes.length === 0) {
    for (let k = 0; k < 192; k++) {
      context.fillStyle = hex(show.colour(show.ends[0] + (k / 191) * (show.ends[1] - show.ends[0])));
      context.fillRect(k, 0, 1, 1);
    }
  }
  box.replaceChildren(low, canvas, high);
  box.append(` ${column.print.replace(/[{}]/g, "")}`);
  if (gaps && show) {
    const swatch = Object.assign(document.createElement("span"), { className: "swatch" });
    swatch.style.background = hex(show.nothing);
    box.append(" ", swatch, " undefined");
  }
}
