// What the worker remembers of the gyro's rows, to show it.
import type { Columns, Raised, SwitchRow } from "./protocol";
import { AllanDeviation, allan_columns, Envelope, Ring } from "./series";
import { SwitchPictures } from "./switch_pictures";

const signal_columns = 10;
const angle_columns = 8;
const switch_columns = 6;
const newest_ticks = 32768;
const most_points = 1200;
const configured = 2; // among the compensations of a switch

// Of signals: the column by whose peaks they are thinned, and others.
const time_column = 0;
const detuning_column = 3;
const health_column = 9;
// Of angles.
const error_columns = [5, 6, 7];

export class Recorder {
    private readonly signal_rows = new Ring(signal_columns, newest_ticks);
    private readonly angle_rows = new Ring(angle_columns, newest_ticks);
    private readonly errors = new Envelope(1024);
    private readonly deviations: AllanDeviation[];
    private unsent: SwitchRow[] = [];
    has_new_switch = false; // among the rows taken last
    readonly pictures: SwitchPictures;
    readonly raised: Raised = { settled: 0, switching: 0 };
    readonly raised_since_fault: Raised | null;

    // switching_bit  of health: a switch is on.
    // fault_s        moment from which what a fault raises is watched.
    constructor(
        private readonly tick_s: number,
        private readonly switching_bit: number,
        private readonly fault_s: number | null,
    ) {
        this.raised_since_fault = fault_s === null ? null : { settled: 0, switching: 0 };
        this.deviations = [0, 1, 2].map(() => new AllanDeviation(tick_s));
        this.pictures = new SwitchPictures(this.angle_rows, { true: 1, read: 2, delivered: 3, final: 4 }, tick_s);
    }

    take(signals: Float64Array, angles: Float64Array, switches: Float64Array): void {
        this.has_new_switch = false;
        this.signal_rows.add(signals);
        for (let at = 0; at < signals.length; at += signal_columns) this.take_health(signals[at + time_column], signals[at + health_column]);
        this.angle_rows.add(angles);
        for (let at = 0; at < angles.length; at += angle_columns) {
            const errors = error_columns.map((column) => angles[at + column]);
            this.errors.add((angles[at] + 1) * this.tick_s, errors);
            this.deviations.forEach((deviation, which) => deviation.add(errors[which]));
        }
        for (let at = 0; at < switches.length; at += switch_columns) this.take_switch(switches.subarray(at, at + switch_columns));
        this.pictures.settle();
    }

    private take_health(time_s: number, bits: number): void {
        const where = ((bits >>> this.switching_bit) & 1) === 1 ? "switching" : "settled";
        this.raised[where] = (this.raised[where] | bits) >>> 0;
        if (this.raised_since_fault !== null && time_s >= this.fault_s!) this.raised_since_fault[where] = (this.raised_since_fault[where] | bits) >>> 0;
    }

    private take_switch(row: Float64Array): void {
        const [compensation, first_tick, gap_ticks, last_tick, mode_after, error_arcsec] = row;
        this.unsent.push({ compensation, error_arcsec });
        if (compensation !== configured) return;
        this.pictures.expect({ first_tick, gap_ticks, last_tick, mode_after, cost_arcsec: error_arcsec });
        this.has_new_switch = true;
    }

    new_switches(): SwitchRow[] {
        const rows = this.unsent;
        this.unsent = [];
        return rows;
    }

    signals(window_s: number): Columns {
        const { end } = this.signal_rows;
        return this.signal_rows.slice(end - Math.round(window_s / this.tick_s), end, most_points, detuning_column);
    }

    error(): Columns {
        return this.errors.columns(error_columns.length);
    }

    allan(): Columns {
        return allan_columns(this.deviations);
    }
}
