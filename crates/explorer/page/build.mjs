// One file of page, styles, program and WebAssembly: node build.mjs [WASM] [PAGE].
import { build } from "esbuild";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const here = dirname(fileURLToPath(import.meta.url));
const [wasmPath, pagePath] = process.argv.slice(2);
if (!wasmPath || !pagePath) {
  console.error("usage: node build.mjs WASM PAGE; `crates/explorer/build` does it all");
  process.exit(2);
}

const bundle = async (entry, define) => {
  const built = await build({
    entryPoints: [join(here, "src", entry)],
    bundle: true,
    minify: true,
    write: false,
    format: "iife",
    target: "es2022",
    define,
    legalComments: "none",
  });
  // A program inside of HTML ends where this stands.
  return built.outputFiles[0].text.replaceAll("</script", "<\\/script");
};

const worker = await bundle("worker.ts", {});
const program = await bundle("main.ts", { WORKER: JSON.stringify(worker) });
const style = readFileSync(join(here, "src/style.css"), "utf8");
const wasm = gzipSync(readFileSync(wasmPath), { level: 9 }).toString("base64");

const fill = (page, name, text) => {
  const [before, after, ...more] = page.split(`<!--${name}-->`);
  if (after === undefined || more.length > 0) throw new Error(`index.html has to have <!--${name}--> once`);
  return before + text + after;
};
let page = readFileSync(join(here, "src/index.html"), "utf8");
page = fill(page, "style", `<style>${style}</style>`);
page = fill(page, "wasm", `<script id="wasm" type="application/octet-stream">${wasm}</script>`);
page = fill(page, "program", `<script>${program}</script>`);
if (page.split("<!--sweep-->").length !== 2) throw new Error("index.html has to have <!--sweep--> once");
mkdirSync(dirname(pagePath), { recursive: true });
writeFileSync(pagePath, page);
console.log(`${pagePath}: ${(page.length / 1e6).toFixed(2)} MB`);
