// The WebAssembly module of the closed loop, behind typed calls. What each does stands in lab/module/module.cpp.

import type { Schema } from "./protocol";
import { PageFile, System } from "./system";

export const enum View {
    signals,
    angles,
    switches,
    log_ticks,
    log_switches,
}

const now_numbers = 12;

// What answers with a number is called as it is.
interface Exports {
    memory: WebAssembly.Memory;
    _initialize(): void;
    zlg_text(bytes: number): number;
    zlg_configure(): number;
    zlg_advance(halves: number): number;
    zlg_turn(rate_arcsec_s: number): number;
    zlg_let_go(): void; // all turns are forgotten
    zlg_time_s(): number;
    zlg_run_halves(): number; // of run.duration_s
    zlg_halves(): number;
    zlg_fingerprint(): number;
    zlg_rows(view: number): number;
    zlg_rows_numbers(view: number): number;
    zlg_forget(): void;
    zlg_now(): number;
    zlg_schema(): void;
    zlg_changed(): void;
    zlg_log(): number;
    zlg_log_advance(rows: number): number;
    zlg_log_forget(): void;
    zlg_log_fraction(): number;
    zlg_log_facts(): void;
    zlg_message(): number;
    zlg_message_bytes(): number;
}

export interface LogFacts {
    kind: "raw" | "angles";
    tick_s: number;
    notes: string[]; // a line each
    settings: string[]; // that differ from the defaults
}

export class Refusal extends Error {}

export class LoopModule {
    private constructor(
        readonly calls: Exports,
        private readonly system: System,
    ) {}

    static async load(code: BufferSource): Promise<LoopModule> {
        const module = await WebAssembly.compile(code);
        const system = new System();
        const instance = await WebAssembly.instantiate(module, system.imports(module));
        const exports = instance.exports as unknown as Exports;
        system.memory = exports.memory;
        exports._initialize();
        return new LoopModule(exports, system);
    }

    // A new gyro, of one setting a line. Throws a Refusal with the program's message, and the gyro before stays.
    configure(settings: readonly string[]): void {
        this.hand_over(settings);
        this.done(this.calls.zlg_configure());
    }

    advance(halves: number): void {
        this.done(this.calls.zlg_advance(halves));
    }

    // From now on the case also turns at this rate, until the next call; gyros that are configured later repeat it.
    turn(rate_arcsec_s: number): void {
        this.done(this.calls.zlg_turn(rate_arcsec_s));
    }

    fingerprint(): string {
        const place = this.calls.zlg_fingerprint();
        return place === 0 ? "" : this.text(place, 16);
    }

    // The rows of a view since `forget`, a copy: flat, in the columns of live_run.hpp.
    rows(view: View): Float64Array {
        const numbers = this.calls.zlg_rows_numbers(view);
        return new Float64Array(this.calls.memory.buffer, this.calls.zlg_rows(view), numbers).slice();
    }

    now(): Float64Array {
        return new Float64Array(this.calls.memory.buffer, this.calls.zlg_now(), now_numbers).slice();
    }

    // The table of keys.
    schema(): Schema {
        this.calls.zlg_schema();
        return JSON.parse(this.message()) as Schema;
    }

    // What differs from the defaults, as `section.key=value`.
    changed(): string[] {
        this.calls.zlg_changed();
        return this.message()
            .split("\n")
            .filter((line) => line !== "");
    }

    // A log, with these settings over its own. Throws a Refusal with the program's message.
    open_log(file: File, settings: readonly string[]): void {
        this.system.file = new PageFile(file);
        this.hand_over([file.name.replaceAll("\n", " "), ...settings]);
        this.done(this.calls.zlg_log());
    }

    // So many more of its rows; false: that was all.
    advance_log(rows: number): boolean {
        const status = this.calls.zlg_log_advance(rows);
        if (status === 0) throw new Refusal(this.message());
        return status === 1;
    }

    log_facts(): LogFacts {
        this.calls.zlg_log_facts();
        const [facts, settings] = this.message().split("\n\n");
        const [kind, tick_s, ...notes] = facts.split("\n");
        return { kind: kind as LogFacts["kind"], tick_s: Number(tick_s), notes: notes.filter((note) => note !== ""), settings: (settings ?? "").split("\n").filter((line) => line !== "") };
    }

    private hand_over(settings: readonly string[]): void {
        const bytes = new TextEncoder().encode(settings.join("\n"));
        // The memory may move when the module asks for more: it is looked up after the call.
        const place = this.calls.zlg_text(bytes.length);
        new Uint8Array(this.calls.memory.buffer, place, bytes.length).set(bytes);
    }

    private message(): string {
        return this.text(this.calls.zlg_message(), this.calls.zlg_message_bytes());
    }

    private text(place: number, bytes: number): string {
        return new TextDecoder().decode(new Uint8Array(this.calls.memory.buffer, place, bytes));
    }

    private done(status: number): void {
        if (status !== 1) throw new Refusal(this.message());
    }
}
