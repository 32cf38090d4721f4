// The worker: it has the gyro, keeps its pace, and sends a frame whenever the page has drawn the one before.
import { read_log } from "./log_reading";
import { LoopModule, Refusal, View } from "./loop_module";
import type { Frame, FromWorker, Gyro, Key, State, ToWorker } from "./protocol";
import { Recorder } from "./recorder";
import { Settings } from "./settings";

interface Scope {
    postMessage(message: FromWorker, transfer?: Transferable[]): void;
    onmessage: ((event: MessageEvent<ToWorker>) => void) | null;
}

const scope = self as unknown as Scope;

const slice_ms = 10; // of work, between two looks at what the page wants
const frame_ms = 33;
const fingerprint_ms = 500;
const longest_debt_s = 0.2; // that a gyro which cannot keep the pace tries to catch up
const halves_a_call = 32;
const acceleration_arcsec_s2 = 100 * 3600; // of a case that is turned by hand

class Pace {
    private module: LoopModule | null = null;
    private recorder: Recorder | null = null;
    private keys: Key[] = [];
    private switching_bit = 0; // of health
    private gyro: Gyro | null = null;
    private state: State = "paused";
    private speed = 1;
    private tick_s = 0.005;
    private number = 0;
    private window_s = 5;
    private catch_up_halves = 0; // run at full speed until there are so many
    private repeated_halves = 0; // of these, those that the reader has seen before a change
    private end_halves = Infinity;
    private jump_to_switch = false;
    private pace_from = { ms: 0, halves: 0 };
    private measured = { ms: 0, time_s: 0, speed: 0 };
    private fingerprint = { ms: -Infinity, text: "" };
    private turned = false; // by hand
    private hand = { wanted_arcsec_s: 0, now_arcsec_s: 0 };
    private frame_is_seen = true;
    private last_frame_ms = 0;
    private changed = true; // since the last frame
    private answers_reader = false; // what the reader has done is shown at once
    private awake = false;
    private readonly wake_up = new MessageChannel();

    constructor() {
        this.wake_up.port1.onmessage = () => this.work();
    }

    async take(message: ToWorker): Promise<void> {
        switch (message.kind) {
            case "load": {
                this.module = await LoopModule.load(await unpacked(message.code));
                const schema = this.module.schema();
                this.keys = schema.keys;
                this.switching_bit = schema.health.indexOf("switching");
                scope.postMessage({ kind: "loaded", schema });
                return;
            }
            case "configure":
                this.configure(message.number, message.gyro, message.running);
                break;
            case "speed":
                this.speed = message.speed;
                this.restart_pace();
                break;
            case "run":
                if (!message.running) this.stop();
                else if (this.state === "paused") this.state = "running";
                this.jump_to_switch = false;
                this.restart_pace();
                break;
            case "step":
                this.step(message.halves);
                break;
            case "jump":
                this.stop();
                if (this.state === "paused") {
                    this.jump_to_switch = true;
                    this.state = "running";
                }
                break;
            case "turn":
                this.hand.wanted_arcsec_s = message.rate_arcsec_s;
                break;
            case "read_log":
                read_log(this.module!, message.file, message.settings, (answer) => scope.postMessage(answer));
                return;
            case "window":
                this.window_s = message.window_s;
                break;
            case "seen":
                this.frame_is_seen = true;
                break;
        }
        this.changed ||= message.kind !== "seen";
        this.answers_reader ||= message.kind !== "seen";
        this.wake();
    }

    // It stops where it is, or where a change of the settings brings it first; not at the end of what a link asks for.
    private stop(): void {
        this.jump_to_switch = false;
        if (this.state !== "running") return;
        this.state = "paused";
        this.catch_up_halves = this.repeated_halves;
    }

    // It goes on from where it stops and makes the steps that were asked for before as well.
    private step(halves: number): void {
        this.stop();
        if (this.state === "paused") this.catch_up_halves = Math.min(Math.max(this.module!.calls.zlg_halves(), this.catch_up_halves) + halves, this.end_halves);
    }

    private configure(number: number, gyro: Gyro, running: boolean): void {
        const module = this.module!;
        // The later of two settings is in force.
        const settings = gyro.until_s === null ? gyro.settings : [...gyro.settings, `run.duration_s=${gyro.until_s}`];
        try {
            module.configure(settings);
        } catch (error) {
            this.refuse(number, error);
            return;
        }
        if (gyro.from_s === 0) {
            module.calls.zlg_let_go();
            this.turned = false;
            this.hand = { wanted_arcsec_s: 0, now_arcsec_s: 0 };
        }
        this.gyro = gyro;
        this.number = number;
        const changed = module.changed().filter((setting) => gyro.until_s === null || !setting.startsWith("run.duration_s="));
        this.tick_s = new Settings(this.keys, module.changed()).number("gyro.tick_s");
        this.recorder = new Recorder(this.tick_s, this.switching_bit, gyro.fault_s);
        this.end_halves = gyro.until_s !== null ? module.calls.zlg_run_halves() : Infinity;
        this.repeated_halves = gyro.until_s === null ? Math.floor(gyro.from_s / this.tick_s + 1e-6) * 2 : 0;
        this.catch_up_halves = gyro.until_s === null ? this.repeated_halves : module.calls.zlg_run_halves();
        this.state = running || gyro.until_s !== null ? "running" : "paused";
        this.jump_to_switch = false;
        this.fingerprint = { ms: -Infinity, text: "" };
        this.restart_pace();
        scope.postMessage({ kind: "configured", number: this.number, changed });
    }

    // The module keeps the gyro that it had.
    private refuse(number: number, error: unknown): void {
        if (!(error instanceof Refusal)) throw error;
        scope.postMessage({ kind: "refused", number, message: error.message, whole: this.gyro === null });
    }

