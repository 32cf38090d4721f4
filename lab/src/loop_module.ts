// The WebAssembly module of the closed loop, behind typed calls. What each does stands in lab/module/module.cpp.

import type { Schema } from "./protocol";

export const enum View {
    signals,
    angles,
    switches,
}

const now_numbers = 12;

interface Exports {
    memory: WebAssembly.Memory;
    _initialize(): void;
    zlg_text(bytes: number): number;
    zlg_configure(): number;
    zlg_other(wanted: number): void;
    zlg_advance(halves: number): number;
    zlg_turn(rate_arcsec_s: number): number;
    zlg_let_go(): void;
    zlg_time_s(): number;
    zlg_run_halves(): number;
    zlg_halves(): number;
    zlg_fingerprint(): number;
    zlg_rows(view: number): number;
    zlg_rows_numbers(view: number): number;
    zlg_forget(): void;
    zlg_now(): number;
    zlg_schema(): void;
    zlg_changed(): void;
    zlg_message(): number;
    zlg_message_bytes(): number;
}

const wasi_success = 0;
const wasi_no_such_call = 52;

// What the C library asks of a system: there are neither files nor arguments, and nothing is printed.
function imports(module: WebAssembly.Module, memory: () => WebAssembly.Memory): WebAssembly.Imports {
    const zero_two = (first: number, second: number) => {
        const view = new DataView(memory().buffer);
        view.setUint32(first, 0, true);
        view.setUint32(second, 0, true);
        return wasi_success;
    };
    const known: Record<string, (...words: number[]) => number> = {
        environ_sizes_get: (count, bytes) => zero_two(count, bytes),
        environ_get: () => wasi_success,
        proc_exit: (status) => {
            throw new Error(`the module has ended with status ${status}`);
        },
    };
    const system: Record<string, (...words: number[]) => number> = {};
    for (const wanted of WebAssembly.Module.imports(module))
        system[wanted.name] = known[wanted.name] ?? (() => wasi_no_such_call);
    return { wasi_snapshot_preview1: system };
}

export class Refusal extends Error {}

export class LoopModule {
    private constructor(private readonly exports: Exports) {}

    static async load(code: BufferSource): Promise<LoopModule> {
        const module = await WebAssembly.compile(code);
        let exports: Exports | null = null;
        const instance = await WebAssembly.instantiate(module, imports(module, () => exports!.memory));
        exports = instance.exports as unknown as Exports;
        exports._initialize();
        return new LoopModule(exports);
    }

    // A new gyro, of one setting a line. Throws a Refusal with the program's message, and the gyro before stays.
    //
    // other  the settings, over these, of a second gyro on the same motion; null: there is none.
    configure(settings: readonly string[], other: readonly string[] | null = null): void {
        this.hand_over(other ?? []);
        this.exports.zlg_other(other === null ? 0 : 1);
        this.hand_over(settings);
        this.done(this.exports.zlg_configure());
    }

    advance(halves: number): void {
        this.done(this.exports.zlg_advance(halves));
    }

    // From now on the case also turns at this rate, until the next call; gyros that are configured later repeat it.
    turn(rate_arcsec_s: number): void {
        this.done(this.exports.zlg_turn(rate_arcsec_s));
    }

    // All turns are forgotten.
    let_go(): void {
        this.exports.zlg_let_go();
    }

    time_s(): number {
        return this.exports.zlg_time_s();
    }

    halves(): number {
        return this.exports.zlg_halves();
    }

    // Of run.duration_s.
    run_halves(): number {
        return this.exports.zlg_run_halves();
    }

    fingerprint(): string {
        const place = this.exports.zlg_fingerprint();
        return place === 0 ? "" : this.text(place, 16);
    }

    // The rows of a view since `forget`, a copy: flat, in the columns of live_run.hpp.
    rows(view: View): Float64Array {
        const numbers = this.exports.zlg_rows_numbers(view);
        return new Float64Array(this.exports.memory.buffer, this.exports.zlg_rows(view), numbers).slice();
    }

    forget(): void {
        this.exports.zlg_forget();
    }

    now(): Float64Array {
        return new Float64Array(this.exports.memory.buffer, this.exports.zlg_now(), now_numbers).slice();
    }

    // The table of keys.
    schema(): Schema {
        this.exports.zlg_schema();
        return JSON.parse(this.message()) as Schema;
    }

    // What differs from the defaults, as `section.key=value`.
    changed(): string[] {
        this.exports.zlg_changed();
        return this.message()
            .split("\n")
            .filter((line) => line !== "");
    }

    private hand_over(settings: readonly string[]): void {
        const bytes = new TextEncoder().encode(settings.join("\n"));
        // The memory may move when the module asks for more: it is looked up after the call.
        const place = this.exports.zlg_text(bytes.length);
        new Uint8Array(this.exports.memory.buffer, place, bytes.length).set(bytes);
    }

    private message(): string {
        return this.text(this.exports.zlg_message(), this.exports.zlg_message_bytes());
    }

    private text(place: number, bytes: number): string {
        return new TextDecoder().decode(new Uint8Array(this.exports.memory.buffer, place, bytes));
    }

    private done(status: number): void {
        if (status !== 1) throw new Refusal(this.message());
    }
}
