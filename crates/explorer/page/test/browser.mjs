// The page in a browser, for tests: PAGE is what `explore` wrote, MAP the map.csv of the same sweep, CURVED the page of a sweep with
// an exponential law, PROGRAM the program that serves, CHROMIUM the browser.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";
import puppeteer from "puppeteer-core";

const { PAGE, MAP, CURVED, CHROMIUM = "/usr/bin/chromium" } = process.env;
assert.ok(PAGE && MAP, "PAGE and MAP have to name files; crates/explorer/check does");
export const address = pathToFileURL(PAGE).href;
export const curved = CURVED && pathToFileURL(CURVED).href;

export const launch = (...args) => puppeteer.launch({ executablePath: CHROMIUM, args: ["--no-sandbox", ...args], protocolTimeout: 600000 });

export const launchFirefox = () => puppeteer.launch({ browser: "firefox", executablePath: process.env.FIREFOX, protocolTimeout: 600000 });

/** Waits until the map is whole. */
export const whole = (page) => page.waitForFunction(() => window.squealmap && Number.isFinite(window.squealmap.view.times.last), { timeout: 240000, polling: 50 });

export const open = async (page, hash = "", of = address) => {
  await page.goto("about:blank");
  await page.goto(of + hash);
  await whole(page);
};

/** The types of the whole map, asked of the page, and the rows of the program's table beside them: how many there are and differ. */
export async function labels(page) {
  const [head, ...rows] = readFileSync(MAP, "utf8").trim().split("\n").map((line) => line.split(","));
  const place = (name) => head.indexOf(name);
  const values = (name) => [...new Set(rows.map((row) => Number(row[place(name)])))];
  const [mu_s, mu_d, belts] = ["mu_s", "mu_d", "belt_velocity"].map(values);
  const found = await page.evaluate(
    async ([mu_s, mu_d, belts]) => {
      const side = (key, values) => ({ key, from: values[0], to: values.at(-1), points: values.length });
      const names = window.squealmap.about.columns.find((column) => column.name === "type").names;
      const all = {};
      for (const belt of belts) {
        const region = { ask: "region", x: side("mu_d", mu_d), y: side("mu_s", mu_s), at: { belt_velocity: belt }, response: false, columns: ["type"] };
        all[belt] = Array.from((await window.squealmap.engines.ask(region)).numbers, (code) => names[code]);
      }
      return all;
    },
    [mu_s, mu_d, belts],
  );
  const other = () =>
    rows.filter((row) => {
      const [a, b, v] = ["mu_s", "mu_d", "belt_velocity"].map((name) => Number(row[place(name)]));
      return found[v][mu_s.indexOf(a) * mu_d.length + mu_d.indexOf(b)] !== row[place("type")];
    }).length;
  const differ = other();
  // The comparer sees a planted fault.
  found[belts[0]][0] = "nothing";
  assert.equal(other(), differ + 1);
  return { rows: rows.length, differ };
}

const servers = [];

/** Serves a sweep or a run: where, once it listens, and how to end it. */
export async function serve(source, ...options) {
  assert.ok(process.env.PROGRAM, "PROGRAM has to name the program; crates/explorer/check does");
  const child = spawn(process.env.PROGRAM, ["explore", source, "--no-open", "--backend", "cpu", ...options], { stdio: ["ignore", "pipe", "inherit"] });
  servers.push(child);
  const ended = new Promise((resolve) => child.once("exit", resolve));
  for await (const line of createInterface({ input: child.stdout })) return { address: line.split(" ")[0], end: () => (child.kill("SIGKILL"), ended) };
  throw new Error("the server ended before it began");
}

export const endServers = () => servers.forEach((child) => child.kill("SIGKILL"));
