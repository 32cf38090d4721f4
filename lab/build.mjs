// Builds the lab page: node build.mjs MODULE.wasm OUT.html
//
// Everything lies in the one file: style sheet, script, the worker's script, the module (gzipped, by zopfli where it is installed, in base64). The content security policy
// allows these scripts and styles by their hashes, and no request.
import { spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { argv } from "node:process";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { buildSync } from "esbuild";

const [module_path, out] = argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));

function bundled(entry, format) {
    const made = buildSync({
        entryPoints: [join(here, "src", entry)],
        bundle: true,
        minify: true,
        write: false,
        format,
        target: "es2022",
        legalComments: "none",
        absWorkingDir: here,
    });
    // Within an element `</script` would end it.
    return made.outputFiles[0].text.trim().replaceAll("</script", "<\\/script");
}

function hash(text) {
    return `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
}

const script = bundled("main.ts", "iife");
const worker = bundled("worker.ts", "iife");
const uplot_style = readFileSync(join(here, "node_modules/uplot/dist/uPlot.min.css"), "utf8").trim();
const style = `${uplot_style}\n${readFileSync(join(here, "style.css"), "utf8")}`;
const by_zopfli = spawnSync("zopfli", ["-c", "--i5", module_path], { maxBuffer: 1e8 });
if (by_zopfli.status !== 0) console.log("zopfli is not installed: the page is larger by a thirtieth");
const module = (by_zopfli.status === 0 ? by_zopfli.stdout : gzipSync(readFileSync(module_path), { level: 9 })).toString("base64");
const notices = readFileSync(join(here, "notices.txt"), "utf8").replaceAll("&", "&amp;").replaceAll("<", "&lt;");
// The worker's script is checked by the same rule as the page's own.
const policy = [
    "default-src 'none'",
    `script-src ${hash(script)} 'wasm-unsafe-eval' blob:`,
    "worker-src blob:",
    `style-src ${hash(style)}`,
    "img-src data: blob:",
    "base-uri 'none'",
    "form-action 'none'",
].join("; ");

const parts = { policy, style, notices, module, worker, script };
const page = readFileSync(join(here, "page.html"), "utf8").replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);
try {
    writeFileSync(out, page);
} catch (error) {
    rmSync(out, { force: true }); // the file appears whole or not at all
    throw error;
}

const size = (text) => `${Math.round(gzipSync(text).length / 1024)} kB`;
console.log(`${out}: ${Math.round(page.length / 1024)} kB; gzipped: script ${size(script)}, worker ${size(worker)}, module ${Math.round((module.length * 3) / 4 / 1024)} kB`);
