/**
 * Builds what `foon_asp/explorer/` holds, byte for byte the same from the same sources and pins:
 *
 * - `page.html`: the page with its program and style, and marks where `foon_asp/render/explorer.py` puts data and workers;
 * - `clingo-worker.js`, `graphviz-worker.js`, `clingo.wasm`: what works beside the page;
 * - `LICENSES.txt`: what is inside, and under which terms.
 */

import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { readFileSync, readdirSync, writeFileSync, mkdirSync, copyFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const target = process.argv[2] ?? join(here, "..", "foon_asp", "explorer");
const read = (...path) => readFileSync(join(here, ...path), "utf8");

/** One digest of all that the built files depend on; `tests/unit/test_explorer.py` computes it again. */
function digest() {
  const files = readdirSync(join(here, "src"), { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => relative(here, join(entry.parentPath, entry.name)).replaceAll("\\", "/"));
  const hash = createHash("sha256");
  for (const file of [...files, "build.mjs", "package.json", "package-lock.json", "tsconfig.json", "licences.txt"].sort()) {
    hash.update(`${file}\n`).update(createHash("sha256").update(readFileSync(join(here, file))).digest("hex")).update("\n");
  }
  return hash.digest("hex");
}

async function bundle(entry) {
  const result = await build({
    entryPoints: [join(here, "src", entry)],
    absWorkingDir: here,
    bundle: true,
    minify: true,
    write: false,
    format: "iife",
    platform: "browser",
    target: ["es2022", "chrome105", "firefox113", "safari16.4"],
    charset: "ascii",
    legalComments: "none",
    // A worker from a Blob has no address that could lead anywhere.
    define: { "import.meta.url": '"about:blank"' },
    external: ["node:module", "node:fs", "node:path", "node:url"],
    logLevel: "warning",
  });
  const text = result.outputFiles[0].text.trim();
  if (/<\/(script|style)|<!--/i.test(text)) throw new Error(`${entry}: what is built would end the block it stands in`);
  return text;
}

/** Put each text where its mark is, whatever signs it has. */
const filled = (template, texts) => template.replaceAll(/@([A-Z_]+)@/g, (mark, name) => texts[name] ?? mark);
const hashed = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

// Types are checked first: what does not fit is not built.
execFileSync(process.execPath, [join(here, "node_modules", "typescript", "bin", "tsc"), "-p", here], { stdio: "inherit" });

const program = await bundle("main.ts");
const style = await bundle("style.css");
const policy = [
  "default-src 'none'",
  `script-src ${hashed(program)} 'wasm-unsafe-eval'`,
  `style-src ${hashed(style)}`,
  "worker-src blob:",
  "connect-src blob:",
  "base-uri 'none'",
  "form-action 'none'",
].join("; ");

mkdirSync(target, { recursive: true });
const page = filled(read("src", "page.html"), { CSP: policy, DIGEST: digest(), STYLE: style, PROGRAM: program });
writeFileSync(join(target, "page.html"), page);
writeFileSync(join(target, "clingo-worker.js"), `${await bundle("solve/worker.ts")}\n`);
writeFileSync(join(target, "graphviz-worker.js"), `${await bundle("layout.worker.ts")}\n`);
copyFileSync(join(here, "node_modules", "clingo-wasm", "dist", "clingo.wasm"), join(target, "clingo.wasm"));
writeFileSync(join(target, "LICENSES.txt"), read("licences.txt") + read("node_modules", "clingo-wasm", "LICENSE"));
