// The worker reads a log from its beginning to its end, and makes a picture of it in bounded memory. To cancel it, the page ends the worker.
import { LoopModule, Refusal, View } from "./loop_module";
import type { FromWorker, LogPicture } from "./protocol";
import { AllanDeviation, allan_columns, Envelope, Ring } from "./series";
import { SwitchPictures } from "./switch_pictures";

const rows_a_slice = 4096;
const progress_ms = 100;
const most_stretches = 1024;
const newest_ticks = 16384;

// Columns of log_run.hpp.
const tick_columns = 13;
const tick_column = { tick: 0, read: 1, delivered: 2, final: 3, sigma: 4, flags: 5, mode: 6, detuning: 7, piezo: 8, angle_delivered: 9, angle: 10, read_less: 11, paper_less: 12 };
const switch_columns = 4;
const n_flags = 32;
const in_gap = 0x300; // flag_loop_unlocked, flag_invalid
const longest_relock_ticks = 20;

class LogRecorder {
    ticks = 0;
    private gaps = 0;
    private was_in_gap = false;
    private angle_delivered = 0;
    private readonly flags = new Array<number>(n_flags).fill(0);
    private readonly angle = new Envelope(most_stretches);
    private readonly rate = new Envelope(most_stretches);
    private readonly difference = new Envelope(most_stretches);
    private readonly light = new Envelope(most_stretches);
    private readonly deviations: AllanDeviation[];
    private readonly rows = new Ring(tick_columns, newest_ticks);
    private readonly pictures: SwitchPictures;
    private newest: LogPicture["picture"] = null;
    private n_switches = 0;
    private squares = 0;

    constructor(private readonly tick_s: number) {
        this.deviations = [0, 1, 2].map(() => new AllanDeviation(tick_s));
        this.pictures = new SwitchPictures(this.rows, { true: null, read: tick_column.read, delivered: tick_column.delivered, final: tick_column.final }, tick_s);
    }

    take(ticks: Float64Array, switches: Float64Array): void {
        this.rows.add(ticks);
        for (let at = 0; at < ticks.length; at += tick_columns) this.take_tick(ticks.subarray(at, at + tick_columns));
        for (let at = 0; at < switches.length; at += switch_columns) {
            const [first_tick, gap_ticks, mode_after, dp_arcsec] = switches.subarray(at, at + switch_columns);
            ++this.n_switches;
            this.squares += dp_arcsec ** 2;
            this.pictures.expect({ first_tick, gap_ticks, last_tick: first_tick + gap_ticks + longest_relock_ticks, mode_after, cost_arcsec: dp_arcsec });
        }
        this.pictures.settle();
        this.newest = this.pictures.take() ?? this.newest;
    }

    private take_tick(row: Float64Array): void {
        const at = tick_column;
        const t_s = (row[at.tick] + 1) * this.tick_s;
        this.angle_delivered = row[at.angle_delivered];
        this.angle.add(t_s, [row[at.angle]]);
        this.rate.add(t_s, [row[at.final] / this.tick_s, row[at.read] / this.tick_s]);
        this.difference.add(t_s, [row[at.read_less], row[at.paper_less]]);
        this.light.add(t_s, [row[at.detuning], row[at.piezo]]);
        [row[at.read_less], row[at.paper_less], 0].forEach((less, which) => this.deviations[which].add(row[at.angle] + less));
        const gap = (row[at.flags] & in_gap) !== 0;
        if (gap && !this.was_in_gap) ++this.gaps;
        this.was_in_gap = gap;
        for (let bits = row[at.flags] >>> 0, bit = 0; bits !== 0; bits >>>= 1, ++bit) this.flags[bit] += bits & 1;
        ++this.ticks;
    }

    picture(): Omit<LogPicture, "name" | "kind" | "tick_s" | "notes" | "settings"> {
        this.pictures.settle(true);
        return {
            ticks: this.ticks,
            gaps: this.gaps,
            angle_arcsec: this.angle_delivered,
            n_switches: this.n_switches,
            rms_dp_arcsec: Math.sqrt(this.squares / Math.max(1, this.n_switches)),
            flags: this.flags,
            angle: this.angle.columns(1),
            rate: this.rate.columns(2),
            difference: this.difference.columns(2),
            light: this.light.columns(2),
            allan: allan_columns(this.deviations),
            picture: this.pictures.take() ?? this.newest,
        };
    }
}

export function read_log(module: LoopModule, file: File, settings: string[], answer: (message: FromWorker) => void): void {
    try {
        module.open_log(file, settings);
        const recorder = new LogRecorder(module.log_facts().tick_s);
        read_rows(module, recorder, answer);
        answer({ kind: "log_read", log: { name: file.name, ...module.log_facts(), ...recorder.picture() } });
    } catch (error) {
        if (!(error instanceof Refusal)) throw error;
        answer({ kind: "refused", number: 0, message: error.message, whole: true });
    }
}

function read_rows(module: LoopModule, recorder: LogRecorder, answer: (message: FromWorker) => void): void {
    let shown_ms = performance.now();
    for (let more = true; more; ) {
        more = module.advance_log(rows_a_slice);
        recorder.take(module.rows(View.log_ticks), module.rows(View.log_switches));
        module.calls.zlg_log_forget();
        if (performance.now() - shown_ms < progress_ms) continue;
        shown_ms = performance.now();
        answer({ kind: "log_progress", fraction: module.calls.zlg_log_fraction(), ticks: recorder.ticks });
    }
}
