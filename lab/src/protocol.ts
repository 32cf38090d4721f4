// What the page and its worker say to each other. The worker has the gyro; the page sees it through the frames that it sends.

// As the module's schema_json gives it.
export interface Key {
    section: string;
    name: string;
    unit: string;
    meaning: string;
    default: string; // TOML; empty where it is unset
    allowed: string;
    kind: "real" | "optional_real" | "integer" | "text" | "reals" | "choice" | "optional_choice" | "choices" | "interval" | "column" | "points";
    choices: string[];
}

export interface Fault {
    name: string;
    unit: string;
    least: number;
    most: number;
    duration_s: number;
}

export interface Schema {
    keys: Key[];
    health: string[];
    angle_flags: string[]; // names of the bits of an angle log
    faults: Fault[];
}

export type State = "running" | "paused" | "done" | "refused";

export interface Gyro {
    settings: string[]; // `section.key=value`
    until_s: string | null; // run to this time at full speed and stop
    from_s: number; // be at this time at once; 0: begin
    fault_s: number | null; // moment from which what a fault raises is watched
}

export type ToWorker =
    | { kind: "load"; code: string } // the module, gzipped, in base64
    | { kind: "configure"; number: number; gyro: Gyro; running: boolean }
    | { kind: "speed"; speed: number } // gyro's seconds a second; Infinity: as fast as it goes
    | { kind: "run"; running: boolean }
    | { kind: "step"; halves: number }
    | { kind: "jump" } // to the end of the next switch
    | { kind: "turn"; rate_arcsec_s: number } // by hand, from now on
    | { kind: "window"; window_s: number } // of the signals that are shown
    | { kind: "read_log"; file: File; settings: string[] }
    | { kind: "seen" }; // a frame: the next may come

// Columns of equal length.
export type Columns = Float64Array[];

export interface SwitchRow {
    compensation: number; // 0 as read, 1 by the paper, 2 as configured
    error_arcsec: number;
}

// One switch, magnified: ticks since the gap began; true, read, extrapolated and interpolated rate, arcsec/s, NaN where there is none.
export interface SwitchPicture {
    at_s: number;
    gap_s: number;
    gap_ticks: number;
    mode_after: number;
    cost_arcsec: number; // of a gyro on the page: its error; of a log: dP of eq (16)
    columns: Columns;
}

// A log that was read to its end.
export interface LogPicture {
    name: string;
    kind: "raw" | "angles";
    tick_s: number;
    ticks: number;
    gaps: number;
    angle_arcsec: number; // accumulated, as delivered
    notes: string[];
    settings: string[];
    n_switches: number;
    rms_dp_arcsec: number;
    flags: number[]; // ticks with each bit
    angle: Columns; // time and accumulated final angle
    rate: Columns; // time, final rate, rate as read
    difference: Columns; // time; angle as read and by the paper, each less the configured one
    light: Columns; // time, detuning, piezo voltage
    allan: Columns; // tau; deviation as read, by the paper, as configured, arcsec/s
    picture: SwitchPicture | null; // of the last switch
}

// Bits of health that were raised, in switches and else.
export interface Raised {
    settled: number;
    switching: number;
}

export interface Frame {
    kind: "frame";
    number: number; // of the gyro, as it was configured
    state: State;
    time_s: number;
    speed: number; // measured, gyro's seconds a second
    fingerprint: string; // empty of a gyro that was turned by hand
    turned: boolean;
    now: Float64Array; // LiveRun::now
    signals: Columns; // LiveRun's columns of the last window, thinned
    error: Columns; // time, errors as read, by the paper, as configured: the whole run, thinned
    picture: SwitchPicture | null; // of the last switch, where it was drawn since the frame before
    switches: SwitchRow[]; // that were added since the frame before
    allan: Columns; // tau, deviation as read, by the paper, as configured, arcsec/s
    module_bytes: number; // of its memory
    raised: Raised; // since the start
    raised_since_fault: Raised | null; // since `fault_s`
}

export type FromWorker =
    | { kind: "loaded"; schema: Schema }
    | { kind: "configured"; number: number; changed: string[] }
    | { kind: "refused"; number: number; message: string; whole: boolean } // what was to be configured, or the gyro in its run; whole: there is none any more that could go on
    | { kind: "log_progress"; fraction: number; ticks: number }
    | { kind: "log_read"; log: LogPicture }
    | Frame;