    private restart_pace(): void {
        this.pace_from = { ms: performance.now(), halves: this.module?.calls.zlg_halves() ?? 0 };
        this.measured = { ms: performance.now(), time_s: this.module?.calls.zlg_time_s() ?? 0, speed: 0 };
    }

    // So many halves, with what they show.
    private advance(halves: number): void {
        const module = this.module!;
        try {
            module.advance(halves - this.follow_hand(halves));
        } catch (error) {
            if (!(error instanceof Refusal)) throw error;
            this.state = "refused";
            scope.postMessage({ kind: "refused", number: this.number, message: error.message, whole: true });
            return;
        }
        const recorder = this.recorder!;
        recorder.take(module.rows(View.signals), module.rows(View.angles), module.rows(View.switches));
        module.calls.zlg_forget();
        this.changed = true;
        if (this.jump_to_switch && recorder.has_new_switch && module.calls.zlg_halves() > this.repeated_halves) {
            this.jump_to_switch = false;
            this.state = "paused";
        }
        if (module.calls.zlg_halves() >= this.end_halves) this.state = "done";
    }

    // A hand changes the rate of the case steadily: so many of the halves are advanced one by one, until it has the rate that is wanted.
    private follow_hand(halves: number): number {
        const { hand } = this;
        if (this.module!.calls.zlg_halves() < this.repeated_halves) return 0; // its turns are known
        const most = (acceleration_arcsec_s2 * this.tick_s) / 2;
        let n = 0;
        for (; n < halves && hand.now_arcsec_s !== hand.wanted_arcsec_s; ++n) {
            hand.now_arcsec_s += Math.max(-most, Math.min(most, hand.wanted_arcsec_s - hand.now_arcsec_s));
            this.module!.turn(hand.now_arcsec_s);
            this.module!.advance(1);
            this.turned = true;
        }
        return n;
    }

    // Halves that are due now.
    private due(): number {
        const halves = this.module!.calls.zlg_halves();
        if (halves < this.catch_up_halves) return this.catch_up_halves - halves;
        if (this.state !== "running") return 0;
        if (this.jump_to_switch || this.speed === Infinity) return this.end_halves - halves;
        const half_s = this.tick_s / 2;
        const seconds = (performance.now() - this.pace_from.ms) / 1000;
        const due = Math.floor((seconds * this.speed) / half_s) - (halves - this.pace_from.halves);
        if (due * half_s > longest_debt_s * this.speed + half_s) {
            this.pace_from = { ms: performance.now(), halves: halves };
            return Math.min(Math.ceil((longest_debt_s * this.speed) / half_s), this.end_halves - halves);
        }
        return Math.min(due, this.end_halves - halves);
    }

    private work(): void {
        this.awake = false;
        if (this.gyro === null || this.recorder === null || this.state === "refused") return;
        const was_catching_up = this.module!.calls.zlg_halves() < this.catch_up_halves;
        const end_ms = performance.now() + slice_ms;
        let due = this.due();
        const worked = due > 0;
        while (due > 0 && performance.now() < end_ms) {
            const halves = Math.min(due, halves_a_call);
            this.advance(halves);
            if ((this.state as State) === "refused") return;
            due = this.state === "running" || this.module!.calls.zlg_halves() < this.catch_up_halves ? due - halves : 0;
        }
        if (was_catching_up && this.module!.calls.zlg_halves() >= this.catch_up_halves) this.restart_pace();
        this.show();
        if (due > 0) this.wake();
        else if (this.state === "running" || (this.changed && !worked)) setTimeout(() => this.wake(), 8);
        else if (this.changed) this.wake();
    }

    private wake(): void {
        if (this.awake) return;
        this.awake = true;
        this.wake_up.port2.postMessage(null);
    }

    private show(): void {
        const now_ms = performance.now();
        if (!this.changed || !(this.frame_is_seen || this.answers_reader)) return;
        const stands = this.state !== "running" && this.module!.calls.zlg_halves() >= this.catch_up_halves;
        if (!stands && !this.answers_reader && now_ms - this.last_frame_ms < frame_ms) return;
        this.answers_reader = false;
        this.last_frame_ms = now_ms;
        this.frame_is_seen = false;
        this.changed = false;
        scope.postMessage(this.frame(stands));
    }

    private frame(stands: boolean): Frame {
        const module = this.module!;
        const recorder = this.recorder!;
        const now_ms = performance.now();
        if (stands || now_ms - this.fingerprint.ms > fingerprint_ms) this.fingerprint = { ms: now_ms, text: this.turned ? "" : module.fingerprint() };
        const passed_s = (now_ms - this.measured.ms) / 1000;
        if (passed_s > 0.5) {
            const speed = (module.calls.zlg_time_s() - this.measured.time_s) / passed_s;
            this.measured = { ms: now_ms, time_s: module.calls.zlg_time_s(), speed };
        }
        return {
            kind: "frame",
            number: this.number,
            state: this.state,
            time_s: module.calls.zlg_time_s(),
            speed: this.state === "running" ? this.measured.speed : 0,
            fingerprint: this.fingerprint.text,
            turned: this.turned,
            now: module.now(),
            signals: recorder.signals(this.window_s),
            error: recorder.error(),
            picture: recorder.pictures.take(),
            switches: recorder.new_switches(),
            allan: recorder.allan(),
            module_bytes: module.calls.memory.buffer.byteLength,
            raised: recorder.raised,
            raised_since_fault: recorder.raised_since_fault,
        };
    }
}

// The browser's own decompression.
async function unpacked(base64: string): Promise<ArrayBuffer> {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Response(stream).arrayBuffer();
}

const pace = new Pace();
scope.onmessage = (event) => void pace.take(event.data);
