// The angles that the page makes of a log, as an angle log: node log_angles.mjs MODULE.wasm LOG [SETTING...]
//
// The module is called by the page's own code, lab/src/loop_module.ts.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { basename, dirname, join } from "node:path";
import { argv, stdout } from "node:process";
import { fileURLToPath } from "node:url";

const lab = join(dirname(fileURLToPath(import.meta.url)), "../../lab");
const { buildSync } = createRequire(join(lab, "package.json"))("esbuild");
const made = buildSync({ entryPoints: [join(lab, "src/loop_module.ts")], bundle: true, write: false, format: "esm", target: "es2022" });
const { LoopModule } = await import(`data:text/javascript;base64,${Buffer.from(made.outputFiles[0].text).toString("base64")}`);

globalThis.FileReaderSync = class {
    readAsArrayBuffer(bytes) {
        return bytes;
    }
};
const [wasm, log, ...settings] = argv.slice(2);
const bytes = readFileSync(log);
const file = { name: basename(log), size: bytes.length, slice: (from, to) => bytes.subarray(from, to) };

const module = await LoopModule.load(readFileSync(wasm));
module.open_log(file, settings);
const { tick_s } = module.log_facts();
const [view, columns] = [3, 13]; // log_run.hpp
const lines = ["tick,t_s,dtheta_arcsec,dtheta_final_arcsec,sigma_arcsec,mode,flags"];
for (let more = true; more; ) {
    more = module.advance_log(4096);
    const rows = module.rows(view);
    for (let at = 0; at < rows.length; at += columns) {
        const [tick, , delivered, final, sigma, flags, mode] = rows.subarray(at, at + columns);
        lines.push([tick, (tick + 1) * tick_s, delivered, final, sigma === Infinity ? "inf" : sigma, mode, flags].join(","));
    }
    module.calls.zlg_log_forget();
}
stdout.write(lines.join("\n") + "\n");
