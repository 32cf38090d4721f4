// Calls the module of the closed loop as a page does: node --no-warnings call_module.mjs zlg_loop.wasm
// Reads the calls from standard input, [["configure", "text"], ["advance", 10], ...], and prints, as JSON, what each gave: the time in
// seconds after it, or the message of a refusal; "memory_bytes" gives what the module has. A list of numbers in place of a text is its
// bytes.
import { readFile } from "node:fs/promises";
import { argv, stdin } from "node:process";
import { text } from "node:stream/consumers";
import { WASI } from "node:wasi";

const wasi = new WASI({ version: "preview1" });
const { instance } = await WebAssembly.instantiate(await readFile(argv[2]), wasi.getImportObject());
wasi.initialize(instance);
const loop = instance.exports;

function hand_over(text) {
    const bytes = typeof text === "string" ? new TextEncoder().encode(text) : Uint8Array.from(text);
    // The memory may move when the module asks for more: it is looked up after the call.
    const place = loop.zlg_text(bytes.length);
    new Uint8Array(loop.memory.buffer, place, bytes.length).set(bytes);
}

function configure(text) {
    hand_over(text);
    return loop.zlg_configure();
}

function message() {
    const place = loop.zlg_message();
    return new TextDecoder().decode(new Uint8Array(loop.memory.buffer, place, loop.zlg_message_bytes()));
}

const answer = (is_done) => (is_done ? loop.zlg_time_s() : message());
const calls = {
    configure: (settings) => answer(configure(settings)),
    advance: (halves) => answer(loop.zlg_advance(halves)),
    memory_bytes: () => loop.memory.buffer.byteLength,
};
console.log(JSON.stringify(JSON.parse(await text(stdin)).map(([name, value]) => calls[name](value))));
