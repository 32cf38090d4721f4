// The views of the gyro: each frame is drawn into them.
import { compared_lines, compensations } from "./compensations";
import { element, finite, positive } from "./elements";
import { MagnifiedSwitch } from "./magnified";
import { Chart, short } from "./plots";
import type { Frame, SwitchRow } from "./protocol";

// Columns of Frame.signals (live_run.hpp).
const signal = { time: 0, true_rate: 1, rate: 2, detuning: 3, piezo: 4, light_a: 5, light_b: 6, mode: 7, closed: 8 };

// Sizes of an error, arcsec, up to which switches are counted.
const sizes = [0.1, 0.3, 1, 3, 10, 30, 100, 300, Infinity];
const size_names = [...sizes.slice(0, -1).map(String), "∞"];

export class Views {
    private readonly rate = new Chart(element("plot-rate"), { x: "time, s", y: "rate, arcsec/s", least_span: 200, height: 190, sync: "signals", lines: [{ label: "true", colour: "--true", unit: "arcsec/s" }, { label: "measured", colour: "--ours", unit: "arcsec/s", dash: [4, 3] }] });
    private readonly detuning = new Chart(element("plot-detuning"), { x: "time, s", y: "detuning, λ", least_span: 0.05, height: 150, sync: "signals", lines: [{ label: "detuning of the perimeter", colour: "--ours", unit: "λ" }] });
    private readonly piezo = new Chart(element("plot-piezo"), { x: "time, s", y: "piezo, V", least_span: 4, height: 150, sync: "signals", lines: [{ label: "voltage at the piezo mirrors", colour: "--paper", unit: "V" }] });
    private readonly light = new Chart(element("plot-light"), { x: "time, s", y: "light, any unit", least_span: 100, height: 150, sync: "signals", lines: [{ label: "beam A", colour: "--ours", unit: "" }, { label: "beam B", colour: "--read", unit: "" }] });
    private readonly mode = new Chart(element("plot-mode"), { x: "time, s", y: "mode", height: 130, sync: "signals", y_range: [-1.3, 1.3], y_splits: [-1, 0, 1], lines: [{ label: "mode (0: loop open)", colour: "--true", unit: "", steps: true }] });
    private readonly error = new Chart(element("plot-error"), { x: "time, s", y: "error, arcsec", least_span: 20, height: 260, lines: compared_lines("arcsec") });
    private readonly magnified = new MagnifiedSwitch("switch", "Error left in the angle, as configured", true);
    private readonly histogram = new Chart(element("plot-histogram"), { x: "error of a switch up to, arcsec", y: "switches", height: 220, x_names: size_names, lines: compared_lines("").map((line) => ({ ...line, bars: true })) });
    private readonly allan = new Chart(element("plot-allan"), { x: "averaging time, s", y: "deviation, deg/h", height: 220, log_x: true, log_y: true, lines: compared_lines("deg/h") });
    private counts = compensations.map(() => sizes.map(() => 0));
    private squares = [0, 0, 0];

    begin(): void {
        this.counts = compensations.map(() => sizes.map(() => 0));
        this.squares = [0, 0, 0];
        this.magnified.begin("No switch yet. “Next switch” runs to the end of one.");
        this.histogram.show([[], [], [], []]);
        element("histogram-text").textContent = "No switch yet.";
    }

    show(frame: Frame): void {
        this.show_signals(frame);
        this.error.show(frame.error.map((column) => Array.from(column, finite)));
        if (frame.picture !== null) this.magnified.show(frame.picture);
        if (frame.switches.length > 0) this.count(frame.switches);
        this.allan.show(frame.allan.map((column) => Array.from(column, positive)));
    }

    private show_signals(frame: Frame): void {
        const at = frame.signals;
        const open = Array.from(at[signal.mode], (mode, row) => (at[signal.closed][row] > 0 ? mode : 0));
        this.rate.show([at[signal.time], at[signal.true_rate], at[signal.rate]]);
        this.detuning.show([at[signal.time], at[signal.detuning]]);
        this.piezo.show([at[signal.time], at[signal.piezo]]);
        this.light.show([at[signal.time], Array.from(at[signal.light_a], finite), Array.from(at[signal.light_b], finite)]);
        this.mode.show([at[signal.time], open]);
    }

    private count(switches: SwitchRow[]): void {
        for (const { compensation, error_arcsec } of switches) {
            ++this.counts[compensation][sizes.findIndex((size) => Math.abs(error_arcsec) <= size)];
            this.squares[compensation] += error_arcsec ** 2;
        }
        this.histogram.show(side_by_side(this.counts));
        const rms = this.counts.map((counts, at) => Math.sqrt(this.squares[at] / Math.max(1, counts.reduce((sum, n) => sum + n, 0))));
        const n = this.counts[2].reduce((sum, count) => sum + count, 0);
        element("histogram-text").textContent = `${n} ${n === 1 ? "switch" : "switches"}; rms error ${compensations.map(({ label }, at) => `${label} ${short(rms[at], 3)}`).join(", ")} arcsec.`;
    }
}

// Bars of the compensations beside each other: each has places of its own at every size.
function side_by_side(counts: number[][]): (number | null)[][] {
    const places = sizes.flatMap((_, size) => counts.map((_, which) => size + 0.28 * (which - 1)));
    const columns = counts.map((of, which) => sizes.flatMap((_, size) => counts.map((_, place) => (place === which && of[size] > 0 ? of[size] : null))));
    return [places, ...columns];
}
